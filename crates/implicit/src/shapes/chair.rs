//! The chair.

use crate::expression::Expression;
use crate::number::Number;

/// The quartic f = (x² + y² + z² − ak²)² − b ((z − k)² − 2x²)((z + k)² − 2y²), genus 3 for the
/// default parameters.
///
/// [`Default`] has a = 0.95, b = 0.8, k = 5, as in \[TK09\].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chair {
    /// The squared radius in units of k², dimensionless.
    pub a: f64,
    /// The weight of the four planes, dimensionless.
    pub b: f64,
    /// The size, a length.
    pub k: f64,
}

impl Default for Chair {
    fn default() -> Self {
        Self { a: 0.95, b: 0.8, k: 5.0 }
    }
}

impl Expression for Chair {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let [x2, y2] = [x.square(), y.square()];
        let sphere = x2 + y2 + z.square() - self.a * self.k * self.k;
        let upper = (z - self.k).square() - x2 * 2.0;
        let lower = (z + self.k).square() - y2 * 2.0;
        sphere.square() - upper * lower * self.b
    }
}

crate::field_from_expression!(Chair);
