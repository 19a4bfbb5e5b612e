//! The decorated cube.

use crate::expression::Expression;
use crate::number::Number;

/// The decorated cube, degree 12: f is the product of (x² + y² − a²)² + (z² − 1)² and its two
/// cyclic companions, minus b; six linked rings, genus 13 for the default parameters.
///
/// [`Default`] has a = 0.8, b = 0.02, as in \[TK09\].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Deccube {
    /// The radius of the rings; the faces of the cube are at ±1.
    pub a: f64,
    /// The level of the product: the thickness of the rings.
    pub b: f64,
}

impl Default for Deccube {
    fn default() -> Self {
        Self { a: 0.8, b: 0.02 }
    }
}

impl Expression for Deccube {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let [x2, y2, z2] = [x.square(), y.square(), z.square()];
        let ring = |u2: T, v2: T, w2: T| (u2 + v2 - self.a * self.a).square() + (w2 - 1.0).square();
        ring(x2, y2, z2) * ring(y2, z2, x2) * ring(z2, x2, y2) - self.b
    }
}

crate::field_from_expression!(Deccube);
