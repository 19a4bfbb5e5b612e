//! Rays at edges and vertices, signs, walking and boxes.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::TORUS;
use common::queries::{Random, spot, torus_surface};
use nagata::glam::DVec3;
use nagata::{CornerNormals, NagataSurface, PolygonMesh, Ray, Settings, SurfaceQueries};

/// Rays through points of edges and vertices: neighbours have the same edge, nothing slips through.
#[test]
fn rays_through_edges_and_vertices_hit_once() {
    for settings in [Settings::position(), Settings::tangent_plane()] {
        let surface = torus_surface(true, settings);
        let queries = SurfaceQueries::new(&surface);
        for edge in surface.mesh().edges() {
            for u in [0.0, 0.3, 0.5] {
                let p = surface.edge_point(edge, u);
                let n = (TORUS.normal)(p);
                let ray = Ray { origin: p + n * 0.5, direction: -n };
                let near =
                    queries.hits(&ray).iter().filter(|hit| (hit.t - 0.5).abs() < 1e-9).count();
                assert_eq!(near, 1, "edge {edge:?} at {u}");
            }
        }
    }
}

#[test]
fn distances_are_signed_by_the_normal() {
    let surface = torus_surface(true, Settings::tangent_plane());
    let queries = SurfaceQueries::new(&surface);
    let mut random = Random(3);
    for _ in 0..300 {
        let p = random.point(&queries);
        let (found, exact) = (queries.closest(p).unwrap(), (TORUS.distance)(p));
        assert!((found.signed_distance - exact).abs() < 5e-3, "{p}: {found:?}, exactly {exact}");
    }
    assert_eq!(queries.closest(DVec3::NAN), None);
    assert_eq!(queries.hits(&Ray { origin: DVec3::ZERO, direction: DVec3::ZERO }), []);
}

/// The sign behind the sharp edge of a tetrahedron, where the normal of one face alone would be wrong.
#[test]
fn signs_are_right_at_sharp_edges() {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let mesh = PolygonMesh::new(positions, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).unwrap();
    let normals = CornerNormals::estimated(&mesh, 0.1);
    let surface = NagataSurface::new(mesh, normals, Settings::position()).unwrap();
    let queries = SurfaceQueries::new(&surface);
    let mut random = Random(4);
    for _ in 0..2000 {
        let p = DVec3::new(random.next(), random.next(), random.next()) * 3.0 - 1.0;
        let inside = p.min_element() > 0.0 && p.element_sum() < 1.0;
        let found = queries.closest(p).unwrap();
        assert_eq!(found.signed_distance < 0.0, inside, "{p}: {found:?}");
    }
}

#[test]
fn walking_across_an_edge_stays_at_the_point() {
    for split in [true, false] {
        let surface = torus_surface(split, Settings::position());
        for face in surface.mesh().faces() {
            for side in surface.mesh().sides(face) {
                let t = 0.25;
                let here = surface.patch(face).point(surface.side_parameters(side, t));
                let mut count = 0;
                for (other, back, at) in surface.walk_across(side, t) {
                    assert_eq!(surface.patch(other.face).point(at), here, "{side:?}");
                    let (home, again, _) = surface.walk_across(other, back).next().unwrap();
                    assert_eq!((home, again), (side, t), "the way back");
                    count += 1;
                }
                assert_eq!(count, 1, "neighbours of {side:?}");
            }
        }
    }
}

#[test]
fn boxes_contain_their_patches() {
    for surface in [
        torus_surface(true, Settings::tangent_plane()),
        torus_surface(false, Settings::position()),
        spot(Settings::tangent_plane()),
    ] {
        for face in surface.mesh().faces() {
            let patch = surface.patch(face);
            let aabb = patch.aabb();
            let slack = DVec3::splat(1e-14);
            for (i, j) in (0..=5).flat_map(|i| (0..=5).map(move |j| (i, j))) {
                if i + j > 5 && surface.mesh().corners(face).len() == 3 {
                    continue;
                }
                let p = patch.point([f64::from(i) / 5.0, f64::from(j) / 5.0]);
                assert!(
                    p.cmpge(aabb.low - slack).all() && p.cmple(aabb.high + slack).all(),
                    "{face:?}: {p}"
                );
            }
        }
    }
}

/// Far away all distances are the same but for rounding, and farther squares overflow.
#[test]
fn closest_points_are_found_from_far_away() {
    for settings in [Settings::position(), Settings::tangent_plane()] {
        let surface = torus_surface(true, settings);
        let queries = SurfaceQueries::new(&surface);
        for distance in [1e3, 1e6, 1e9, 1e12, 1e15, 1e100, 1e150, 1e300] {
            let p = DVec3::new(0.3, 0.5, 0.7) * distance;
            let found = queries.closest(p).unwrap();
            assert!(found.at.point.length() < 3.1 && !found.signed_distance.is_nan(), "{found:?}");
            let error = (found.signed_distance.abs() / p.length() - 1.0).abs();
            assert!(error < 4.0 / distance + 1e-15 || distance > 1e150, "{distance}: {found:?}");
        }
    }
}
