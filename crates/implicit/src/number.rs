//! The number type over which formulas are generic, and its simplest implementor, `f64`.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number for formulas: `f64` gives the value, [`Jet1`](crate::Jet1) adds the gradient,
/// [`Jet2`](crate::Jet2) the Hessian, [`Interval`](crate::Interval) encloses the value over a box, and
/// `Jet1<Interval>` and `Jet2<Interval>` the derivatives as well.
///
/// Derivatives where there are two to choose from are one-sided and never NaN: at a tie
/// [`min`](Self::min) and [`max`](Self::max) take those of `self`, and [`abs`](Self::abs) at zero
/// those of its argument, as max(u, −u) does.
/// Where no finite derivative exists (√u at 0) it is infinite or NaN.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A number that does not depend on the point.
    fn constant(c: f64) -> Self;

    /// u², tighter than u·u for intervals and cheaper for jets.
    #[must_use]
    fn square(self) -> Self;
    /// uⁿ by multiplication; u⁰ = 1 everywhere.
    #[must_use]
    fn powi(self, n: i32) -> Self;
    /// u^c for a real constant c; NaN for u < 0 unless c is an integer.
    #[must_use]
    fn powf(self, c: f64) -> Self;
    /// √u; NaN for u < 0.
    #[must_use]
    fn sqrt(self) -> Self;
    /// eᵘ.
    #[must_use]
    fn exp(self) -> Self;
    /// The natural logarithm; NaN for u < 0.
    #[must_use]
    fn ln(self) -> Self;
    /// The sine of an angle in radians.
    #[must_use]
    fn sin(self) -> Self;
    /// The cosine of an angle in radians.
    #[must_use]
    fn cos(self) -> Self;
    /// The tangent of an angle in radians.
    #[must_use]
    fn tan(self) -> Self;
    /// The hyperbolic tangent.
    #[must_use]
    fn tanh(self) -> Self;
    /// The angle of the vector (`x`, `self`) in (−π, π].
    #[must_use]
    fn atan2(self, x: Self) -> Self;
    /// |u|.
    #[must_use]
    fn abs(self) -> Self;
    /// The smaller of two numbers; NaN if one of them is.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers; NaN if one of them is.
    #[must_use]
    fn max(self, other: Self) -> Self;
}

/// uⁿ for n ≥ 1 by repeated squaring, alike on all platforms.
///
/// For u ≥ 0 the rounded result grows with u, because every product does: the interval power
/// rests on that.
#[inline]
pub(crate) fn positive_power<T: Copy + Mul<Output = T>>(base: T, n: u32) -> T {
    let mut power = base;
    for bit in (0..n.ilog2()).rev() {
        power = power * power;
        if n >> bit & 1 == 1 {
            power = power * base;
        }
    }
    power
}

impl Number for f64 {
    #[inline]
    fn constant(c: f64) -> Self {
        c
    }
    #[inline]
    fn square(self) -> Self {
        self * self
    }
    #[inline]
    fn powi(self, n: i32) -> Self {
        match n {
            0 => 1.0,
            1.. => positive_power(self, n.unsigned_abs()),
            _ => 1.0 / positive_power(self, n.unsigned_abs()),
        }
    }
    #[inline]
    fn powf(self, c: f64) -> Self {
        self.powf(c)
    }
    #[inline]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline]
    fn exp(self) -> Self {
        self.exp()
    }
    #[inline]
    fn ln(self) -> Self {
        self.ln()
    }
    #[inline]
    fn sin(self) -> Self {
        self.sin()
    }
    #[inline]
    fn cos(self) -> Self {
        self.cos()
    }
    #[inline]
    fn tan(self) -> Self {
        self.tan()
    }
    #[inline]
    fn tanh(self) -> Self {
        self.tanh()
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        self.atan2(x)
    }
    #[inline]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline]
    fn min(self, other: Self) -> Self {
        if takes_first(self, other, self <= other) { self } else { other }
    }
    #[inline]
    fn max(self, other: Self) -> Self {
        if takes_first(self, other, self >= other) { self } else { other }
    }
}

/// The choice of min and max: NaN wins, ties go to the first.
#[inline]
pub(crate) fn takes_first(first: f64, second: f64, in_order: bool) -> bool {
    !second.is_nan() && (in_order || first.is_nan())
}
