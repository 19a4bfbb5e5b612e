//! Directions.

use glam::DVec3;

/// `v` with length one; `None` if it is zero or not finite.
#[inline]
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    let squared = v.length_squared();
    // scaling by a power of two changes no bit
    if (1e-200..=1e200).contains(&squared) {
        return Some(v / squared.sqrt());
    }
    // the square may over- or underflow, the quotient does not
    let largest = v.abs().max_element();
    (largest > 0.0 && v.is_finite()).then(|| (v / largest).normalize())
}

/// Direction of `a × b` for differences `a` and `b` of vectors of this size; `None` if it is so short that
/// it may be round-off.
#[inline]
pub(crate) fn cross_direction(a: DVec3, b: DVec3, size: f64) -> Option<DVec3> {
    /// Errors of the differences, relative to the size; a few operations are behind them.
    const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
    let cross = a.cross(b);
    let noise = ROUND_OFF * size * (a.length_squared() + b.length_squared()).sqrt();
    if cross.length_squared() > noise * noise { unit(cross) } else { None }
}

/// Angle between two vectors, in [0, π]; zero if one of them is zero.
#[inline]
pub(crate) fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
