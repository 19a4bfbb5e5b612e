//! Typed formulas against the same shapes in Rust, one thread.
//!
//! Targets on the default x86-64 target: a jet of the dodecahedron formula in 350 ns at one point
//! and in 120 ns per point of a batch; values of a batch in about 10 ns per point.

use std::hint::black_box;

use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DMat3, DVec3};
use implicit::{Aabb, FieldJet, Formula, ImplicitSurface, NamedShape, catalogue};

const BATCH: u32 = 1024;

/// Points spread over the box without pattern, the same in every run (Weyl sequence).
fn points(region: &Aabb) -> Vec<DVec3> {
    let steps =
        DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_2);
    (0..BATCH).map(|i| region.min + region.size() * (steps * f64::from(i)).fract()).collect()
}

fn one_point(
    group: &mut BenchmarkGroup<'_, criterion::measurement::WallTime>,
    name: &str,
    field: &dyn ImplicitSurface,
    p: DVec3,
) {
    group.throughput(Throughput::Elements(1));
    group.bench_function(format!("{name}/value"), |b| b.iter(|| field.value(black_box(p))));
    group.bench_function(format!("{name}/gradient"), |b| {
        b.iter(|| field.value_gradient(black_box(p)));
    });
    group.bench_function(format!("{name}/jet"), |b| b.iter(|| field.jet(black_box(p))));
}

fn many_points(
    group: &mut BenchmarkGroup<'_, criterion::measurement::WallTime>,
    name: &str,
    field: &dyn ImplicitSurface,
    points: &[DVec3],
) {
    group.throughput(Throughput::Elements(points.len() as u64));
    let mut values = vec![0.0; points.len()];
    group.bench_function(format!("{name}/values"), |b| {
        b.iter(|| field.values(black_box(points), &mut values));
    });
    let mut gradients = vec![(0.0, DVec3::ZERO); points.len()];
    group.bench_function(format!("{name}/gradients"), |b| {
        b.iter(|| field.value_gradients(black_box(points), &mut gradients));
    });
    let zero = FieldJet { value: 0.0, gradient: DVec3::ZERO, hessian: DMat3::ZERO };
    let mut jets = vec![zero; points.len()];
    group.bench_function(format!("{name}/jets"), |b| {
        b.iter(|| field.jets(black_box(points), &mut jets));
    });
}

fn shapes(c: &mut Criterion) {
    for shape in catalogue() {
        let points = points(&shape.region);
        let fields: [(&str, Box<dyn ImplicitSurface>); 2] = [
            ("shape", shape.field()),
            ("formula", Box::new(Formula::parse(shape.formula).expect("in the catalogue"))),
        ];
        for (kind, field) in fields {
            let mut group = c.benchmark_group(kind);
            one_point(&mut group, &format!("one/{}", shape.name), &field, points[0]);
            many_points(&mut group, &format!("many/{}", shape.name), &field, &points);
            group.finish();
        }
    }
}

fn enclosure(c: &mut Criterion) {
    let shape = NamedShape::find("dodecahedron").expect("in the catalogue");
    let region = shape.region.expanded(0.1);
    let formula = Formula::parse(shape.formula).expect("in the catalogue");
    let fields: [(&str, Box<dyn ImplicitSurface>); 2] =
        [("shape", shape.field()), ("formula", Box::new(formula))];
    for (kind, field) in fields {
        let mut group = c.benchmark_group(format!("enclosure/{kind}"));
        group.bench_function("value/dodecahedron", |b| {
            b.iter(|| field.enclosure(black_box(&region)));
        });
        group.bench_function("gradient/dodecahedron", |b| {
            b.iter(|| field.gradient_enclosure(black_box(&region)));
        });
        group.finish();
    }
}

fn parse(c: &mut Criterion) {
    let text = NamedShape::find("deccube").expect("in the catalogue").formula;
    c.bench_function("parse/deccube", |b| b.iter(|| Formula::parse(black_box(text))));
}

criterion_group!(benches, shapes, enclosure, parse);
criterion_main!(benches);
