//! Order of the largest deviation under refinement, from unit normals.
#![allow(clippy::print_stdout, reason = "figures, for runs with --nocapture")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use apatch::basemesh::TriMesh;
use apatch::glam::DVec3;
use common::{given, mapped, surface, torus_normal, worst};
use testkit::meshes::{icosphere, torus_grid};

/// Largest deviations on the meshes, and the order from the first to the last.
fn order(
    meshes: impl ExactSizeIterator<Item = TriMesh>,
    normal: impl Fn(DVec3) -> DVec3,
    distance: impl Fn(DVec3) -> f64,
) -> (Vec<f64>, f64) {
    let halvings = meshes.len() as f64 - 1.0;
    let deviations: Vec<f64> = meshes
        .map(|mesh| {
            let surface = surface(&mesh, given(&mesh, &normal));
            assert!(surface.report().is_clean(), "{:?}", surface.report());
            let (deviation, missing) = worst(&surface, 6, 4, &distance);
            assert_eq!(missing, 0, "points without a root");
            deviation
        })
        .collect();
    let order = (deviations[0] / deviations[deviations.len() - 1]).log2() / halvings;
    println!("{deviations:?}: order {order:.2}");
    (deviations, order)
}

#[test]
fn torus() {
    let meshes = (0..4).map(|level| torus_grid([2.0, 0.8], 8 << level, 6 << level));
    let distance = |p: DVec3| (DVec3::new(p.x, p.y, 0.0).length() - 2.0).hypot(p.z) - 0.8;
    let (deviations, order) = order(meshes, torus_normal, distance);
    assert!(order >= 3.0, "order {order:.2} of {deviations:?}");
    // what an independent implementation of the same rules measured
    assert!((deviations[3] - 2.47e-5).abs() <= 0.1e-5, "{deviations:?}");
}

#[test]
fn quartic() {
    let value = |p: DVec3| p.x.powi(4) + p.y.powi(4) + p.z.powi(4) - 1.0;
    let gradient = |p: DVec3| 4.0 * DVec3::new(p.x.powi(3), p.y.powi(3), p.z.powi(3));
    let onto = |p: DVec3| p / (value(p) + 1.0).powf(0.25);
    // 80 faces are too few for the edges of this surface: the order shows from 320 on
    let meshes = (2..6).map(|level| mapped(&icosphere(level), onto));
    let distance = |p: DVec3| value(p) / gradient(p).length();
    let (deviations, order) = order(meshes, |p| gradient(p).normalize(), distance);
    assert!(order >= 2.9, "order {order:.2} of {deviations:?}");
    assert!(deviations[2] <= 6e-5, "{deviations:?}");
}
