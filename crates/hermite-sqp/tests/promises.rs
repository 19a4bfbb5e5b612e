//! What the curves promise: interpolation, order, special edges, exact scaling.

mod common;

use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, SurfaceJet};
use common::{
    Field, cubic_sheet, cylinder, hyperboloid, jet, on_torus, plane, problem, project,
    quartic_sheet, saddle, torus,
};
use hermite_sqp::{CurveSample, EdgeProblem, EdgeProblemError, EdgeStatus, Settings, solve};

/// Largest defect of end points, end tangent planes and end curvatures, in chord lengths.
fn interpolation_defect(field: Field, ends: [DVec3; 2], curve: &QuarticCurve) -> f64 {
    let chord = ends[0].distance(ends[1]);
    [(0.0, ends[0]), (1.0, ends[1])].into_iter().fold(0.0, |worst: f64, (t, end)| {
        let data = jet(field, end);
        let at = curve.jet(t);
        assert_eq!(at.value, end, "end points are exact");
        let tangency = at.first.normalize().dot(data.normal).abs();
        let curvature = at.second.dot(data.normal) / at.first.length_squared()
            - data.normal_curvature(at.first.normalize());
        worst.max(tangency).max(curvature.abs() * chord)
    })
}

#[test]
fn special_edges_converge_and_interpolate() {
    let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let ruling = |s: f64| p(1.0, s, s);
    let cases: [(&str, Field, [DVec3; 2]); 9] = [
        ("torus", torus, [on_torus(0.1, 0.3), on_torus(0.2, 0.8)]),
        ("plane", plane, [p(0.0, 0.0, 0.0), p(1.0, 2.0, 0.0)]),
        ("cylinder generator", cylinder, [p(1.0, 0.0, 0.0), p(1.0, 0.0, 1.5)]),
        ("near a generator", cylinder, [p(1.0, 0.0, 0.0), project(cylinder, p(1.0, 1e-5, 1.5))]),
        ("hyperboloid ruling", hyperboloid, [ruling(0.0), ruling(0.5)]),
        ("saddle asymptotic", saddle, [p(0.0, 0.0, 0.0), p(0.0, 0.7, 0.0)]),
        ("inflection", cubic_sheet, [p(-0.3, 0.0, -0.027), p(0.4, 0.1, 0.064)]),
        ("s-curve", cubic_sheet, [p(-0.5, 0.0, -0.125), p(0.5, 0.0, 0.125)]),
        ("flat end", quartic_sheet, [p(0.0, 0.0, 0.0), p(0.5, 0.1, 0.0625)]),
    ];
    for (name, field, ends) in cases {
        let outcome = solve(&problem(field, ends), &Settings::default());
        let EdgeStatus::Converged { published_iterations, .. } = outcome.status else {
            panic!("{name}: {:?}", outcome.status);
        };
        assert!(published_iterations <= 4, "{name}: {published_iterations} iterations");
        let defect = interpolation_defect(field, ends, &outcome.curve);
        assert!(defect <= 1e-12, "{name}: defect {defect:e}");
    }
}

/// Slope of the largest deviation over three halvings of an edge around a fixed point.
#[test]
fn deviation_has_order_six() {
    let deviation = |h: f64| {
        let ends = [-0.5, 0.5].map(|s| on_torus(0.3 + 0.13 * h * s, 0.7 + 0.5 * h * s));
        let curve = solve(&problem(torus, ends), &Settings::default()).curve;
        (1..40).fold(0.0_f64, |max, j| {
            let p = curve.eval(f64::from(j) / 40.0);
            let (f, g, _) = torus(p);
            max.max((f / g.length()).abs())
        })
    };
    let errors: Vec<f64> = [1.0, 0.5, 0.25, 0.125].into_iter().map(deviation).collect();
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!(order >= 5.8, "observed order {order:.2} of {errors:?}");
}

#[test]
fn under_resolved_edges_fall_back_and_keep_their_curvature() {
    // 150 degrees of a torus's small circle: the end tangents would be far too long
    let ends = [on_torus(0.0, 0.1), on_torus(0.0, 2.7)];
    let outcome = solve(&problem(torus, ends), &Settings::default());
    assert!(outcome.status.is_fallback(), "{:?}", outcome.status);
    let defect = interpolation_defect(torus, ends, &outcome.curve);
    assert!(defect <= 1e-12, "defect {defect:e}");
}

#[test]
fn scaling_by_a_power_of_two_is_exact() {
    let scale = 4096.0;
    let ends = [on_torus(0.1, 0.3), on_torus(0.25, 1.1)];
    let samples: Vec<_> = (1..10)
        .map(|j| f64::from(j) / 10.0)
        .map(|t| CurveSample { t, point: project(torus, ends[0].lerp(ends[1], t)) })
        .collect();
    let scaled_jet = |j: SurfaceJet| SurfaceJet {
        point: j.point * scale,
        normal: j.normal,
        second_fundamental_form: j.second_fundamental_form * (1.0 / scale),
    };
    let scaled_samples: Vec<_> =
        samples.iter().map(|s| CurveSample { t: s.t, point: s.point * scale }).collect();
    let [a, b] = ends.map(|p| jet(torus, p));
    let settings = Settings::default();
    let original = solve(&EdgeProblem::new(&a, &b, &samples).unwrap(), &settings);
    let scaled = solve(
        &EdgeProblem::new(&scaled_jet(a), &scaled_jet(b), &scaled_samples).unwrap(),
        &settings,
    );
    assert_eq!(scaled.status, original.status);
    assert_eq!(scaled.curve.points, original.curve.points.map(|p| p * scale));
}

#[test]
fn impossible_edges_are_refused() {
    let at = |z: f64| jet(plane, DVec3::new(0.0, 0.0, z));
    let refuse = |a, b| EdgeProblem::new(&a, &b, &[]).map(|_| ()).unwrap_err();
    assert_eq!(refuse(at(0.0), at(0.0)), EdgeProblemError::NoChord);
    assert_eq!(refuse(at(0.0), at(1.0)), EdgeProblemError::ChordAlongNormal { end: 0 });
}
