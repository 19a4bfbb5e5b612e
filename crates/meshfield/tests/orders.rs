//! Orders of accuracy, measured on irregular meshes of a torus.

mod common;

use common::Errors;
use meshfield::JetSettings;

/// Slopes of the largest errors may be that much below the order.
const SLACK: f64 = 0.3;

#[test]
fn errors_fall_with_the_order_of_the_degree() {
    for degree in 2..=4 {
        let settings = JetSettings { degree, ..JetSettings::default() };
        let [coarse, fine] = [32, 64].map(|n| common::errors(n, &settings));
        let order = |error: fn(&Errors) -> f64| (error(&coarse) / error(&fine)).log2();
        let d = degree as f64;
        for (what, order, expected) in [
            ("normals at vertices", order(|e| e.normal), d),
            ("curvatures at vertices", order(|e| e.form), d - 1.0),
            ("positions between them", order(|e| e.blended_position), d + 1.0),
            ("normals between them", order(|e| e.blended_normal), d),
            ("curvatures between them", order(|e| e.blended_form), d - 1.0),
        ] {
            println!("degree {degree}, {what}: order {order:.2}, expected {expected}");
            assert!(order > expected - SLACK, "degree {degree}, {what}: {order:.2}");
        }
    }
}

#[test]
fn size_does_not_matter() {
    let settings = JetSettings::default();
    let mesh = common::torus(12);
    let jets = meshfield::fit_jets(&mesh, &settings).expect("jets");
    for scale in [2.0_f64.powi(-30), 2.0_f64.powi(40)] {
        let positions = mesh.positions().map(|_, p| *p * scale);
        let scaled = mesh.clone().with_positions(positions).expect("finite");
        let scaled = meshfield::fit_jets(&scaled, &settings).expect("jets");
        for (v, jet) in jets.iter() {
            let [a, b] = [jet, &scaled[v]].map(|jet| jet.surface_jet().expect("a graph"));
            assert_eq!(a.normal, b.normal, "vertex {v}");
            assert_eq!(a.second_fundamental_form, b.second_fundamental_form * scale, "vertex {v}");
        }
    }
}
