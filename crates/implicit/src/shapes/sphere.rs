//! The sphere.

use glam::DVec3;

use crate::expression::Expression;
use crate::number::Number;

/// The sphere f = |p − c|² − r².
///
/// [`Default`] is the unit sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sphere {
    /// The center c.
    pub center: DVec3,
    /// The radius r.
    pub radius: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Self { center: DVec3::ZERO, radius: 1.0 }
    }
}

impl Expression for Sphere {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let c = self.center;
        (x - c.x).square() + (y - c.y).square() + (z - c.z).square() - self.radius * self.radius
    }
}

crate::field_from_expression!(Sphere);
