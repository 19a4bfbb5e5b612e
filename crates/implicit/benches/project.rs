//! Projection of a thousand points, one by one and in batches, and the curvature at a point.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use implicit::{
    Formula, ImplicitSurface, NamedShape, ProjectionSettings, project_many, project_with_gradient,
    surface_point,
};
use testkit::conformance::field::sample_points;

/// Points within a hundredth of the diagonal from the surface.
fn near_surface(field: &dyn ImplicitSurface, shape: &NamedShape) -> Vec<DVec3> {
    let near = 0.01 * shape.region.diagonal();
    let is_near = |p: &DVec3| {
        let (value, gradient) = field.value_gradient(*p);
        value.abs() <= near * gradient.length()
    };
    sample_points(&shape.region, 100_000).into_iter().filter(is_near).take(1024).collect()
}

fn project(c: &mut Criterion) {
    let settings = ProjectionSettings::default();
    for name in ["torus", "double-torus", "chair", "deccube"] {
        let shape = NamedShape::find(name).expect("in the catalogue");
        let formula = Formula::parse(shape.formula).expect("in the catalogue");
        let fields: [(&str, &dyn ImplicitSurface); 2] =
            [("shape", &shape.field()), ("formula", &formula)];
        let length = 0.02 * shape.region.diagonal();
        for (kind, field) in fields {
            let points = near_surface(field, shape);
            let mut group = c.benchmark_group(format!("project/{kind}/{name}"));
            group.throughput(Throughput::Elements(points.len() as u64));
            group.bench_function("single", |b| {
                b.iter(|| {
                    for &p in &points {
                        let _ = black_box(project_with_gradient(field, p, length, &settings));
                    }
                });
            });
            group.bench_function("many", |b| {
                b.iter(|| project_many(field, &mut points.clone(), length, &settings));
            });
            group.finish();
        }
    }
}

fn curvature(c: &mut Criterion) {
    let field = NamedShape::find("deccube").expect("in the catalogue").field();
    let p = DVec3::new(0.8, 0.1, 1.05);
    c.bench_function("curvature/deccube/surface_point", |b| {
        b.iter(|| surface_point(&field, black_box(p)));
    });
    let point = surface_point(&field, p).expect("a regular point");
    c.bench_function("curvature/deccube/principal", |b| {
        b.iter(|| black_box(&point).principal());
    });
}

criterion_group!(benches, project, curvature);
criterion_main!(benches);
