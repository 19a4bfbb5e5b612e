//! Decimation of a dense mesh of a surface of genus 13 to 5 %, and its parts.

use std::hint::black_box;

use basemesh::{
    Foot, ImproveSettings, PolygonizeSettings, SimplifySettings, SurfaceTarget, TriMesh,
    cells_for_faces, improve, polygonize, simplify,
};
use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use implicit::{
    ImplicitField, NamedShape, ProjectionSettings, project_many, project_with_gradient,
};

struct FieldTarget<'a> {
    field: &'a dyn ImplicitField,
    length: f64,
}

impl SurfaceTarget for FieldTarget<'_> {
    fn foot(&self, near: glam::DVec3) -> Option<Foot> {
        project_with_gradient(self.field, near, self.length, &ProjectionSettings::default())
            .ok()
            .map(|(point, normal)| Foot { point, normal })
    }

    fn feet(&self, points: &[glam::DVec3], feet: &mut [Option<Foot>]) {
        let mut moved = points.to_vec();
        let normals =
            project_many(self.field, &mut moved, self.length, &ProjectionSettings::default());
        for ((foot, &point), normal) in feet.iter_mut().zip(&moved).zip(normals) {
            *foot = normal.ok().map(|normal| Foot { point, normal });
        }
    }
}

fn dense(shape: &NamedShape, field: &dyn implicit::BoundedField, faces: usize) -> TriMesh {
    let cells = cells_for_faces(field, &shape.region, faces).expect("a closed surface");
    polygonize(field, &shape.region, &PolygonizeSettings::with_cells(cells))
        .expect("a closed surface")
}

fn elements(count: usize) -> Throughput {
    Throughput::Elements(u64::try_from(count).expect("a count fits 64 bits"))
}

fn benches(c: &mut Criterion) {
    let shape = NamedShape::find("deccube").expect("a named shape");
    let field = shape.field();
    let mut group = c.benchmark_group("simplify");
    group.sample_size(10);
    for count in [100_000, 300_000, 1_000_000] {
        let mesh = dense(shape, &*field, count);
        let target = FieldTarget { field: &*field, length: mesh.diagonal() };
        let input = mesh.topology().face_count();
        let all = SimplifySettings::to_faces(2 * (input / 40));
        // decimation alone: no smoothing before or after
        let collapses = SimplifySettings {
            relaxation_iterations: 0,
            rounds: 0,
            exchange_rounds: 0,
            ..all.clone()
        };
        group.throughput(elements(input));
        for (name, settings) in [("to 5 percent", &all), ("collapses only", &collapses)] {
            group.bench_with_input(BenchmarkId::new(name, input), &mesh, |b, mesh| {
                b.iter_batched(
                    || mesh.clone(),
                    |mesh| black_box(simplify(mesh, &target, settings)),
                    BatchSize::LargeInput,
                );
            });
        }
    }
    let mesh = dense(shape, &*field, 10_000);
    let target = FieldTarget { field: &*field, length: mesh.diagonal() };
    group.throughput(elements(mesh.topology().face_count()));
    group.bench_function("improve", |b| {
        b.iter(|| black_box(improve(&mesh, &target, &ImproveSettings::default())));
    });
    group.finish();
}

criterion_group!(simplification, benches);
criterion_main!(simplification);
