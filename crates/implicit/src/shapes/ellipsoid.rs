//! The ellipsoid along the axes.

use glam::DVec3;

use crate::expression::Expression;
use crate::number::Number;

/// The ellipsoid f = (x/a)² + (y/b)² + (z/c)² − 1; a dimensionless field.
///
/// [`Default`] has the semi-axes 1, 0.8, 0.6.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ellipsoid {
    /// The semi-axes a, b, c; none zero.
    pub semi_axes: DVec3,
}

impl Default for Ellipsoid {
    fn default() -> Self {
        Self { semi_axes: DVec3::new(1.0, 0.8, 0.6) }
    }
}

impl Expression for Ellipsoid {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let DVec3 { x: a, y: b, z: c } = self.semi_axes;
        (x / a).square() + (y / b).square() + (z / c).square() - 1.0
    }
}

crate::field_from_expression!(Ellipsoid);
