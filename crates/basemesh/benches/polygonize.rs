//! Triangles a second of the polygonizer, on a surface with 13 handles and on one with tight
//! enclosures.
#![allow(missing_docs, reason = "criterion's macros generate undocumented functions")]

use basemesh::{PolygonizeSettings, polygonize};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use implicit::NamedShape;

/// Shape and cells along the longest side: about 10⁴, 10⁵ and 7.5·10⁵ triangles each.
const CASES: [(&str, [usize; 3]); 2] = [("deccube", [44, 136, 375]), ("torus", [59, 186, 508])];

fn bench_polygonize(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("polygonize");
    group.sample_size(10);
    for (name, resolutions) in CASES {
        let shape = NamedShape::find(name).expect("the shape is in the catalogue");
        let field = shape.field();
        for cells in resolutions {
            let run = || {
                polygonize(&field, &shape.region, &PolygonizeSettings::with_cells(cells))
                    .expect("the surface is closed in its region")
            };
            let faces = run().topology().face_count();
            group.throughput(Throughput::Elements(faces as u64));
            group.bench_function(BenchmarkId::new(name, faces), |b| b.iter(run));
        }
    }
    group.finish();
}

criterion_group!(benches, bench_polygonize);
criterion_main!(benches);
