//! Given base meshes and oracle data, shared by the test files of this crate.
#![allow(dead_code, reason = "each test file uses a part")]
#![allow(clippy::unwrap_used, unreachable_pub, reason = "test helpers")]

use serde_json::Value;
use smoothpatch::basemesh::TriMesh;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::implicit::{ImplicitSurface, Sphere, Torus};
use smoothpatch::{G1Surface, Method, Settings, Silent, fit_base_mesh};

const ORACLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/oracle/tong-kim/");

/// Numbers of an independent implementation; see fixtures/README.md for their origin.
pub fn oracle() -> Value {
    serde_json::from_str(&std::fs::read_to_string(format!("{ORACLE}reference.json")).unwrap())
        .unwrap()
}

/// A base mesh exactly as the independent implementation used it.
pub fn oracle_mesh(file: &str) -> TriMesh {
    let text = std::fs::read_to_string(format!("{ORACLE}{file}")).unwrap();
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let c: Vec<f64> = words.map(|w| w.parse().unwrap()).collect();
                positions.push(DVec3::new(c[0], c[1], c[2]));
            }
            Some("f") => {
                let i: Vec<usize> = words.map(|w| w.parse::<usize>().unwrap() - 1).collect();
                faces.push([i[0], i[1], i[2]]);
            }
            _ => {}
        }
    }
    TriMesh::new(positions, &faces).unwrap()
}

/// The two models of the oracle: name, field, mesh.
pub fn models() -> [(&'static str, Box<dyn ImplicitSurface>, TriMesh); 2] {
    [
        ("sphere", Box::new(Sphere::default()), oracle_mesh("sphere_200.obj")),
        ("torus", Box::new(Torus::default()), oracle_mesh("torus_600.obj")),
    ]
}

/// The published construction, with curves as converged as the oracle's.
pub fn fit(field: &dyn ImplicitSurface, mesh: TriMesh) -> G1Surface {
    let mut settings =
        Settings::with_faces(mesh.topology().face_count()).with_method(Method::Published);
    settings.curves.tolerance = 1e-13;
    fit_base_mesh(field, mesh, &settings, &mut Silent).unwrap()
}

pub fn vector(v: &Value) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| v[i].as_f64().unwrap()))
}

pub fn vectors(v: &Value) -> Vec<DVec3> {
    v.as_array().unwrap().iter().map(vector).collect()
}

pub fn numbers(v: &Value) -> Vec<f64> {
    v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}
