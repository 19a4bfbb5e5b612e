//! What refinement promises: the conditions hold, the curve comes no farther from the surface, and
//! the result is known for two edges.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use bezier_core::QuarticCurve;
use bezier_core::glam::{DMat3, DVec3};
use common::{
    Field, cubic_sheet, cylinder, hyperboloid, jet, on_torus, plane, problem, project,
    quartic_sheet, saddle, torus,
};
use hermite_sqp::{CurveFoot, CurveRefinement, Refined, Settings, refine, solve};
use proptest::prelude::*;

const REFINEMENTS: [CurveRefinement; 2] =
    [CurveRefinement::TangentFixed, CurveRefinement::TangentFree];

fn foot(field: Field) -> impl Fn(DVec3) -> Option<CurveFoot> {
    move |near| {
        let point = project(field, near);
        Some(CurveFoot { point, normal: jet(field, point).normal })
    }
}

/// The same for many points; false where one has no foot.
fn feet(foot: impl Fn(DVec3) -> Option<CurveFoot>) -> impl Fn(&[DVec3], &mut [CurveFoot]) -> bool {
    move |points, feet| {
        feet.iter_mut().zip(points).all(|(slot, &point)| {
            foot(point).is_some_and(|found| {
                *slot = found;
                true
            })
        })
    }
}

/// The curve before and after refinement.
fn run(field: Field, ends: [DVec3; 2], refinement: CurveRefinement) -> (QuarticCurve, Refined) {
    let problem = problem(field, ends);
    let solved = solve(&problem, &Settings::default()).curve;
    (solved, refine(&problem, &solved, refinement, &Settings::default(), &feet(foot(field))))
}

/// Root mean square of the normal distances at the nine parameters of the objective, in chords.
fn normal_distance(field: Field, curve: &QuarticCurve) -> f64 {
    let chord = curve.points[0].distance(curve.points[4]);
    let squares = (1..10).map(|j| {
        let p = curve.eval(f64::from(j) / 10.0);
        let foot = foot(field)(p).expect("every point has a foot");
        ((p - foot.point).dot(foot.normal) / chord).powi(2)
    });
    (squares.sum::<f64>() / 9.0).sqrt()
}

/// Defects of tangent planes and of `4/3 II(d, d) = (q2 - q0)·N` at both ends, in chords.
fn defect(field: Field, curve: &QuarticCurve) -> f64 {
    let q = curve.points;
    let chord = q[0].distance(q[4]);
    [[q[0], q[1], q[2]], [q[4], q[3], q[2]]].into_iter().fold(
        0.0,
        |worst: f64, [end, next, middle]| {
            let data = jet(field, end);
            let tangent = next - end;
            let bend = 4.0 / 3.0 * data.second_form(tangent, tangent);
            let curvature = (bend - (middle - end).dot(data.normal)) / chord;
            worst.max(tangent.dot(data.normal).abs() / chord).max(curvature.abs())
        },
    )
}

fn check(name: &str, field: Field, ends: [DVec3; 2]) {
    for refinement in REFINEMENTS {
        let (before, refined) = run(field, ends, refinement);
        let after = refined.curve;
        assert_eq!([after.points[0], after.points[4]], ends, "{name}: end points are exact");
        let defect = defect(field, &after);
        assert!(defect <= 1e-12, "{name}, {refinement:?}: defect {defect:e}");
        let [before_rms, after_rms] = [before, after].map(|c| normal_distance(field, &c));
        // where both are round-off, their order means nothing
        assert!(
            after_rms <= before_rms.max(8.0 * f64::EPSILON),
            "{name}, {refinement:?}: {before_rms:e} grew to {after_rms:e}"
        );
        assert_eq!(refined.accepted == 0, after == before, "{name}, {refinement:?}");
    }
}

#[test]
fn special_edges() {
    let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let cases: [(&str, Field, [DVec3; 2]); 8] = [
        ("torus", torus, [on_torus(0.1, 0.3), on_torus(0.2, 0.8)]),
        ("plane", plane, [p(0.0, 0.0, 0.0), p(1.0, 2.0, 0.0)]),
        ("cylinder generator", cylinder, [p(1.0, 0.0, 0.0), p(1.0, 0.0, 1.5)]),
        ("hyperboloid ruling", hyperboloid, [p(1.0, 0.0, 0.0), p(1.0, 0.5, 0.5)]),
        ("saddle asymptotic", saddle, [p(0.0, 0.0, 0.0), p(0.0, 0.7, 0.0)]),
        ("inflection", cubic_sheet, [p(-0.3, 0.0, -0.027), p(0.4, 0.1, 0.064)]),
        ("s-curve", cubic_sheet, [p(-0.5, 0.0, -0.125), p(0.5, 0.0, 0.125)]),
        ("flat end", quartic_sheet, [p(0.0, 0.0, 0.0), p(0.5, 0.1, 0.0625)]),
    ];
    for (name, field, ends) in cases {
        check(name, field, ends);
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 60,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn random_edges_of_a_torus(u in 0.0..6.3, v in 0.0..6.3, du in -0.15..0.15, dv in -0.7..0.7) {
        let ends = [on_torus(u, v), on_torus(u + du, v + dv)];
        prop_assume!(ends[0].distance(ends[1]) > 0.05);
        check("random edge", torus, ends);
    }

    /// The edge from its other end gives the curve backwards: at the same distance from the surface,
    /// with the same control points as far as the distance determines them, which it does the less,
    /// the less the surface turns along the edge.
    #[test]
    fn reversal(u in 0.0..6.3, v in 0.0..6.3, du in -0.15..0.15, dv in -0.7..0.7) {
        let ends = [on_torus(u, v), on_torus(u + du, v + dv)];
        let chord = ends[0].distance(ends[1]);
        prop_assume!(chord > 0.05);
        for refinement in REFINEMENTS {
            let forwards = run(torus, ends, refinement).1.curve;
            let backwards = run(torus, [ends[1], ends[0]], refinement).1.curve.reversed();
            let [f, b] = [forwards, backwards].map(|curve| normal_distance(torus, &curve));
            prop_assert!((f - b).abs() <= 1e-11, "{refinement:?}: distances {f:e} and {b:e}");
            let pairs = forwards.points.iter().zip(backwards.points);
            let change = pairs.map(|(p, q)| p.distance(q)).fold(0.0, f64::max) / chord;
            let turning = jet(torus, ends[0]).normal.distance(jet(torus, ends[1]).normal);
            let allowed = if turning >= 0.4 { 1e-6 } else { 1e-4 };
            prop_assert!(change <= allowed, "{refinement:?}: {change:e}, turning by {turning}");
        }
    }
}

/// A vertex of a mesh file, counted from zero.
fn vertex(file: &str, index: usize) -> DVec3 {
    let path = format!("{}/../../fixtures/oracle/tong-kim/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let line = text.lines().filter(|line| line.starts_with("v ")).nth(index).unwrap();
    let numbers: Vec<f64> = line.split_whitespace().skip(1).map(|w| w.parse().unwrap()).collect();
    DVec3::from_slice(&numbers)
}

fn sphere(p: DVec3) -> (f64, DVec3, DMat3) {
    (p.length_squared() - 1.0, p * 2.0, DMat3::from_diagonal(DVec3::splat(2.0)))
}

/// Two curves of an independent implementation, printed with ten decimals.
#[test]
fn known_curves() {
    let cases: [(&str, Field, [usize; 2], [f64; 3]); 2] = [
        ("sphere_200.obj", sphere, [4, 1], [-0.968_561_890_8, -0.281_462_528_4, 0.010_507_186_7]),
        ("torus_600.obj", torus, [3, 2], [-5.982_102_262_0, -0.734_962_579_8, -0.047_172_034_9]),
    ];
    for (file, field, ends, expected) in cases {
        let ends = ends.map(|index| vertex(file, index));
        let refined = run(field, ends, CurveRefinement::TangentFixed).1;
        let distance = refined.curve.points[2].distance(DVec3::from_array(expected));
        assert!(distance <= 1e-9, "{file}: q2 {} off by {distance:e}", refined.curve.points[2]);
    }
}

#[test]
fn nothing_to_do_and_nowhere_to_go() {
    let ends = [on_torus(0.1, 0.3), on_torus(0.2, 0.8)];
    let (before, kept) = run(torus, ends, CurveRefinement::None);
    assert_eq!(kept, Refined { curve: before, accepted: 0 });
    // feet that run out on the way
    let no_foot = |_| None;
    let no_normal = |point| Some(CurveFoot { point, normal: DVec3::NAN });
    let cases: [&dyn Fn(DVec3) -> Option<CurveFoot>; 2] = [&no_foot, &no_normal];
    for foot in cases {
        for refinement in REFINEMENTS {
            let settings = Settings::default();
            let kept = refine(&problem(torus, ends), &before, refinement, &settings, &feet(foot));
            assert_eq!(kept, Refined { curve: before, accepted: 0 }, "{refinement:?}");
        }
    }
}
