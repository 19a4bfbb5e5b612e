//! Value and derivatives enclosed over a box.
//!
//! The operations are those of the jets at a point in the same order, each rounded outward, so that
//! the derivatives computed in `f64` stay inside. Where a function jumps, its derivatives are
//! [`Interval::ENTIRE`] and stay so through every function around it: no first derivative of an
//! outer function is the number zero where its argument is unbounded. Where only the gradient jumps,
//! at a kink, the same holds for the second derivatives.

use std::array::from_fn;

use super::elementary::LIBRARY_ULPS;
use super::{Interval, is_zero};
use crate::jet::{Angle, Outer};
use crate::jet1::Jet1;
use crate::jet2::{AXES, Jet2};
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

    /// u^(c − `steps`).
    fn powf_less(self, c: f64, steps: f64) -> Self {
        let exponent = Self::constant(c) - steps;
        let power = self.powf(exponent.lo);
        // a rounded exponent lies between its neighbours
        if exponent.lo < exponent.hi { power.hull(self.powf(exponent.hi)) } else { power }
    }
}

/// The functions whose derivatives need more than the terms at a point.
impl Outer<Interval> {
    pub(crate) fn powf(u: Interval, c: f64) -> Self {
        // a vanishing factor stands for a vanishing derivative, also where the power is unbounded
        let times = |factor: Interval, steps: f64| {
            let vanishes = is_zero(factor.lo) && is_zero(factor.hi);
            if vanishes { factor } else { u.powf_less(c, steps) * factor }
        };
        let degree = Interval::constant(c);
        Self {
            value: u.powf(c),
            first: times(degree, 1.0),
            second: times(degree * (degree - 1.0), 2.0),
        }
    }

    pub(crate) fn tan(u: Interval) -> Self {
        let value = u.tan();
        // 1 + tan² would call the slope across a pole positive
        let first = if value == Interval::ENTIRE { value } else { value.square() + 1.0 };
        Self { value, first, second: value * 2.0 * first }
    }

    pub(crate) fn tanh(u: Interval) -> Self {
        let (value, first) = (u.tanh(), u.sech_squared());
        Self { value, first, second: value * -2.0 * first }
    }

    pub(crate) fn abs(u: Interval) -> Self {
        let [zero, one] = [0.0, 1.0].map(Interval::constant);
        let (first, second) = if u.lo >= 0.0 {
            (one, zero)
        } else if u.hi < 0.0 {
            (-one, zero)
        } else {
            (one.hull(-one), Interval::ENTIRE)
        };
        Self { value: u.abs(), first, second }
    }
}

impl Angle<Interval> {
    pub(crate) fn of(y: Interval, x: Interval) -> Self {
        let value = y.atan2(x);
        // a jump of a whole turn
        if y.contains_zero() && x.lo <= 0.0 {
            return Self { value, first: [Interval::ENTIRE; 2], second: [Interval::ENTIRE; 2] };
        }
        let size_squared = y.square() + x.square();
        let [sin, cos] = [y, x].map(|u| (u / size_squared).widened(DETOUR_ULPS));
        // the difference may cancel, which magnifies the errors of the squares: they are covered by
        // the widening of sin and cos
        let second = [sin * cos * -2.0, sin.square() - cos.square()];
        Self { value, first: [cos, -sin], second: second.map(|u| u.widened(DETOUR_ULPS)) }
    }
}

impl Jet1<Interval> {
    /// Both jets are possible.
    pub(crate) fn either(self, other: Self, value: Interval) -> Self {
        Self { value, gradient: from_fn(|i| self.gradient[i].hull(other.gradient[i])) }
    }
}

impl Jet2<Interval> {
    /// Both jets are possible, and between them the gradient may jump.
    pub(crate) fn either(self, other: Self, value: Interval) -> Self {
        let jump: [Interval; 3] = from_fn(|i| self.gradient[i] - other.gradient[i]);
        Self {
            value,
            gradient: from_fn(|i| self.gradient[i].hull(other.gradient[i])),
            hessian: from_fn(|k| {
                let (i, j) = AXES[k];
                // zero along the kink, where nothing jumps
                let bend = Interval::ENTIRE * jump[i] * jump[j];
                self.hessian[k].hull(other.hessian[k]) + bend
            }),
        }
    }
}

/// `min` and `max` of jets over a box.
macro_rules! choices_over_a_box {
    () => {
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
    };
}

pub(crate) use choices_over_a_box;
