//! An accuracy is met as measured independently, with few faces.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test with figures for people")]

use smoothpatch::basemesh::{Foot, SurfaceTarget};
use smoothpatch::bezier_core::Barycentric;
use smoothpatch::implicit::{ImplicitSurface, NamedShape};
use smoothpatch::measure::continuity;
use smoothpatch::{
    Distance, FieldSource, G1Surface, Settings, Silent, Tolerance, fit_to_tolerance,
};

fn fit(
    name: &str,
    distance: f64,
    normal_deg: Option<f64>,
) -> (Box<dyn ImplicitSurface>, G1Surface) {
    let shape = NamedShape::find(name).unwrap();
    let field = shape.field();
    let tolerance = Tolerance { distance: Distance::Relative(distance), normal_deg };
    let settings = Settings::with_faces(0);
    let surface =
        fit_to_tolerance(&*field, &shape.region, &tolerance, &settings, &mut Silent).unwrap();
    (field, surface)
}

/// Largest distance over the diagonal and largest normal angle in degrees on a grid of 45 divisions,
/// which no grid of the adaptation shares points with beyond the corners.
fn independent(field: &dyn ImplicitSurface, surface: &G1Surface) -> (f64, f64) {
    let diagonal = surface.mesh.diagonal();
    let source = FieldSource::new(field, diagonal, Settings::with_faces(0).projection);
    let (mut distance, mut angle) = (0.0_f64, 0.0_f64);
    for net in surface.patches.nets.as_slice() {
        for at in Barycentric::lattice(45) {
            let (point, normal) = net.point_and_area_normal(at);
            let Foot { point: foot, normal: n } = source.foot(point).unwrap();
            distance = distance.max(point.distance(foot));
            angle = angle.max(normal.cross(n).length().atan2(normal.dot(n)));
        }
    }
    (distance / diagonal, angle.to_degrees())
}

#[test]
fn tolerances_are_met() {
    for (name, euler) in [("torus", 0), ("double-torus", -2), ("mcmullen", 2)] {
        let mut faces = Vec::new();
        for tolerance in [1e-5, 1e-6] {
            let (field, surface) = fit(name, tolerance, None);
            assert!(surface.origin.adaptation.unwrap().met, "{name} {tolerance:e}");
            let (distance, _) = independent(&*field, &surface);
            assert!(distance <= tolerance, "{name}: {distance:e} for {tolerance:e}");
            let joined = continuity(surface.mesh.topology(), &surface.patches.nets);
            assert_eq!(joined.euler_characteristic, euler, "{name}");
            assert!(joined.g1_angle_deg <= 1e-9, "{name}: {}", joined.g1_angle_deg);
            assert!(surface.max_row_residual() <= 1e-12, "{name}");
            faces.push(surface.mesh.topology().face_count());
        }
        // h^6 in distance means a factor of 10^(1/3) = 2.15 in faces
        assert!(faces[1] as f64 <= 2.6 * faces[0] as f64, "{name}: {faces:?}");
    }
}

#[test]
fn normal_tolerance_is_met() {
    let (field, surface) = fit("torus", 1e-4, Some(0.01));
    let (_, angle) = independent(&*field, &surface);
    assert!(surface.origin.adaptation.unwrap().met, "met");
    assert!(angle <= 0.01, "{angle}");
}

#[test]
fn tolerances_that_mean_nothing_are_refused() {
    let shape = NamedShape::find("sphere").unwrap();
    for (distance, normal_deg) in [
        (Distance::Relative(1e-18), None),
        (Distance::Relative(f64::NAN), None),
        (Distance::Absolute(-1.0), None),
        (Distance::Absolute(1e-18), None),
        (Distance::Relative(1e-5), Some(0.0)),
    ] {
        let tolerance = Tolerance { distance, normal_deg };
        let settings = Settings::with_faces(0);
        let refused =
            fit_to_tolerance(&*shape.field(), &shape.region, &tolerance, &settings, &mut Silent);
        assert!(refused.is_err(), "{tolerance:?}");
    }
}
