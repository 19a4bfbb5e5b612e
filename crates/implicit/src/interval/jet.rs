//! Value and gradient enclosed over a box.
//!
//! The operations are those of [`Jet1`] at a point in the same order, each rounded outward, so that
//! the gradient computed in `f64` stays inside. Where a function jumps, its derivative is
//! [`Interval::ENTIRE`] and stays so through every function around it: no derivative of an outer
//! function is the number zero where its argument is unbounded.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary::LIBRARY_ULPS;
use super::{Interval, is_zero};
use crate::jet::mixed_operators;
use crate::jet1::Jet1;
use crate::number::Number;

/// By how many units the derivatives of [`tanh`](Number::tanh) and [`atan2`](Number::atan2) are
/// widened: at a point they are computed by other operations, up to eight after one another.
const DETOUR_ULPS: u32 = 4 * LIBRARY_ULPS;

impl Interval {
    /// 1/cosh² over the interval: falls with |u|.
    fn sech_squared(self) -> Self {
        let of = |u: f64| (1.0 / u.cosh()) * (1.0 / u.cosh());
        let size = self.magnitude();
        let range = Self::outward(of(size.hi), of(size.lo), DETOUR_ULPS).at_least_zero();
        Self { hi: range.hi.min(1.0), ..range }
    }

    /// The derivative of u^c.
    fn powf_slope(self, c: f64) -> Self {
        if is_zero(c) {
            return Self::constant(0.0);
        }
        let exponent = c - 1.0;
        let power = self.powf(exponent);
        // the exponent may be rounded: then the true one lies between its neighbours
        let rounded = (exponent + 1.0).to_bits() != c.to_bits();
        let power = if rounded {
            let neighbours = [exponent.next_down(), exponent.next_up()].map(|e| self.powf(e));
            power.hull(neighbours[0]).hull(neighbours[1])
        } else {
            power
        };
        power * c
    }
}

impl Jet1<Interval> {
    /// Both gradients are possible.
    fn either(self, other: Self, value: Interval) -> Self {
        let gradient = std::array::from_fn(|i| self.gradient[i].hull(other.gradient[i]));
        Self { value, gradient }
    }
}

mixed_operators!(Jet1<Interval>);

impl Number for Jet1<Interval> {
    fn constant(c: f64) -> Self {
        Self { value: Interval::constant(c), gradient: [Interval::constant(0.0); 3] }
    }

    fn square(self) -> Self {
        let u = self.value;
        self.composed(u.square(), u * 2.0)
    }

    fn powi(self, n: i32) -> Self {
        let u = self.value;
        match n {
            0 => Self::constant(1.0),
            1 => self,
            _ => self.composed(u.powi(n), u.powi(n.saturating_sub(1)) * f64::from(n)),
        }
    }

    fn powf(self, c: f64) -> Self {
        self.composed(self.value.powf(c), self.value.powf_slope(c))
    }

    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        self.composed(value, Interval::constant(0.5) / value)
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        self.composed(value, value)
    }

    fn ln(self) -> Self {
        self.composed(self.value.ln(), Interval::constant(1.0) / self.value)
    }

    fn sin(self) -> Self {
        self.composed(self.value.sin(), self.value.cos())
    }

    fn cos(self) -> Self {
        self.composed(self.value.cos(), -self.value.sin())
    }

    fn tan(self) -> Self {
        let value = self.value.tan();
        // 1 + tan² would call the slope across a pole positive
        let slope = if value == Interval::ENTIRE { value } else { value.square() + 1.0 };
        self.composed(value, slope)
    }

    fn tanh(self) -> Self {
        self.composed(self.value.tanh(), self.value.sech_squared())
    }

    fn atan2(self, x: Self) -> Self {
        let (sin, cos) = (self.value, x.value);
        let value = sin.atan2(cos);
        // a jump of a whole turn
        let on_cut = sin.contains_zero() && cos.lo <= 0.0;
        let size_squared = sin.square() + cos.square();
        let slope = |u: Interval| {
            if on_cut { Interval::ENTIRE } else { (u / size_squared).widened(DETOUR_ULPS) }
        };
        self.composed_with(x, value, [slope(cos), slope(-sin)])
    }

    fn abs(self) -> Self {
        let u = self.value;
        let sign = if u.lo >= 0.0 {
            Interval::constant(1.0)
        } else if u.hi < 0.0 {
            Interval::constant(-1.0)
        } else {
            Interval::new(-1.0, 1.0)
        };
        self.composed(u.abs(), sign)
    }

    fn min(self, other: Self) -> Self {
        let (u, v) = (self.value, other.value);
        if u.hi <= v.lo {
            self
        } else if v.hi < u.lo {
            other
        } else {
            self.either(other, u.min(v))
        }
    }

    fn max(self, other: Self) -> Self {
        let (u, v) = (self.value, other.value);
        if u.lo >= v.hi {
            self
        } else if v.lo > u.hi {
            other
        } else {
            self.either(other, u.max(v))
        }
    }
}
