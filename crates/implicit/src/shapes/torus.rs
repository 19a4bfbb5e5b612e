//! The torus.

use crate::expression::Expression;
use crate::number::Number;

/// The torus f = (√(x² + y²) − R)² + z² − r² around the z-axis, genus 1 for r < R.
///
/// On the axis, far from the surface, the field has no derivative.
/// [`Default`] has R = 5, r = 1, as in \[TK09\].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Torus {
    /// The radius R of the central circle.
    pub major_radius: f64,
    /// The radius r of the tube.
    pub minor_radius: f64,
}

impl Default for Torus {
    fn default() -> Self {
        Self { major_radius: 5.0, minor_radius: 1.0 }
    }
}

impl Expression for Torus {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let from_axis = (x.square() + y.square()).sqrt();
        let from_circle = (from_axis - self.major_radius).square() + z.square();
        from_circle - self.minor_radius * self.minor_radius
    }
}

crate::field_from_expression!(Torus);
