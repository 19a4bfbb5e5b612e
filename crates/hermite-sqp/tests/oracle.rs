//! Every curve that an independent implementation computed for the two given base meshes.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use bezier_core::SurfaceJet;
use bezier_core::glam::{DMat3, DVec3};
use hermite_sqp::{CurveSample, EdgeProblem, EdgeStatus, Settings, solve};
use serde_json::Value;

mod common;

fn oracle() -> Value {
    let path =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/oracle/tong-kim/reference.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn vector(v: &Value) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| v[i].as_f64().unwrap()))
}

fn sphere(p: DVec3) -> (f64, DVec3, DMat3) {
    (p.length_squared() - 1.0, p * 2.0, DMat3::from_diagonal(DVec3::splat(2.0)))
}

/// `N`, `t`, `k` as the oracle states them; the edge's surface has them by construction.
fn end(point: &Value, normal: &Value, field: common::Field) -> SurfaceJet {
    let mut jet = common::jet(field, vector(point));
    jet.normal = vector(normal);
    jet
}

#[test]
fn curves_agree() {
    let oracle = oracle();
    // the oracle stopped at this tolerance
    let settings = Settings { tolerance: 1e-13, ..Settings::default() };
    let models: [(&str, common::Field); 2] = [("sphere", sphere), ("torus", common::torus)];
    for (model, field) in models {
        for edge in oracle[model]["edges"].as_array().unwrap() {
            let name = format!("{model} edge {}-{}", edge["a"], edge["b"]);
            let (a, b) =
                (end(&edge["q0"], &edge["N0"], field), end(&edge["q4"], &edge["N1"], field));
            let samples: Vec<_> = (1..10)
                .map(|j| f64::from(j) / 10.0)
                .map(|t| CurveSample { t, point: common::project(field, a.point.lerp(b.point, t)) })
                .collect();
            let outcome = solve(&EdgeProblem::new(&a, &b, &samples).unwrap(), &settings);
            let EdgeStatus::Converged { published_iterations, .. } = outcome.status else {
                panic!("{name}: {:?}", outcome.status);
            };
            let q = outcome.curve.points;
            let near = |got: f64, expected: &Value, what: &str| {
                let expected = expected.as_f64().unwrap();
                assert!((got - expected).abs() <= 1e-12 * expected.abs(), "{name}: {what} {got}");
            };
            near(q[1].distance(q[0]), &edge["lam"], "lambda");
            near(q[3].distance(q[4]), &edge["mu"], "mu");
            let q2 = vector(&edge["q2"]);
            assert!(q[2].distance(q2) <= 1e-12 * q2.length(), "{name}: q2 {}", q[2]);
            assert_eq!(Some(published_iterations as u64), edge["its_at_1e_6"].as_u64(), "{name}");
        }
    }
}
