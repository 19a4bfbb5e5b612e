//! The blended surface: what it does at vertices, at edges, and near them.

mod common;

use meshfield::glam::DVec3;
use meshfield::implicit::{ImplicitField, TwiceDifferentiable, surface_point};
use meshfield::{ClosestPoint, JetSettings, MeshField, TriangleTree, fit_jets};

fn field() -> MeshField {
    let mesh = common::torus(10);
    let jets = fit_jets(&mesh, &JetSettings::default()).expect("jets");
    MeshField::new(mesh, jets).expect("faces with area")
}

#[test]
fn vertices_have_their_jets() {
    let field = field();
    for (v, jet) in field.jets().iter() {
        let at = field.mesh().position(v);
        let jet = jet.surface_jet().expect("a graph");
        assert_eq!(field.value(at), 0.0, "vertex {v} is on the surface");
        let found = field.surface_jet(at).expect("regular");
        assert!(found.normal.distance(jet.normal) < 1e-14, "vertex {v}");
        let form = found.second_fundamental_form - jet.second_fundamental_form;
        assert!(form.to_cols_array().iter().all(|x| x.abs() < 1e-12), "vertex {v}");
        // the exact Hessian tells the same there
        let exact = surface_point(&field, at).expect("regular");
        let form = exact.second_fundamental_form - jet.second_fundamental_form;
        assert!(form.to_cols_array().iter().all(|x| x.abs() < 1e-12), "vertex {v}");
    }
}

#[test]
fn derivatives_are_those_of_the_value() {
    let field = field();
    let step = 1e-5;
    for face in field.mesh().topology().faces().step_by(7) {
        let [a, b, c] = field.mesh().triangle(face);
        let p = a * 0.5 + b * 0.3 + c * 0.2 + (b - a).cross(c - a) * 0.1;
        let jet = field.jet(p);
        assert_eq!((jet.value, jet.gradient), field.value_gradient(p), "all ways agree");
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let [plus, minus] = [p + axis * step, p - axis * step];
            let slope = (field.value(plus) - field.value(minus)) / (2.0 * step);
            assert!((slope - jet.gradient.dot(axis)).abs() < 1e-7, "face {face}");
            let bend =
                (field.value_gradient(plus).1 - field.value_gradient(minus).1) / (2.0 * step);
            assert!((bend - jet.hessian * axis).length() < 1e-5, "face {face}");
        }
    }
}

/// From one face to the next neither value nor derivatives jump.
#[test]
fn smooth_across_edges() {
    let field = field();
    let mesh = field.mesh();
    let topology = mesh.topology();
    for edge in topology.edges() {
        let h = topology.canonical(edge);
        let [a, b] = topology.edge_vertices(edge).map(|v| mesh.position(v));
        let twin = topology.twin(h).expect("closed");
        let [left, right] = [h, twin].map(|h| mesh.position(topology.origin(h.previous())));
        let middle = a * 0.4 + b * 0.6;
        let near = |towards: DVec3| field.jet(middle + (towards - middle) * 1e-7);
        let (left, right) = (near(left), near(right));
        assert!((left.value - right.value).abs() < 1e-6, "edge {edge}");
        assert!(left.gradient.distance(right.gradient) < 1e-5, "edge {edge}");
        let bend = left.hessian - right.hessian;
        assert!(bend.to_cols_array().iter().all(|x| x.abs() < 1e-3), "edge {edge}: {bend}");
    }
}

#[test]
fn no_meaning_far_from_numbers() {
    let field = field();
    assert!(field.value(DVec3::NAN).is_nan(), "not a number in, not a number out");
    assert_eq!(field.surface_jet(DVec3::splat(f64::INFINITY)), None);
}

#[test]
fn the_tree_finds_the_closest_triangle() {
    let mesh = common::torus(6);
    let triangles: Vec<[DVec3; 3]> = mesh.topology().faces().map(|f| mesh.triangle(f)).collect();
    let tree = TriangleTree::new(triangles.clone());
    for k in 0..400 {
        let [x, y, z] = [12.9898, 78.233, 37.719].map(|c| (f64::from(k) * c).sin() * 5.0);
        let p = DVec3::new(x, y, z);
        let found = tree.closest(p).expect("triangles");
        // squares: two of them may have the same root
        let square = |found: ClosestPoint| found.point.distance_squared(p);
        let alone = |t: &[DVec3; 3]| square(TriangleTree::new(vec![*t]).closest(p).expect("one"));
        let all: Vec<f64> = triangles.iter().map(alone).collect();
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(square(found), least, "point {k}");
        assert_eq!(Some(found.triangle), all.iter().position(|&d| d == least), "point {k}");
    }
    assert_eq!(TriangleTree::new(Vec::new()).closest(DVec3::ZERO), None);
}
