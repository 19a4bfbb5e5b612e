//! Distances between the surface and flat pieces.

use glam::DVec3;

use super::between;
use super::error::ChordError;
use crate::samples::FacePoint;

/// The distance from a point to the segment between two points.
pub(super) fn to_segment(point: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let (along, offset) = (b - a, point - a);
    let length_squared = along.length_squared();
    if length_squared == 0.0 {
        return offset.length();
    }
    let t = (offset.dot(along) / length_squared).clamp(0.0, 1.0);
    offset.distance(along * t)
}

/// The distance from a point near the middle of a triangle to it: to its plane, or to its sides if it
/// has none.
pub(super) fn to_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    match (b - a).cross(c - a).try_normalize() {
        Some(normal) => (point - a).dot(normal).abs(),
        None => to_segment(point, [a, b]).min(to_segment(point, [b, c])),
    }
}

/// The surface along a side.
pub(super) struct Side {
    pub(super) middle: DVec3,
    /// The largest distance of the surface from the chord.
    pub(super) gap: f64,
}

/// Looks at a side at its quarters.
pub(super) fn side(
    face: usize,
    ends: [FacePoint; 2],
    chord: [DVec3; 2],
    evaluate: &impl Fn(usize, FacePoint) -> (DVec3, DVec3),
) -> Result<Side, ChordError> {
    let mut points = [DVec3::ZERO; 3];
    for (point, t) in points.iter_mut().zip([0.25, 0.5, 0.75]) {
        *point = finite(face, evaluate(face, between(ends[0], ends[1], t)).0)?;
    }
    let gap = points.iter().map(|&point| to_segment(point, chord)).fold(0.0, f64::max);
    Ok(Side { middle: points[1], gap })
}

pub(super) fn finite(face: usize, position: DVec3) -> Result<DVec3, ChordError> {
    if position.is_finite() { Ok(position) } else { Err(ChordError::NotFinite { face, position }) }
}
