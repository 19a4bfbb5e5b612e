//! The meshes of Figure 5, with the errors of an independent implementation on the same meshes.

use std::ops::Range;

use anyhow::Result;
use smoothpatch::basemesh::VertexId;
use smoothpatch::nagata::{Apex, CornerNormals, PolygonMesh};
use testkit::polygons::{self, CONE, CYLINDER, FileNormals, Grid, KnownSurface, SPHERE, TORUS};

/// A surface with meshes of several sizes.
#[derive(Clone)]
pub(super) struct Family {
    pub(super) name: &'static str,
    pub(super) truth: KnownSurface,
    pub(super) mesh: fn(usize) -> Sample,
    pub(super) sizes: Vec<usize>,
    /// The sizes that are measured without `--full`.
    pub(super) usual: Range<usize>,
    /// Largest distances to be expected of the C0 patches, one for each size.
    pub(super) position: Vec<f64>,
    /// Those of the printed G1 patches; none for quadrilaterals.
    pub(super) smooth: Vec<f64>,
    /// The order that is asked for.
    pub(super) order: f64,
    pub(super) euler: i64,
}

/// A mesh with its normals; only the first `faces` faces are on the surface, the others are flat.
pub(super) struct Sample {
    pub(super) mesh: PolygonMesh,
    pub(super) normals: CornerNormals,
    pub(super) faces: usize,
}

pub(super) fn mesh(grid: &Grid) -> Result<PolygonMesh> {
    Ok(PolygonMesh::new(grid.positions.clone(), &grid.faces)?)
}

pub(super) fn families() -> Vec<Family> {
    let powers = || vec![1, 2, 4, 8, 16, 32, 64];
    vec![
        Family {
            name: "sphere",
            truth: SPHERE,
            mesh: sphere,
            sizes: powers(),
            usual: 3..5,
            position: vec![6.07e-2, 1.04e-2, 9.47e-4, 6.61e-5, 4.22e-6, 2.68e-7, 1.68e-8],
            smooth: vec![6.07e-2, 1.14e-2, 1.10e-3, 7.79e-5, 5.01e-6, 3.10e-7, 1.94e-8],
            order: 3.9,
            euler: 2,
        },
        Family {
            name: "cylinder with rims",
            truth: CYLINDER,
            mesh: cylinder,
            sizes: powers(),
            usual: 2..4,
            position: vec![1.04e-2, 6.01e-4, 3.69e-5, 2.28e-6, 1.40e-7, 8.96e-9, 5.60e-10],
            smooth: vec![1.04e-2, 6.01e-4, 3.69e-5, 2.28e-6, 1.40e-7, 8.96e-9, 5.60e-10],
            order: 3.9,
            euler: 2,
        },
        Family {
            name: "torus",
            truth: TORUS,
            mesh: torus,
            sizes: powers(),
            usual: 3..5,
            position: vec![3.50e-1, 1.72e-2, 1.74e-3, 1.90e-4, 2.15e-5, 2.57e-6, 3.15e-7],
            smooth: vec![4.02e-1, 1.85e-2, 1.90e-3, 2.13e-4, 2.51e-5, 3.05e-6, 3.76e-7],
            order: 2.9,
            euler: 0,
        },
        Family {
            name: "torus of quads",
            truth: TORUS,
            mesh: torus_of_quads,
            sizes: vec![6, 12, 24, 48, 96],
            usual: 1..3,
            position: vec![1.91e-2, 1.45e-3, 9.35e-5, 5.88e-6, 3.68e-7],
            smooth: Vec::new(),
            order: 3.9,
            euler: 0,
        },
        Family {
            name: "cone, no normal at the apex",
            truth: CONE,
            mesh: |k| cone(k, Apex::NoNormal),
            sizes: powers(),
            usual: 3..5,
            position: vec![2.20e-2, 3.01e-3, 3.78e-4, 4.72e-5, 5.87e-6, 7.39e-7, 9.24e-8],
            smooth: vec![2.40e-2, 3.03e-3, 3.79e-4, 4.72e-5, 5.87e-6, 7.40e-7, 9.24e-8],
            order: 2.9,
            euler: 2,
        },
        Family {
            name: "cone, a normal per face",
            truth: CONE,
            mesh: |k| cone(k, Apex::FaceNormals),
            sizes: powers(),
            usual: 3..5,
            position: vec![1.04e-2, 6.01e-4, 6.38e-5, 7.97e-6, 1.00e-6, 1.23e-7, 1.54e-8],
            smooth: vec![1.04e-2, 1.55e-3, 1.95e-4, 2.43e-5, 2.99e-6, 3.57e-7, 4.46e-8],
            order: 2.9,
            euler: 2,
        },
    ]
}

fn known(grid: &Grid) -> PolygonMesh {
    mesh(grid).expect("invariant: the grid is a mesh")
}

fn on(grid: &Grid, truth: &KnownSurface) -> Sample {
    let mesh = known(grid);
    let normals = CornerNormals::from_fn(&mesh, |p| Some((truth.normal)(p)));
    Sample { mesh, normals, faces: usize::MAX }
}

fn with_flat_ends(grid: &Grid, faces: usize, truth: &KnownSurface) -> Sample {
    let FileNormals { normals, corners } = grid.rimmed_normals(faces, truth.normal);
    let mesh = known(grid);
    let merge = CornerNormals::MERGE_ANGLE;
    let normals = CornerNormals::from_corners(&mesh, &normals, &corners, merge)
        .expect("invariant: one unit normal for each corner");
    Sample { mesh, normals, faces }
}

fn sphere(n: usize) -> Sample {
    on(&polygons::sphere(n), &SPHERE)
}

fn torus(k: usize) -> Sample {
    on(&polygons::torus(6 * k, 3 * k, true), &TORUS)
}

fn torus_of_quads(n: usize) -> Sample {
    on(&polygons::torus(2 * n, n, false), &TORUS)
}

fn cylinder(k: usize) -> Sample {
    with_flat_ends(&polygons::cylinder(6 * k, k, true), 12 * k * k, &CYLINDER)
}

fn cone(k: usize, apex: Apex) -> Sample {
    let mut sample = with_flat_ends(&polygons::cone(k), polygons::cone_side_faces(k), &CONE);
    sample.normals = sample.normals.with_apexes(&sample.mesh, &[VertexId::new(0)], apex);
    sample
}
