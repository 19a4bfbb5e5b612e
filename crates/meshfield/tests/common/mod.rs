//! A torus as a mesh, and how far jets and field are from it.

#![allow(dead_code, unreachable_pub, reason = "every test uses a part")]

use std::f64::consts::TAU;

use meshfield::basemesh::TriMesh;
use meshfield::glam::{DMat3, DVec3};
use meshfield::implicit::{
    self, ImplicitField, ProjectionSettings, project_with_gradient, surface_point,
};
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
    let grid = || (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    let faces: Vec<[usize; 3]> = grid()
        .flat_map(|(i, j)| {
            let (a, b, c, d) = (id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
            [[a, b, c], [a, c, d]]
        })
        .collect();
    TriMesh::new(grid().map(|(i, j)| position(i, j)).collect(), &faces).expect("a torus")
}

/// Largest errors: at the vertices, and of the blended surface between them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    pub normal: f64,
    pub form: f64,
    pub blended_position: f64,
    pub blended_normal: f64,
    pub blended_form: f64,
}

fn largest_entry(difference: DMat3) -> f64 {
    difference.to_cols_array().into_iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Errors on the torus with so many steps.
pub fn errors(n: usize, settings: &JetSettings) -> Errors {
    let exact = implicit::Torus { major_radius: 3.0, minor_radius: 1.0 };
    let truth = |p: DVec3| surface_point(&exact, p).expect("regular");
    let mesh = torus(n);
    let jets = fit_jets(&mesh, settings).expect("jets");
    let mut errors = Errors::default();
    for (v, jet) in jets.iter() {
        let (jet, truth) = (jet.surface_jet().expect("a graph"), truth(mesh.position(v)));
        let form = jet.second_fundamental_form - truth.second_fundamental_form;
        errors.normal = errors.normal.max(jet.normal.distance(truth.normal));
        errors.form = errors.form.max(largest_entry(form));
    }
    let field = MeshField::new(mesh, jets).expect("faces with area");
    for face in field.mesh().topology().faces() {
        let [a, b, c] = field.mesh().triangle(face);
        for [u, v, w] in [[1.0, 1.0, 1.0], [4.0, 2.0, 1.0], [0.0, 1.0, 1.0]] {
            let p = (a * u + b * v + c * w) / (u + v + w);
            let (foot, normal) =
                project_with_gradient(&field, p, 1.0, &ProjectionSettings::default())
                    .expect("a foot");
            let (value, gradient) = exact.value_gradient(foot);
            let form = field.surface_jet(foot).expect("regular").second_fundamental_form
                - truth(foot).second_fundamental_form;
            errors.blended_position = errors.blended_position.max(value.abs() / gradient.length());
            errors.blended_normal = errors.blended_normal.max(normal.distance(truth(foot).normal));
            errors.blended_form = errors.blended_form.max(largest_entry(form));
        }
    }
    errors
}
