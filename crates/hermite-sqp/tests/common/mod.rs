//! Shapes with known second-order data, shared by the test files of this crate.
#![allow(dead_code, reason = "each test file uses a part")]

use bezier_core::SurfaceJet;
use bezier_core::glam::{DMat3, DVec3};
use hermite_sqp::{CurveSample, EdgeProblem};

/// A surface `f = 0` by value, gradient and Hessian.
pub(crate) type Field = fn(DVec3) -> (f64, DVec3, DMat3);

pub(crate) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

pub(crate) fn jet(field: Field, point: DVec3) -> SurfaceJet {
    let (_, gradient, hessian) = field(point);
    let normal = gradient.normalize();
    let p = DMat3::IDENTITY - outer(normal, normal);
    SurfaceJet {
        point,
        normal,
        second_fundamental_form: p * hessian * p * (-1.0 / gradient.length()),
    }
}

pub(crate) fn project(field: Field, mut p: DVec3) -> DVec3 {
    for _ in 0..60 {
        let (f, g, _) = field(p);
        p -= g * (f / g.length_squared());
    }
    p
}

/// The problem of the edge between two surface points, sampled at `j / 10`.
pub(crate) fn problem(field: Field, [a, b]: [DVec3; 2]) -> EdgeProblem {
    let samples: Vec<_> = (1..10)
        .map(|j| f64::from(j) / 10.0)
        .map(|t| CurveSample { t, point: project(field, a.lerp(b, t)) })
        .collect();
    EdgeProblem::new(&jet(field, a), &jet(field, b), &samples).expect("the ends differ")
}

pub(crate) fn torus(p: DVec3) -> (f64, DVec3, DMat3) {
    let rho = p.x.hypot(p.y);
    let d = rho - 5.0;
    let radial = DVec3::new(p.x / rho, p.y / rho, 0.0);
    let around = DMat3::from_diagonal(DVec3::new(1.0, 1.0, 0.0)) - outer(radial, radial);
    let hessian = (outer(radial, radial) + around * (d / rho) + outer(DVec3::Z, DVec3::Z)) * 2.0;
    (d * d + p.z * p.z - 1.0, (radial * d + DVec3::Z * p.z) * 2.0, hessian)
}

/// A point of the torus with `f = 0` by its angles.
pub(crate) fn on_torus(u: f64, v: f64) -> DVec3 {
    let rho = 5.0 + v.cos();
    DVec3::new(rho * u.cos(), rho * u.sin(), v.sin())
}

pub(crate) fn saddle(p: DVec3) -> (f64, DVec3, DMat3) {
    (
        p.z - p.x * p.y,
        DVec3::new(-p.y, -p.x, 1.0),
        DMat3::from_cols(-DVec3::Y, -DVec3::X, DVec3::ZERO),
    )
}

pub(crate) fn plane(p: DVec3) -> (f64, DVec3, DMat3) {
    (p.z, DVec3::Z, DMat3::ZERO)
}

pub(crate) fn cylinder(p: DVec3) -> (f64, DVec3, DMat3) {
    (
        p.x * p.x + p.y * p.y - 1.0,
        DVec3::new(2.0 * p.x, 2.0 * p.y, 0.0),
        DMat3::from_diagonal(DVec3::new(2.0, 2.0, 0.0)),
    )
}

pub(crate) fn hyperboloid(p: DVec3) -> (f64, DVec3, DMat3) {
    (
        p.x * p.x + p.y * p.y - p.z * p.z - 1.0,
        DVec3::new(p.x, p.y, -p.z) * 2.0,
        DMat3::from_diagonal(DVec3::new(2.0, 2.0, -2.0)),
    )
}

/// An inflection along x: `z = x³`.
pub(crate) fn cubic_sheet(p: DVec3) -> (f64, DVec3, DMat3) {
    (
        p.z - p.x.powi(3),
        DVec3::new(-3.0 * p.x * p.x, 0.0, 1.0),
        DMat3::from_diagonal(DVec3::new(-6.0 * p.x, 0.0, 0.0)),
    )
}

/// Flat to third order at the origin: `z = x⁴`.
pub(crate) fn quartic_sheet(p: DVec3) -> (f64, DVec3, DMat3) {
    (
        p.z - p.x.powi(4),
        DVec3::new(-4.0 * p.x.powi(3), 0.0, 1.0),
        DMat3::from_diagonal(DVec3::new(-12.0 * p.x * p.x, 0.0, 0.0)),
    )
}
