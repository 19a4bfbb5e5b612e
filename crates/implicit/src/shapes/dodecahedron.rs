//! The rounded dodecahedron.

use crate::expression::Expression;
use crate::number::Number;

/// The sextic f = x⁶ + y⁶ + z⁶ + 20 (x⁴y² + y⁴z² + z⁴x²) − 1, a rounded dodecahedron \[TK09\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Dodecahedron;

impl Expression for Dodecahedron {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let [x2, y2, z2] = [x.square(), y.square(), z.square()];
        let [x4, y4, z4] = [x2.square(), y2.square(), z2.square()];
        let sixth_powers = x4 * x2 + y4 * y2 + z4 * z2;
        sixth_powers + (x4 * y2 + y4 * z2 + z4 * x2) * 20.0 - 1.0
    }
}

crate::field_from_expression!(Dodecahedron);
