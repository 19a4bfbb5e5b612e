//! Curvatures of surfaces where they are known.

use std::f64::consts::TAU;

use implicit::glam::{DMat3, DVec3};
use implicit::{
    Aabb, Formula, Plane, Sphere, SurfacePoint, Torus, TwiceDifferentiable, catalogue,
    surface_point,
};
use testkit::conformance::field::sample_points;

fn at(field: &dyn TwiceDifferentiable, p: DVec3) -> SurfacePoint {
    surface_point(field, p).expect("a regular point")
}

#[track_caller]
fn check_close(value: f64, expected: f64, size: f64) {
    let tolerance = 32.0 * f64::EPSILON * size;
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

#[test]
fn sphere() {
    for radius in [1e-9, 1.0, 2e9] {
        let sphere = Sphere { center: DVec3::ZERO, radius };
        for p in sample_points(&Aabb::from_half_size(1.0), 100) {
            let point = at(&sphere, radius * p.normalize());
            let principal = point.principal();
            check_close(principal.min, -1.0 / radius, 1.0 / radius);
            check_close(principal.max, -1.0 / radius, 1.0 / radius);
            assert!(principal.umbilic, "a sphere has umbilics only");
            let tangent = point.normal.cross(DVec3::new(0.3, -0.4, 1.2));
            check_close(point.normal_curvature(tangent), -1.0 / radius, 1.0 / radius);
        }
    }
}

#[test]
fn torus() {
    let torus = Torus::default();
    for i in 0..24 {
        // u = 0, 1/2 and so on hit the inner and the outer equator and the flat circles
        let (u, v) = (TAU * f64::from(i) / 24.0, 0.7 * f64::from(i));
        let from_axis = 5.0 + u.cos();
        let point = at(&torus, DVec3::new(from_axis * v.cos(), from_axis * v.sin(), u.sin()));
        let principal = point.principal();
        check_close(principal.min, -1.0, 4.0);
        check_close(principal.max, -u.cos() / from_axis, 4.0);
        let along = DVec3::new(-v.sin(), v.cos(), 0.0);
        check_close(principal.direction_max.dot(along).abs(), 1.0, 4.0);
        check_close(principal.direction_min.dot(along), 0.0, 4.0);
        assert!(!principal.umbilic, "a torus has no umbilics");
    }
}

#[test]
fn umbilics_do_not_depend_on_the_size() {
    for size in [1e-9, 1.0, 1e9] {
        let torus = Torus { major_radius: 5.0 * size, minor_radius: size };
        let point = at(&torus, DVec3::new(0.0, 6.0 * size, 0.0));
        assert!(!point.principal().umbilic, "a torus has no umbilics");
    }
}

#[test]
fn plane() {
    let plane = Plane::through(DVec3::ONE, DVec3::new(1.0, -2.0, 0.5));
    let point = at(&plane, DVec3::new(3.0, 1.0, -1.0));
    assert_eq!(point.second_fundamental_form, DMat3::ZERO);
    assert!(point.principal().umbilic, "a plane has umbilics only");
}

#[test]
fn saddle() {
    // z = x y, with the normal upward: curvatures ±1 along the diagonals
    let saddle = Formula::parse("z - x*y").unwrap();
    let point = at(&saddle, DVec3::ZERO);
    let principal = point.principal();
    check_close(principal.min, -1.0, 1.0);
    check_close(principal.max, 1.0, 1.0);
    let diagonal = DVec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0);
    check_close(principal.direction_max.dot(diagonal).abs(), 1.0, 1.0);
    check_close(point.normal_curvature(DVec3::X), 0.0, 1.0);
}

#[test]
fn isolated_umbilics() {
    // the four umbilics of the ellipsoid lie where |x| and |z| have these values
    let (a2, b2, c2) = (1.0_f64, 0.64_f64, 0.36_f64);
    let ellipsoid = implicit::Ellipsoid::default();
    let x = (a2 * (a2 - b2) / (a2 - c2)).sqrt();
    let z = (c2 * (b2 - c2) / (a2 - c2)).sqrt();
    let principal = at(&ellipsoid, DVec3::new(x, 0.0, z)).principal();
    check_close(principal.min, principal.max, 4.0);
    let tilted = at(&ellipsoid, DVec3::new(x, 0.1, z)).principal();
    assert!(!tilted.umbilic && principal.umbilic, "{principal:?}, {tilted:?}");
    // x³ − 3xy² has a flat umbilic, the monkey saddle
    let monkey = at(&Formula::parse("z - x^3 + 3*x*y^2").unwrap(), DVec3::ZERO).principal();
    assert!(monkey.umbilic && monkey.direction_min.is_normalized(), "{monkey:?}");
}

/// Everywhere on and around all shapes: tangents are orthonormal and oriented, the form has no
/// normal part, and the principal curvatures are its values along the principal directions.
#[test]
fn structure() {
    for shape in catalogue() {
        let field = shape.field();
        for p in sample_points(&shape.region, 200) {
            let point = at(&field, p);
            let size = point.second_fundamental_form.to_cols_array().iter().map(|m| m.abs()).sum();
            let jet = field.jet(p);
            // what was cancelled in the projection counts as well
            let size: f64 = f64::max(size, {
                let entries = jet.hessian.to_cols_array();
                entries.iter().map(|m| m.abs()).sum::<f64>() / jet.gradient.length()
            });
            let k = point.principal();
            check_close((point.second_fundamental_form * point.normal).length(), 0.0, size);
            let (u, v) = (k.direction_min, k.direction_max);
            check_close((u.cross(v) - point.normal).length(), 0.0, 1.0);
            check_close(point.second_form(u, v), 0.0, size);
            check_close(point.normal_curvature(u), k.min, size);
            check_close(point.normal_curvature(3.0 * v + point.normal), k.max, size);
            assert!(k.min <= k.max, "{}: {k:?}", shape.name);
        }
    }
}

#[test]
fn level_sets_of_one_field_with_different_slopes() {
    // the curvature belongs to the surface: f, 7 f and f³ + f have the same zero set
    let p = DVec3::new(0.36, 0.48, 0.8);
    let expected = at(&Formula::parse("x^2 + y^2 + 2*z^2 - 1.64").unwrap(), p);
    for text in [
        "7*(x^2 + y^2 + 2*z^2 - 1.64)",
        "(x^2 + y^2 + 2*z^2 - 1.64)^3 + x^2 + y^2 + 2*z^2 - 1.64",
        "exp(x^2 + y^2 + 2*z^2 - 1.64) - 1",
    ] {
        let point = at(&Formula::parse(text).unwrap(), p);
        let difference = point.second_fundamental_form - expected.second_fundamental_form;
        let largest = difference.to_cols_array().into_iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        check_close(largest, 0.0, 4.0);
    }
}

#[test]
fn singular_points_are_errors() {
    for (text, p) in [
        ("x^2 + y^2 - z^2", DVec3::ZERO),
        ("sqrt(x^2 + y^2 + z^2) - 1", DVec3::ZERO),
        ("x^1.5 + y", DVec3::ZERO),
        ("ln(x)", -DVec3::X),
        ("1", DVec3::ZERO),
    ] {
        let error = surface_point(&Formula::parse(text).unwrap(), p).unwrap_err();
        assert_eq!(error.point, p, "{text}");
    }
}
