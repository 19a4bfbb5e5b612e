//! What a picture costs: many patches of a waved surface, with few and with many pixels.
//!
//! `cargo bench -p render`

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use render::glam::{DVec2, DVec3};
use render::{Domain, Patches, Shade, Style, SurfacePoint, UpAxis, View, draw, frame};

/// A surface `z = f(x, y)` over the unit square, in `n` by `n` patches.
struct Waves(usize);

impl Waves {
    fn place(&self, patch: usize, at: DVec2) -> DVec2 {
        let corner = DVec2::new((patch % self.0) as f64, (patch / self.0) as f64);
        (corner + at) / self.0 as f64
    }
}

impl Patches for Waves {
    fn count(&self) -> usize {
        self.0 * self.0
    }

    fn domain(&self, _: usize) -> Domain {
        Domain::Square
    }

    fn point(&self, patch: usize, at: DVec2) -> DVec3 {
        let p = self.place(patch, at);
        p.extend(0.05 * (9.0 * p.x).sin() * (7.0 * p.y).cos())
    }

    fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint {
        let p = self.place(patch, at);
        let ((sx, cx), (sy, cy)) = ((9.0 * p.x).sin_cos(), (7.0 * p.y).sin_cos());
        let step = 1.0 / self.0 as f64;
        let du = DVec3::new(1.0, 0.0, 0.45 * cx * cy) * step;
        let dv = DVec3::new(0.0, 1.0, -0.35 * sx * sy) * step;
        SurfacePoint { point: p.extend(0.05 * sx * cy), normal: du.cross(dv), du, dv }
    }
}

fn pictures(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("draw");
    group.sample_size(10);
    let axes = View::new(-50.0, 35.0).axes(UpAxis::Z);
    for (side, size) in [(10, [400, 300]), (70, [400, 300]), (70, [1200, 900])] {
        let waves = Waves(side);
        let camera = frame(&[&waves], axes, size).expect("a surface");
        for (name, edges) in [("zebra", false), ("zebra with edges", true)] {
            let style = Style { edges, ..Style::new(Shade::Zebra(12.0)) };
            let what = format!("{} patches, {}x{}", side * side, size[0], size[1]);
            group.bench_function(BenchmarkId::new(name, what), |bencher| {
                bencher.iter(|| draw(black_box(&waves), &camera, size, &style));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, pictures);
criterion_main!(benches);
