//! The plane.

use glam::DVec3;

use crate::expression::Expression;
use crate::number::Number;

/// The plane f = n·p − d; the half space against the normal is inside.
///
/// [`Default`] is the plane z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane {
    /// The normal n; of any length but zero.
    pub normal: DVec3,
    /// The offset d: the distance from the origin times the length of the normal.
    pub offset: f64,
}

impl Plane {
    /// The plane through a point.
    #[must_use]
    pub fn through(point: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: normal.dot(point) }
    }
}

impl Default for Plane {
    fn default() -> Self {
        Self { normal: DVec3::Z, offset: 0.0 }
    }
}

impl Expression for Plane {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        x * self.normal.x + y * self.normal.y + z * self.normal.z - self.offset
    }
}

crate::field_from_expression!(Plane);
