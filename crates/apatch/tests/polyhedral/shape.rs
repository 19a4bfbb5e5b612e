//! Shape control.

use apatch::glam::DVec3;
use apatch::polyhedral::{HullError, PolyhedralSurface, Polyhedron, Settings, ShapeControl};

use super::common::jumps;

/// Distance from the centre at the first corner of a cube, and the surface.
fn corner(shape: ShapeControl) -> (f64, PolyhedralSurface) {
    let settings = Settings { shape, ..Settings::default() };
    let surface = PolyhedralSurface::new(&Polyhedron::named("cube").unwrap(), &settings).unwrap();
    let third = 1.0 / 3.0;
    let hit = surface.point(0, [third, third, third, 0.0], [0.0, 0.0, 0.0, 1.0]).unwrap();
    (hit.point.length(), surface)
}

#[test]
fn tension_and_cuts_move_the_corner() {
    // radii of an independent implementation, to its digits: upper weights times a factor, and middle
    // weights from -0.5
    for (factor, radius) in [(0.25, 1.196), (0.5, 1.096), (1.0, 1.0), (2.0, 0.912), (5.0, 0.814)] {
        let tension = f64::log2(factor);
        let (found, surface) = corner(ShapeControl { tension, ..ShapeControl::default() });
        assert!((found - radius).abs() <= 6e-4, "factor {factor}: {found}, not {radius}");
        assert_eq!(surface.report().bad_rays[0], 0, "factor {factor}");
        assert!(jumps(&surface).gradient <= 1e-13, "factor {factor}");
    }
    let edge = 2.0_f64.sqrt();
    for (middle, radius) in [(0.0, 1.110), (-0.1, 1.090), (-0.3, 1.047), (-1.5, 0.827)] {
        let cut = (middle + 0.5) / edge;
        let (found, surface) = corner(ShapeControl { cut, ..ShapeControl::default() });
        assert!((found - radius).abs() <= 6e-4, "middle weight {middle}: {found}, not {radius}");
        assert!(jumps(&surface).gradient <= 1e-13, "middle weight {middle}");
    }
}

#[test]
fn the_cut_of_corners_moves_the_volume() {
    let solid = Polyhedron::named("octahedron").unwrap();
    let mut before = 0.0;
    // volumes of an independent implementation with the same mesh
    for (alpha, volume) in [(0.1, 0.477), (0.25, 0.662), (0.5, 0.955), (0.75, 1.279)] {
        let mut settings = Settings::default();
        settings.hull.alpha = Some(alpha);
        let surface = PolyhedralSurface::new(&solid, &settings).unwrap();
        let found = surface.tessellate(12, 12).signed_volume();
        assert!(found > before, "more volume with alpha {alpha}");
        assert!((found - volume).abs() <= 0.02 * volume, "alpha {alpha}: {found}, not {volume}");
        before = found;
    }
    let one = ShapeControl { corners: [(4, 0.9)].into(), ..ShapeControl::default() };
    let settings = Settings { shape: one, ..Settings::default() };
    let top = PolyhedralSurface::new(&solid, &settings).unwrap();
    let reach = |axis: DVec3| {
        let mesh = top.tessellate(8, 8);
        mesh.positions.iter().map(|p| p.dot(axis)).fold(0.0, f64::max)
    };
    let far = solid.vertices()[4];
    assert!(reach(far) > reach(-far) + 0.05, "one corner less cut: {} {}", reach(far), reach(-far));
}

#[test]
fn guards_can_be_given() {
    let solid = Polyhedron::named("cube").unwrap();
    let facet = &solid.facets()[2];
    let moved = facet.centroid + 0.3 * facet.normal.any_orthonormal_vector();
    let guards = |point| ShapeControl { guards: [(2, point)].into(), ..ShapeControl::default() };
    let (_, surface) = corner(guards(moved));
    assert!(surface.report().is_clean(), "{:?}", surface.report());
    assert!(surface.hull().points[2].distance(moved) <= 1e-15, "{}", surface.hull().points[2]);
    let settings = Settings { shape: guards(moved * 5.0), ..Settings::default() };
    let error = PolyhedralSurface::new(&solid, &settings).unwrap_err();
    assert!(matches!(error, HullError::BadGuard { face: 2, .. }), "{error}");
}
