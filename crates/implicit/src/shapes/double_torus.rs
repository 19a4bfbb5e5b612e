//! The double torus.

use crate::expression::Expression;
use crate::number::Number;

/// The double torus f = x⁸ − 2x⁶ + x⁴ + 2x⁴y² − 2x²y² + y⁴ + z² − 0.04, genus 2 \[TK09\].
///
/// The polynomial is evaluated as (x⁴ − x² + y²)² + z² − 0.04, which is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DoubleTorus;

impl Expression for DoubleTorus {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let x2 = x.square();
        let figure_eight = x2.square() - x2 + y.square();
        figure_eight.square() + z.square() - 0.04
    }
}

crate::field_from_expression!(DoubleTorus);
