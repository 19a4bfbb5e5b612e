//! Orders of approximation, and the figures of an independent implementation on the same meshes.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::GridMesh as _;

use common::{CONE, CYLINDER, SPHERE, TORUS, build, errors};
use nagata::{Apex, CornerNormals, PolygonMesh, Settings};

/// Largest distance from the surface for C0, published and robust patches.
fn distances(
    mesh: &PolygonMesh,
    normals: &CornerNormals,
    faces: usize,
    truth: &common::KnownSurface,
) -> [f64; 3] {
    [Settings::position(), Settings::published(), Settings::tangent_plane()]
        .map(|settings| errors(&build(mesh, normals, settings), faces, truth, 16)[0])
}

fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

fn near(got: f64, expected: f64) {
    assert!((got / expected - 1.0).abs() <= 0.1, "{got:.3e} is not {expected:.3e}");
}

fn sphere(n: usize) -> [f64; 3] {
    let mesh = common::sphere(n).mesh();
    distances(&mesh, &common::smooth(&mesh, &SPHERE), usize::MAX, &SPHERE)
}

#[test]
fn spheres_have_order_4() {
    let (coarse, fine) = (sphere(8), sphere(16));
    near(coarse[0], 6.61e-5);
    near(coarse[1], 7.79e-5);
    for (kind, (coarse, fine)) in coarse.into_iter().zip(fine).enumerate() {
        let order = order(coarse, fine);
        assert!(order >= 3.9, "{kind}: {order:.2} from {coarse:.2e}");
    }
}

fn cylinder(k: usize) -> [f64; 3] {
    let mesh = common::cylinder(6 * k, k, true).mesh();
    let normals = common::cylinder_normals(&mesh, k, 6 * k);
    distances(&mesh, &normals, 12 * k * k, &CYLINDER)
}

#[test]
fn cylinders_with_rims_have_order_4() {
    let (coarse, fine) = (cylinder(4), cylinder(8));
    near(coarse[0], 3.69e-5);
    near(coarse[1], 3.69e-5);
    for (kind, (coarse, fine)) in coarse.into_iter().zip(fine).enumerate() {
        let order = order(coarse, fine);
        assert!(order >= 3.9, "{kind}: {order:.2} from {coarse:.2e}");
    }
}

fn torus(k: usize) -> [f64; 3] {
    let mesh = common::torus(6 * k, 3 * k, true).mesh();
    distances(&mesh, &common::smooth(&mesh, &TORUS), usize::MAX, &TORUS)
}

#[test]
fn tori_of_triangles_have_order_3() {
    let (coarse, fine) = (torus(4), torus(8));
    near(coarse[0], 1.74e-3);
    near(coarse[1], 1.90e-3);
    for (kind, (coarse, fine)) in coarse.into_iter().zip(fine).enumerate() {
        let order = order(coarse, fine);
        assert!(order >= 2.9, "{kind}: {order:.2} from {coarse:.2e}");
    }
}

fn torus_of_quads(n: usize) -> f64 {
    let mesh = common::torus(2 * n, n, false).mesh();
    let surface = build(&mesh, &common::smooth(&mesh, &TORUS), Settings::position());
    errors(&surface, usize::MAX, &TORUS, 16)[0]
}

#[test]
fn tori_of_quadrilaterals_have_order_4() {
    let (coarse, fine) = (torus_of_quads(12), torus_of_quads(24));
    near(coarse, 1.45e-3);
    near(fine, 9.35e-5);
    let order = order(coarse, fine);
    assert!(order >= 3.9, "{order:.2}");
}

fn cone(k: usize, apex: Apex) -> [f64; 3] {
    let mesh = common::cone(k).mesh();
    distances(&mesh, &common::cone_normals(&mesh, k, apex), common::cone_side_faces(k), &CONE)
}

#[test]
fn cones_have_order_3() {
    for (apex, expected) in
        [(Apex::NoNormal, [4.72e-5, 4.72e-5]), (Apex::FaceNormals, [7.97e-6, 2.43e-5])]
    {
        let (coarse, fine) = (cone(8, apex), cone(16, apex));
        near(coarse[0], expected[0]);
        near(coarse[1], expected[1]);
        for (kind, (coarse, fine)) in coarse.into_iter().zip(fine).enumerate() {
            let order = order(coarse, fine);
            assert!(order >= 2.9, "{apex:?} {kind}: {order:.2} from {coarse:.2e}");
        }
    }
}

#[test]
fn normals_gain_an_order_on_spheres() {
    let [coarse, fine] = [8, 16].map(|n| {
        let mesh = common::sphere(n).mesh();
        let surface = build(&mesh, &common::smooth(&mesh, &SPHERE), Settings::tangent_plane());
        errors(&surface, usize::MAX, &SPHERE, 8)[1]
    });
    let order = order(coarse, fine);
    assert!(order >= 2.9, "{order:.2} from {coarse:.2e}");
}
