//! Rays in space and the function at points.

use apatch::Ray;
use apatch::glam::DVec3;
use apatch::polyhedral::{PolyhedralSurface, Polyhedron, Scheme};

use super::common::settings;
use testkit::Numbers;

#[test]
fn rays_hit_the_inscribed_sphere() {
    let solid = Polyhedron::named("cube").unwrap();
    for scheme in [Scheme::C1Cubic, Scheme::C2Quintic] {
        let surface = PolyhedralSurface::new(&solid, &settings(scheme)).unwrap();
        let tree = surface.tree();
        let mut numbers = Numbers::new(3);
        for _ in 0..200 {
            let mut direction = || DVec3::new(numbers.signed(), numbers.signed(), numbers.signed());
            let (origin, target) = (3.0 * direction().normalize(), 0.5 * direction());
            let ray = Ray { origin, direction: target - origin };
            let hit = tree.cast(&ray).expect("a hit");
            assert!((hit.point.length() - 1.0).abs() <= 1e-9, "{hit:?}");
            assert!(hit.gradient.normalize().distance(hit.point) <= 1e-8, "{hit:?}");
            assert!(hit.distance < 1.0 && ray.direction.dot(hit.gradient) <= 1e-9, "in front");
        }
        assert_eq!(tree.cast(&Ray { origin: DVec3::splat(2.0), direction: DVec3::ONE }), None);
    }
}

#[test]
fn the_function_is_negative_inside() {
    let solid = Polyhedron::named("frame").unwrap();
    let surface = PolyhedralSurface::new(&solid, &settings(Scheme::C1Cubic)).unwrap();
    let tree = surface.tree();
    let mesh = surface.tessellate(5, 4);
    let mut found = 0;
    for (p, normal) in mesh.positions.iter().zip(&mesh.normals) {
        for step in [-1e-3, 1e-3] {
            if let Some((_, jet)) = tree.locate(*p + *normal * step) {
                assert!(jet.value * step > 0.0, "{p}: {} at {step}", jet.value);
                found += 1;
            }
        }
    }
    assert!(found > mesh.positions.len(), "most points are in the hull: {found}");
    // through the hole
    let through = Ray { origin: DVec3::new(1.5, 1.5, 5.0), direction: DVec3::NEG_Z };
    assert_eq!(tree.cast(&through), None);
}
