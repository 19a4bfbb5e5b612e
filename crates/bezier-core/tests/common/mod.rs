//! Random nets and parameters, shared by the test files of this crate.
#![allow(dead_code, reason = "each test file uses a part")]

use bezier_core::glam::DVec3;
use bezier_core::{Barycentric, BezierCurve, BezierTriangle};
use proptest::prelude::*;

/// What sums over a net of coordinates up to one may be off by, for parameters up to this far
/// outside: the basis then adds up to at most (1 + 4 · 0.3)⁷ ≈ 250 in absolute value.
pub(crate) const ROUND_OFF: f64 = 250.0 * 64.0 * f64::EPSILON;

pub(crate) fn points<const P: usize>() -> impl Strategy<Value = [DVec3; P]> {
    let coordinates = prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), P);
    coordinates.prop_map(|points| std::array::from_fn(|i| DVec3::from_array(points[i])))
}

pub(crate) fn triangle<const P: usize>() -> impl Strategy<Value = BezierTriangle<DVec3, P>> {
    points().prop_map(BezierTriangle::new)
}

pub(crate) fn curve<const P: usize>() -> impl Strategy<Value = BezierCurve<DVec3, P>> {
    points().prop_map(BezierCurve::new)
}

/// Parameters inside the triangle and up to 0.3 outside.
pub(crate) fn parameters() -> impl Strategy<Value = Barycentric> {
    (-0.3..1.3, -0.3..1.3)
        .prop_filter("too far outside", |(u, v): &(f64, f64)| 1.0 - u - v >= -0.3)
        .prop_map(|(u, v)| Barycentric::new(u, v))
}
