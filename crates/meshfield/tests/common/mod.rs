//! A torus as a mesh, and how far jets and field are from it.

use std::f64::consts::TAU;

use meshfield::basemesh::TriMesh;
use meshfield::glam::DVec3;
use meshfield::implicit::{self, ImplicitField, ProjectionSettings, project_with_gradient};
use meshfield::{JetSettings, MeshField, fit_jets};

/// Radii 3 and 1; `2 n` by `n` vertices that are moved along the surface by a part of the step.
pub fn torus(n: usize) -> TriMesh {
    let (around, across) = (2 * n, n);
    let wobble = |k: usize| 0.3 * (((k * 7919) % 101) as f64 / 101.0 - 0.5);
    let position = |i: usize, j: usize| {
        let k = i * across + j;
        let p = TAU * (i as f64 + wobble(k)) / around as f64;
        let q = TAU * (j as f64 + wobble(k + 40)) / across as f64;
        DVec3::new((3.0 + q.cos()) * p.cos(), (3.0 + q.cos()) * p.sin(), q.sin())
    };
    let id = |i: usize, j: usize| i % around * across + j % across;
    let mut faces = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let (a, b, c, d) = (id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    let positions = (0..around).flat_map(|i| (0..across).map(move |j| position(i, j))).collect();
    TriMesh::new(positions, &faces).expect("a torus")
}

/// Largest errors: normals and curvatures at vertices; positions, normals and curvatures of the field at centres of faces.
pub fn errors(n: usize, settings: &JetSettings) -> [f64; 5] {
    let exact = implicit::Torus { major_radius: 3.0, minor_radius: 1.0 };
    let mesh = torus(n);
    let jets = fit_jets(&mesh, settings).expect("jets");
    let mut errors = [0.0_f64; 5];
    for (v, jet) in jets.iter() {
        let jet = jet.surface_jet().expect("a graph");
        let truth = implicit::surface_point(&exact, mesh.position(v)).expect("regular");
        errors[0] = errors[0].max(jet.normal.distance(truth.normal));
        let difference = jet.second_fundamental_form - truth.second_fundamental_form;
        errors[1] =
            errors[1].max(difference.to_cols_array().iter().fold(0.0, |m, d| m.max(d.abs())));
    }
    let field = MeshField::new(mesh, jets).expect("faces with area");
    let settings = ProjectionSettings::default();
    for face in field.mesh().topology().faces() {
        let [a, b, c] = field.mesh().triangle(face);
        for [u, v, w] in [[1.0, 1.0, 1.0], [4.0, 2.0, 1.0], [0.0, 1.0, 1.0]] {
            let p = (a * u + b * v + c * w) / (u + v + w);
            let (foot, normal) = project_with_gradient(&field, p, 1.0, &settings).expect("a foot");
            let truth = implicit::surface_point(&exact, foot).expect("regular");
            errors[2] =
                errors[2].max(exact.value(foot).abs() / exact.value_gradient(foot).1.length());
            errors[3] = errors[3].max(normal.distance(truth.normal));
            let ours = implicit::surface_point(&field, foot).expect("regular");
            let difference = ours.second_fundamental_form - truth.second_fundamental_form;
            errors[4] =
                errors[4].max(difference.to_cols_array().iter().fold(0.0, |m, d| m.max(d.abs())));
        }
    }
    errors
}
