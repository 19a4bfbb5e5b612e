//! Value and gradient as one number.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::interval::{Interval, choices_over_a_box};
use crate::jet::{Angle, Outer, choices_at_a_point, jet_number, mixed_operators};
use crate::number::{Number, takes_first};

/// A value with its gradient: what a formula returns in forward mode, first order.
///
/// `Jet1` is that of a point; `Jet1<`[`Interval`]`>` encloses value and gradient over a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet1<T = f64> {
    /// The value u.
    pub value: T,
    /// The derivatives by x, y, z.
    pub gradient: [T; 3],
}

impl<T: Number> Jet1<T> {
    /// The coordinates of a point, or of a box, as the three independent variables.
    #[inline]
    #[must_use]
    pub fn variables(p: [T; 3]) -> [Self; 3] {
        from_fn(|axis| {
            let mut gradient = [T::constant(0.0); 3];
            gradient[axis] = T::constant(1.0);
            Self { value: p[axis], gradient }
        })
    }

    #[inline]
    pub(crate) fn constant_of(value: T) -> Self {
        Self { value, gradient: [T::constant(0.0); 3] }
    }

    #[inline]
    fn map(self, f: impl Fn(T) -> T) -> Self {
        Self { value: f(self.value), gradient: self.gradient.map(f) }
    }

    #[inline]
    pub(crate) fn chain(self, outer: Outer<T>) -> Self {
        Self { value: outer.value, gradient: self.gradient.map(|d| outer.first * d) }
    }

    #[inline]
    pub(crate) fn chain_angle(self, x: Self, angle: Angle<T>) -> Self {
        let [by_y, by_x] = angle.first;
        let gradient = from_fn(|i| by_y * self.gradient[i] + by_x * x.gradient[i]);
        Self { value: angle.value, gradient }
    }
}

impl<T: Number> Add for Jet1<T> {
    type Output = Self;
    #[inline]
    fn add(self, v: Self) -> Self {
        Self {
            value: self.value + v.value,
            gradient: from_fn(|i| self.gradient[i] + v.gradient[i]),
        }
    }
}

impl<T: Number> Sub for Jet1<T> {
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
impl<T: Number> Mul for Jet1<T> {
    type Output = Self;
    #[inline]
    fn mul(self, v: Self) -> Self {
        Self {
            value: self.value * v.value,
            gradient: from_fn(|i| self.value * v.gradient[i] + v.value * self.gradient[i]),
        }
    }
}

impl<T: Number> Div for Jet1<T> {
    type Output = Self;
    #[inline]
    fn div(self, v: Self) -> Self {
        let value = self.value / v.value;
        let inverse = T::constant(1.0) / v.value;
        Self { value, gradient: from_fn(|i| (self.gradient[i] - value * v.gradient[i]) * inverse) }
    }
}

mixed_operators!(Jet1<f64>);
mixed_operators!(Jet1<Interval>);
jet_number!(Jet1<f64>, choices_at_a_point);
jet_number!(Jet1<Interval>, choices_over_a_box);
