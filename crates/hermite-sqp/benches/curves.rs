//! One curve: the problem, its solution, the fallback, and both refinements. Feet come from Newton
//! steps on a torus, as in the tests.

use std::hint::black_box;

use bezier_core::glam::DVec3;
use criterion::{Criterion, criterion_group, criterion_main};
use hermite_sqp::{CurveFoot, CurveRefinement, Settings, refine, solve};

#[path = "../tests/common/mod.rs"]
mod common;

use common::{Field, cylinder, on_torus, problem, torus};

fn solving(c: &mut Criterion) {
    let cases: [(&str, Field, [DVec3; 2]); 3] = [
        ("torus", torus, [on_torus(0.1, 0.3), on_torus(0.2, 0.8)]),
        // the singular system
        ("cylinder-generator", cylinder, [DVec3::X, DVec3::new(1.0, 0.0, 1.5)]),
        // under-resolved: the fallback
        ("fallback", torus, [on_torus(0.0, 0.1), on_torus(0.0, 2.7)]),
    ];
    let settings = Settings::default();
    for (name, field, ends) in cases {
        let problem = problem(field, ends);
        c.bench_function(&format!("solve/{name}"), |b| {
            b.iter(|| solve(black_box(&problem), &settings));
        });
    }
}

fn refinement(c: &mut Criterion) {
    let settings = Settings::default();
    let foot = |near: &DVec3| {
        // three Newton steps are enough for points this close
        let point = (0..3).fold(*near, |p, _| {
            let (value, gradient, _) = torus(p);
            p - gradient * (value / gradient.length_squared())
        });
        CurveFoot { point, normal: torus(point).1.normalize() }
    };
    let feet = |points: &[DVec3], feet: &mut [CurveFoot]| {
        feet.iter_mut().zip(points).for_each(|(slot, point)| *slot = foot(point));
        true
    };
    let ends = [on_torus(0.1, 0.3), on_torus(0.2, 0.8)];
    let problem = problem(torus, ends);
    let curve = solve(&problem, &settings).curve;
    for (name, refinement) in [
        ("tangent-fixed", CurveRefinement::TangentFixed),
        ("tangent-free", CurveRefinement::TangentFree),
    ] {
        c.bench_function(&format!("refine/{name}"), |b| {
            b.iter(|| refine(black_box(&problem), &curve, refinement, &settings, &feet));
        });
    }
}

criterion_group!(benches, solving, refinement);
criterion_main!(benches);
