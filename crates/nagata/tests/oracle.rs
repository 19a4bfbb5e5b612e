//! Every number of an independent implementation.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use nagata::bezier_core::{Barycentric, Corner, LocalEdge};
use nagata::glam::DVec3;
use nagata::{
    CorrectionSettings, CurvatureParameter, EdgeCurve, EdgeNormals, EdgeSettings, G1Triangle,
    NagataQuad, NagataTriangle, TangentPlanes, curvature_parameter,
};
use serde_json::Value;

const TOLERANCE: f64 = 1e-12;

fn oracle() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/oracle/nagata/reference.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn list(v: &Value) -> &Vec<Value> {
    v.as_array().unwrap()
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap()
}

fn vector(v: &Value) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| number(&v[i])))
}

fn vectors(v: &Value) -> Vec<DVec3> {
    list(v).iter().map(vector).collect()
}

fn three(v: &Value) -> [DVec3; 3] {
    vectors(v).try_into().unwrap()
}

/// `scale`: the size of what the value is a sum of.
fn near(got: DVec3, expected: &Value, scale: f64, what: &str) {
    let expected = vector(expected);
    let error = got.distance(expected);
    assert!(error <= TOLERANCE * scale.max(expected.length()), "{what}: {got} is not {expected}");
}

/// Rank, plus ten if a limit lowered it.
fn branch(found: &CurvatureParameter) -> u64 {
    u64::from(found.status.rank) + if found.status.lowered.is_some() { 10 } else { 0 }
}

fn settings(max_curvature: &Value, rank: &Value) -> EdgeSettings {
    EdgeSettings {
        rank: number(rank),
        max_curvature: max_curvature.as_f64(),
        ..EdgeSettings::PUBLISHED
    }
}

#[test]
fn curvature_parameters_of_edges() {
    for (at, edge) in list(&oracle()["edges"]).iter().enumerate() {
        let (start, end) = (vectors(&edge["normals0"]), vectors(&edge["normals1"]));
        let d = vector(&edge["d"]);
        let found = curvature_parameter(
            d,
            EdgeNormals { start: &start, end: &end },
            &settings(&edge["delta_c"], &edge["eps"]),
        );
        near(found.value, &edge["C"], d.length(), &format!("edge {at}"));
        assert_eq!(Some(branch(&found)), edge["branch"].as_u64(), "edge {at}");
    }
}

#[test]
fn triangles() {
    let oracle = oracle();
    let settings = settings(&oracle["params"]["delta_c"], &oracle["params"]["eps"]);
    for triangle in list(&oracle["triangles"]) {
        let name = triangle["name"].as_str().unwrap();
        let corners = three(&triangle["P"]);
        let curvature = Corner::ALL.map(|corner| {
            let i = corner.index();
            let edge = LocalEdge::opposite(corner);
            let normals = &triangle["edge_normals"][i];
            let (start, end) = (vectors(&normals[0]), vectors(&normals[1]));
            let chord = corners[edge.end().index()] - corners[edge.start().index()];
            let ends = EdgeNormals { start: &start, end: &end };
            let found = curvature_parameter(chord, ends, &settings);
            near(found.value, &triangle["C"][i], chord.length(), &format!("{name}: C {i}"));
            assert_eq!(Some(branch(&found)), triangle["C_branch"][i].as_u64(), "{name}: C {i}");
            found.value
        });
        c0_patch(name, triangle, &NagataTriangle { corners, curvature });
        published_patch(name, triangle, corners, curvature);
    }
}

fn size(corners: &[DVec3]) -> f64 {
    corners.iter().map(|p| p.length()).fold(0.0, f64::max)
}

fn c0_patch(name: &str, triangle: &Value, patch: &NagataTriangle) {
    let scale = size(&patch.corners);
    let monomials = list(&triangle["monomial_c00_c10_c01_c11_c20_c02"]);
    for (m, (got, expected)) in patch.monomials().into_iter().zip(monomials).enumerate() {
        near(got, expected, scale, &format!("{name}: monomial {m}"));
    }
    for corner in Corner::ALL {
        let normal = patch.corner_normal(corner).unwrap();
        near(normal, &triangle["nhat"][corner.index()], 1.0, &format!("{name}: corner normal"));
    }
    for (s, at) in list(&triangle["barycentric"]).iter().enumerate() {
        let at = Barycentric::from_array(vector(at).to_array());
        let c0 = &triangle["C0"];
        sample(name, c0, s, scale, (patch.point(at), patch.partials(at), patch.normal(at)));
        // the same polynomial as a Bézier triangle
        near(patch.bezier().eval(at), &c0["x"][s], scale, &format!("{name}: Bézier point {s}"));
    }
}

fn published_patch(name: &str, triangle: &Value, corners: [DVec3; 3], curvature: [DVec3; 3]) {
    let edges = curvature.map(EdgeCurve::quadratic);
    let settings = CorrectionSettings::default();
    let patch = G1Triangle::new(corners, edges, [None; 3], TangentPlanes::Published, &settings);
    let scale = size(&corners);
    for corner in Corner::ALL {
        let (i, edge) = (corner.index(), LocalEdge::opposite(corner));
        near(patch.correction(edge, 0.3), &triangle["gamma"][i], scale, &format!("{name}: γ {i}"));
        let status = patch.correction_status(edge);
        let branch = triangle["gamma_branch"][i].as_u64();
        assert_eq!(Some(u64::from(status.rank)), branch, "{name}: γ {i}");
        let product = number(&triangle["c"][i]) * number(&triangle["d"][i]);
        assert_eq!(status.inflection, product < -1e-12, "{name}: inflection {i}, {product}");
    }
    for (s, at) in list(&triangle["barycentric"]).iter().enumerate() {
        let at = Barycentric::from_array(vector(at).to_array());
        let g1 = &triangle["G1"];
        sample(name, g1, s, scale, (patch.point(at), patch.partials(at), patch.normal(at)));
    }
}

/// The values at sample `s`: point, derivatives `D_i` and normal.
fn sample(
    name: &str,
    expected: &Value,
    s: usize,
    scale: f64,
    (point, [d0, d1, d2], normal): (DVec3, [DVec3; 3], Option<DVec3>),
) {
    near(point, &expected["x"][s], scale, &format!("{name}: point {s}"));
    near(d1 - d0, &expected["x_eta"][s], scale, &format!("{name}: x_eta {s}"));
    near(d2 - d1, &expected["x_zeta"][s], scale, &format!("{name}: x_zeta {s}"));
    near(normal.unwrap(), &expected["normal"][s], 1.0, &format!("{name}: normal {s}"));
}

#[test]
fn quadrilaterals() {
    let oracle = oracle();
    let settings = settings(&oracle["params"]["delta_c"], &oracle["params"]["eps"]);
    for quad in list(&oracle["quads"]) {
        let corners: [DVec3; 4] = vectors(&quad["P_00_10_11_01"]).try_into().unwrap();
        let normals: [DVec3; 4] = vectors(&quad["n_00_10_11_01"]).try_into().unwrap();
        let patch = NagataQuad::from_normals(corners, normals, &settings);
        let scale = size(&corners);
        for side in 0..4 {
            // sides in the order of the oracle: 00-10, 10-11, 01-11, 00-01
            near(patch.curvature[side], &quad["C_00_10__10_11__01_11__00_01"][side], scale, "C");
        }
        let monomials = list(&quad["c00_c10_c01_c11_c20_c02_c21_c12"]);
        for (got, expected) in patch.monomials().into_iter().zip(monomials) {
            near(got, expected, scale, "monomial");
        }
        for (s, at) in list(&quad["eta_zeta"]).iter().enumerate() {
            let at = [number(&at[0]), number(&at[1])];
            let jet = patch.jet(at);
            near(jet.point, &quad["x"][s], scale, "point");
            near(jet.du, &quad["x_eta"][s], scale, "x_eta");
            near(jet.dv, &quad["x_zeta"][s], scale, "x_zeta");
            near(patch.normal(at).unwrap(), &quad["normal"][s], 1.0, "normal");
        }
    }
}

#[test]
fn robust_patches() {
    let oracle = oracle();
    let triangles = list(&oracle["triangles"]);
    let mut compared = 0;
    for extended in list(&oracle["extended_triangles"]) {
        // the corners are those of the triangle of the same name; one is not in the set
        let Some(triangle) = triangles.iter().find(|t| t["name"] == extended["name"]) else {
            continue;
        };
        let name = extended["name"].as_str().unwrap();
        let corners = three(&triangle["P"]);
        let (a, b) = (three(&extended["A"]), three(&extended["B"]));
        let edges = std::array::from_fn(|i| EdgeCurve {
            curvature: (a[i] + b[i]) * 0.5,
            skew: (a[i] - b[i]) * 0.5,
        });
        let settings = CorrectionSettings::default();
        let patch = G1Triangle::new(corners, edges, [None; 3], TangentPlanes::Robust, &settings);
        for (s, at) in list(&triangle["barycentric"]).iter().enumerate() {
            let at = Barycentric::from_array(vector(at).to_array());
            near(patch.point(at), &extended["x"][s], size(&corners), &format!("{name}: x {s}"));
            near(patch.normal(at).unwrap(), &extended["normal"][s], 1.0, &format!("{name}: n {s}"));
            compared += 1;
        }
    }
    assert_eq!(compared, 10, "points compared");
}
