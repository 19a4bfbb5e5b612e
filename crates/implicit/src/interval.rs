//! Intervals with outward rounding.

mod elementary;
mod jet;

use std::ops::{Add, Div, Mul, Neg, Sub};

pub(crate) use self::jet::choices_over_a_box;
use crate::number::Number;

/// All numbers from `lo` to `hi`, both ends included; an infinite end means unbounded.
///
/// Every operation rounds outward by at least one unit in the last place, so that the result
/// contains both the exact value and the value computed in `f64` for all arguments inside.
/// Arguments outside the domain of a function are left out: √[−1, 4] encloses [0, 2]. If no
/// argument is inside, nothing is known and the result is [`ENTIRE`](Self::ENTIRE).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval {
    /// The lower end, at most `hi`.
    pub lo: f64,
    /// The upper end.
    pub hi: f64,
}

impl Interval {
    /// All numbers: nothing is known.
    pub const ENTIRE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// The interval between two numbers, in either order; [`ENTIRE`](Self::ENTIRE) if one is NaN.
    #[must_use]
    pub const fn new(a: f64, b: f64) -> Self {
        if a <= b {
            Self { lo: a, hi: b }
        } else if b < a {
            Self { lo: b, hi: a }
        } else {
            Self::ENTIRE
        }
    }

    /// Whether `x` lies inside, ends included; never true for NaN.
    #[must_use]
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// Whether zero lies inside: the surface may pass.
    #[must_use]
    pub fn contains_zero(self) -> bool {
        self.contains(0.0)
    }

    /// The length hi − lo.
    #[must_use]
    pub fn width(self) -> f64 {
        self.hi - self.lo
    }

    /// The smallest interval that contains both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The ends of a rounded result moved outward by `ulps` units in the last place.
    /// A NaN end (∞ − ∞) becomes infinite.
    fn outward(lo: f64, hi: f64, ulps: u32) -> Self {
        let (mut lo, mut hi) = (lo, hi);
        for _ in 0..ulps {
            (lo, hi) = (lo.next_down(), hi.next_up());
        }
        Self {
            lo: if lo.is_nan() { f64::NEG_INFINITY } else { lo },
            hi: if hi.is_nan() { f64::INFINITY } else { hi },
        }
    }

    /// The interval with both ends moved outward by `ulps` units in the last place.
    fn widened(self, ulps: u32) -> Self {
        Self::outward(self.lo, self.hi, ulps)
    }

    /// |u| over the interval, exact.
    fn magnitude(self) -> Self {
        let (a, b) = (self.lo.abs(), self.hi.abs());
        let lo = if self.contains_zero() { 0.0 } else { a.min(b) };
        Self { lo, hi: a.max(b) }
    }

    /// The interval without its negative part, for results that cannot be negative.
    fn at_least_zero(self) -> Self {
        Self { lo: self.lo.max(0.0), hi: self.hi.max(0.0) }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, v: Self) -> Self {
        Self { lo: sum(self.lo, v.lo).lo, hi: sum(self.hi, v.hi).hi }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, v: Self) -> Self {
        self + -v
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, v: Self) -> Self {
        product(self.lo, v.lo)
            .hull(product(self.lo, v.hi))
            .hull(product(self.hi, v.lo))
            .hull(product(self.hi, v.hi))
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, v: Self) -> Self {
        if v.contains_zero() {
            return Self::ENTIRE;
        }
        quotient(self.lo, v.lo)
            .hull(quotient(self.lo, v.hi))
            .hull(quotient(self.hi, v.lo))
            .hull(quotient(self.hi, v.hi))
    }
}

/// a + b, the point itself if the sum is exact (Knuth's two-sum finds the rounding error).
fn sum(a: f64, b: f64) -> Interval {
    let sum = a + b;
    let b_rounded = sum - a;
    let error = (a - (sum - b_rounded)) + (b - b_rounded);
    // NaN where an operand or the sum is infinite, which is then widened as well
    let exact = error.abs() <= 0.0;
    Interval::outward(sum, sum, if exact { 0 } else { 1 })
}

/// a · b; exactly 0 if a factor is, because an infinite end stands for large numbers.
fn product(a: f64, b: f64) -> Interval {
    if is_zero(a) || is_zero(b) {
        return Interval { lo: 0.0, hi: 0.0 };
    }
    Interval::outward(a * b, a * b, 1)
}

/// a / b for b ≠ 0; between 0 and ±∞ for the quotient of two infinite ends.
fn quotient(a: f64, b: f64) -> Interval {
    if is_zero(a) {
        return Interval { lo: 0.0, hi: 0.0 };
    }
    if a.is_infinite() && b.is_infinite() {
        return Interval::new(0.0, a.signum() * b.signum() * f64::INFINITY);
    }
    Interval::outward(a / b, a / b, 1)
}

fn is_zero(a: f64) -> bool {
    a.abs() <= 0.0
}

impl Add<f64> for Interval {
    type Output = Self;
    fn add(self, c: f64) -> Self {
        self + Self::constant(c)
    }
}

impl Sub<f64> for Interval {
    type Output = Self;
    fn sub(self, c: f64) -> Self {
        self - Self::constant(c)
    }
}

impl Mul<f64> for Interval {
    type Output = Self;
    fn mul(self, c: f64) -> Self {
        self * Self::constant(c)
    }
}

impl Div<f64> for Interval {
    type Output = Self;
    fn div(self, c: f64) -> Self {
        self / Self::constant(c)
    }
}
