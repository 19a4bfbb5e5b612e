//! Normals in groups, creases, rims and what is reported about them.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::GridMesh as _;

use std::f64::consts::FRAC_PI_6;

use common::{CYLINDER, build, residual};
use nagata::basemesh::VertexId;
use nagata::glam::DVec3;
use nagata::{CornerNormals, Join, Settings, apexes};

#[test]
fn an_l_shaped_solid_stays_flat() {
    let mesh = common::l_shape().mesh();
    assert!(mesh.is_closed(), "not closed");
    assert_eq!(mesh.euler_characteristic(), 2);
    let normals = CornerNormals::estimated(&mesh, FRAC_PI_6);
    let surface = build(&mesh, &normals, Settings::position());
    for edge in mesh.edges() {
        let curve = surface.edge_curve(edge);
        assert!(curve.curvature.length() <= 1e-15, "{edge:?} bends by {}", curve.curvature);
    }
    let report = surface.report();
    // all edges but the two across the L's flat sides
    assert_eq!((report.creases, report.edges), (18, 20), "{report:?}");
    assert!(report.max_misfit <= 1e-15, "{report:?}");
    let area = surface.area(1e-12);
    assert!((area.value - 14.0).abs() <= 1e-12, "{area:?}");
}

#[test]
fn rims_of_a_cylinder_are_creases() {
    let (n, rows) = (24, 4);
    let mesh = common::cylinder(n, rows, true).mesh();
    let by_angle = CornerNormals::estimated(&mesh, FRAC_PI_6);
    for normals in [common::cylinder_normals(&mesh, rows, n), by_angle] {
        let surface = build(&mesh, &normals, Settings::tangent_plane());
        let report = surface.report();
        assert_eq!(report.creases, 2 * n, "{report:?}");
        assert_eq!(report.tangent_plane, report.edges - 2 * n, "{report:?}");
        let (worst, _) = residual(&surface, 8);
        assert!(worst <= 1e-11, "{worst:.1e}");
        for edge in mesh.edges().filter(|e| surface.join(*e) == Join::Crease) {
            // in the plane of the disc, and as round as the order allows
            for u in [0.25, 0.5] {
                let p = surface.edge_point(edge, u);
                assert!((p.z - p.z.round()).abs() <= 1e-14, "{p}");
                assert!((CYLINDER.distance)(p).abs() <= 4e-5, "{p}");
            }
        }
    }
}

#[test]
fn estimated_normals_are_exact_on_spheres() {
    let mesh = common::sphere(3).mesh();
    let normals = CornerNormals::estimated(&mesh, 1.0);
    for face in mesh.faces() {
        for (corner, v) in mesh.corners(face).iter().enumerate() {
            let n = normals.at(&mesh, face, corner).unwrap();
            assert!(n.distance(mesh.position(*v)) <= 1e-14, "{n} {}", mesh.position(*v));
        }
    }
    assert_eq!(normals.normals().len(), mesh.vertex_count());
}

#[test]
fn noise_in_the_normals_of_a_file_is_no_crease() {
    let grid = common::sphere(2);
    let mesh = grid.mesh();
    // every corner has its own normal, slightly off
    let mut random = common::Random(9);
    let (mut normals, mut corners) = (Vec::new(), Vec::new());
    for face in &grid.faces {
        corners.push(
            face.iter().enumerate().map(|(c, _)| Some(normals.len() + c)).collect::<Vec<_>>(),
        );
        normals.extend(face.iter().map(|v| grid.positions[*v] + random.vector() * 1e-6));
    }
    let merged =
        CornerNormals::from_corners(&mesh, &normals, &corners, CornerNormals::MERGE_ANGLE).unwrap();
    assert_eq!(merged.normals().len(), mesh.vertex_count());
    let surface = build(&mesh, &merged, Settings::tangent_plane());
    assert_eq!(surface.report().tangent_plane, mesh.edge_count(), "{:?}", surface.report());
    // without merging all edges would be creases
    let kept = CornerNormals::from_corners(&mesh, &normals, &corners, 0.0).unwrap();
    let report = build(&mesh, &kept, Settings::position()).report();
    assert_eq!(report.creases, mesh.edge_count(), "{report:?}");
}

#[test]
fn apexes_are_found() {
    let mesh = common::cone(4).mesh();
    assert_eq!(apexes(&mesh, 0.6), [VertexId::new(0)]);
    let mesh = common::sphere(4).mesh();
    assert_eq!(apexes(&mesh, 0.6), []);
}

#[test]
fn smooth_edges_that_end_on_a_bent_crease_stay_smooth() {
    // a wavy rim: the crease between a cylinder and a brim is in no plane
    let n = 24;
    let mut grid = common::Grid { positions: Vec::new(), faces: Vec::new() };
    for k in 0..n {
        let s = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        let p = DVec3::new(s.cos(), s.sin(), 0.3 * (2.0 * s).sin());
        grid.positions.extend([p, p - DVec3::Z, p + p.truncate().extend(0.0)]);
    }
    let n = n as usize;
    for k in 0..n {
        let at = |k: usize, what: usize| 3 * (k % n) + what;
        grid.quad([at(k, 1), at(k + 1, 1), at(k + 1, 0), at(k, 0)], true);
        grid.quad([at(k, 0), at(k + 1, 0), at(k + 1, 2), at(k, 2)], true);
    }
    let mesh = grid.mesh();
    let normals = CornerNormals::estimated(&mesh, 0.6);
    let surface = build(&mesh, &normals, Settings::tangent_plane());
    let report = surface.report();
    assert_eq!(report.creases, n, "{report:?}");
    assert!(report.cubic >= n, "the crease needs cubic edges: {report:?}");
    assert_eq!(report.failures, 0, "{report:?}");
    let (worst, count) = residual(&surface, 16);
    assert_eq!(count, report.edges - report.boundary - report.creases, "{report:?}");
    assert!(worst <= 1e-11, "{worst:.1e}");
}
