//! Common tangent planes: where they are promised they are there, elsewhere it is said.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::GridMesh as _;

use common::{
    Grid, KnownSurface, MONKEY, SINE, SPHERE, TORUS, build, errors, monkey, residual, sine,
};
use nagata::glam::DVec3;
use nagata::{CornerNormals, EdgeSettings, Join, Settings};

const ROUND_OFF: f64 = 1e-11;

#[test]
fn smooth_surfaces_have_no_kinks() {
    for (grid, surface) in [
        (common::sphere(3), SPHERE),
        (common::torus(12, 6, true), TORUS),
        (common::torus(48, 24, true), TORUS),
    ] {
        let mesh = grid.mesh();
        let normals = common::smooth(&mesh, &surface);
        for settings in [Settings::published(), Settings::tangent_plane()] {
            let surface = build(&mesh, &normals, settings);
            let (worst, count) = residual(&surface, 16);
            assert_eq!(count, mesh.edge_count(), "{:?}", surface.report());
            assert!(worst <= ROUND_OFF, "{worst:.1e}");
        }
    }
}

#[test]
fn the_ellipsoid_of_figure_3() {
    let mut grid = common::sphere(1);
    let axes = DVec3::new(1.0, 2.0, 3.0);
    grid.positions.iter_mut().for_each(|p| *p *= axes);
    let mesh = grid.mesh();
    let normals = CornerNormals::from_fn(&mesh, |p| Some(p / (axes * axes)));
    // the C0 patches have a kink of 81 degrees
    let c0 = Settings { edges: EdgeSettings::PUBLISHED, ..Settings::position() };
    let c0 = build(&mesh, &normals, c0);
    let kink = mesh.edges().filter_map(|e| c0.kink(e, 32)).fold(0.0, f64::max).to_degrees();
    assert!((kink - 81.0).abs() < 0.1, "{kink}");
    let robust = Settings { edges: EdgeSettings::PUBLISHED, ..Settings::tangent_plane() };
    for settings in [Settings::published(), robust] {
        let surface = build(&mesh, &normals, settings);
        let (worst, count) = residual(&surface, 32);
        assert_eq!(count, 12, "{:?}", surface.report());
        assert!(worst <= 1e-14, "{worst:.1e}");
    }
}

#[test]
fn a_coarse_torus_keeps_its_tangent_planes() {
    // the tube is a triangle, edges at some corners are parallel, and the published patch folds
    let mesh = common::torus(6, 3, true).mesh();
    let normals = common::smooth(&mesh, &TORUS);
    let surface = build(&mesh, &normals, Settings::tangent_plane());
    let (worst, count) = residual(&surface, 16);
    assert_eq!(count, mesh.edge_count(), "{:?}", surface.report());
    assert!(worst <= ROUND_OFF, "{worst:.1e}");
}

/// Robust patches on an irregular mesh with hyperbolic regions.
fn saddle(grid: &Grid, truth: &KnownSurface) {
    let mesh = grid.mesh();
    let normals = common::smooth(&mesh, truth);
    let [c0, _] = errors(&build(&mesh, &normals, Settings::position()), usize::MAX, truth, 8);
    let robust = build(&mesh, &normals, Settings::tangent_plane());
    let report = robust.report();
    assert_eq!((report.failures, report.folded), (0, 0), "{report:?}");
    assert_eq!(report.tangent_plane + report.boundary, report.edges, "{report:?}");
    let (worst, _) = residual(&robust, 8);
    assert!(worst <= ROUND_OFF, "kink {worst:.1e}");
    let [distance, angle] = errors(&robust, usize::MAX, truth, 8);
    assert!(angle.to_degrees() <= 0.2, "normals {} degrees", angle.to_degrees());
    assert!(distance <= 1.3 * c0, "{distance:.2e} against {c0:.2e}");
}

#[test]
fn robust_patches_on_a_monkey_saddle() {
    saddle(&common::graph(64, monkey, 7), &MONKEY);
}

#[test]
fn robust_patches_on_waves() {
    saddle(&common::graph(64, sine, 7), &SINE);
}

#[test]
fn published_patches_fail_on_inflections_and_say_so() {
    let mesh = common::graph(16, monkey, 7).mesh();
    let normals = common::smooth(&mesh, &MONKEY);
    let surface = build(&mesh, &normals, Settings::published());
    let mut failed = 0;
    for edge in mesh.edges() {
        let Some(kink) = surface.kink(edge, 16) else { continue };
        match surface.join(edge) {
            Join::TangentPlane => assert!(kink <= ROUND_OFF, "{kink:.1e}"),
            // a correction is too long next to an inflection
            Join::Inflection | Join::Rejected => failed += 1,
            other => panic!("{other:?}"),
        }
    }
    assert!(failed > 0, "no inflection");
    // and they are failures: normals turn over
    let [_, angle] = errors(&surface, usize::MAX, &MONKEY, 16);
    assert!(angle > 1.5, "{angle}");
    assert_eq!(surface.report().failures, failed);
}
