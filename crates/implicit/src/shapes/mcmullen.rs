//! McMullen's surface.

use crate::expression::Expression;
use crate::number::Number;

/// The surface f = (x² + 1)(y² + 1)(z² + 1) + 8xyz − 2, genus 0 with four bumps \[TK09\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct McMullen;

impl Expression for McMullen {
    #[inline]
    fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
        let squares = (x.square() + 1.0) * (y.square() + 1.0) * (z.square() + 1.0);
        squares + x * y * z * 8.0 - 2.0
    }
}

crate::field_from_expression!(McMullen);
