//! Value and gradient as one number.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::jet::{Angle, Outer, jet_number, mixed_operators};
use crate::number::{Number, takes_first};

/// A value with its gradient: what a formula returns in forward mode, first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet1 {
    /// The value u.
    pub value: f64,
    /// The derivatives by x, y, z.
    pub gradient: [f64; 3],
}

impl Jet1 {
    pub(crate) const ZERO: Self = Self { value: 0.0, gradient: [0.0; 3] };

    /// The coordinates of a point as the three independent variables.
    #[inline]
    #[must_use]
    pub fn variables(p: [f64; 3]) -> [Self; 3] {
        from_fn(|axis| {
            let mut gradient = [0.0; 3];
            gradient[axis] = 1.0;
            Self { value: p[axis], gradient }
        })
    }

    #[inline]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self { value: f(self.value), gradient: self.gradient.map(f) }
    }

    #[inline]
    fn chain(self, outer: Outer) -> Self {
        Self { value: outer.value, gradient: self.gradient.map(|d| outer.first * d) }
    }

    #[inline]
    fn chain_angle(self, x: Self, angle: Angle) -> Self {
        let [by_y, by_x] = angle.first;
        Self {
            value: angle.value,
            gradient: from_fn(|i| by_y * self.gradient[i] + by_x * x.gradient[i]),
        }
    }
}

impl Add for Jet1 {
    type Output = Self;
    #[inline]
    fn add(self, v: Self) -> Self {
        Self {
            value: self.value + v.value,
            gradient: from_fn(|i| self.gradient[i] + v.gradient[i]),
        }
    }
}

impl Sub for Jet1 {
    type Output = Self;
    #[inline]
    fn sub(self, v: Self) -> Self {
        Self {
            value: self.value - v.value,
            gradient: from_fn(|i| self.gradient[i] - v.gradient[i]),
        }
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
impl Mul for Jet1 {
    type Output = Self;
    #[inline]
    fn mul(self, v: Self) -> Self {
        Self {
            value: self.value * v.value,
            gradient: from_fn(|i| self.value * v.gradient[i] + v.value * self.gradient[i]),
        }
    }
}

impl Div for Jet1 {
    type Output = Self;
    #[inline]
    fn div(self, v: Self) -> Self {
        let value = self.value / v.value;
        let inverse = 1.0 / v.value;
        Self { value, gradient: from_fn(|i| (self.gradient[i] - value * v.gradient[i]) * inverse) }
    }
}

mixed_operators!(Jet1);
jet_number!(Jet1);
