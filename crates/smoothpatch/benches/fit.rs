//! The whole fit over a given base mesh, in both methods, with a thousand to a hundred thousand
//! faces: the time per face should not depend on their number.

use criterion::{BatchSize, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use smoothpatch::implicit::Torus;
use smoothpatch::{Method, Settings, Silent, fit_base_mesh};
use testkit::meshes::torus_grid;

fn fit(c: &mut Criterion) {
    let field = Torus { major_radius: 2.0, minor_radius: 1.0 };
    for (around, across) in [(32, 16), (100, 50), (316, 158)] {
        let mesh = torus_grid([2.0, 1.0], around, across);
        let faces = mesh.topology().face_count();
        for (name, method) in [("published", Method::Published), ("refined", Method::Refined)] {
            let settings = Settings::with_faces(faces).with_method(method);
            let mut group = c.benchmark_group(format!("fit_base_mesh/{name}"));
            group.sample_size(10).sampling_mode(SamplingMode::Flat);
            group.throughput(Throughput::Elements(faces as u64));
            group.bench_function(faces.to_string(), |b| {
                b.iter_batched(
                    || mesh.clone(),
                    |mesh| fit_base_mesh(&field, mesh, &settings, &mut Silent),
                    BatchSize::PerIteration,
                );
            });
            group.finish();
        }
    }
}

criterion_group!(benches, fit);
criterion_main!(benches);
