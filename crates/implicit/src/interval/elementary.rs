//! Powers and elementary functions of intervals.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Interval;
use crate::number::{Number, positive_power};

/// By how many units in the last place results of the platform's mathematical functions are
/// widened.
///
/// The common libraries stay below one unit for sin, cos, tan, exp, ln and pow and below two for
/// tanh and atan2; the language promises nothing, so we double the worst.
pub(super) const LIBRARY_ULPS: u32 = 4;

/// Angles above this size are not reduced by periods: neighbouring numbers are then 2⁻¹² apart or
/// more, and the whole range is the honest answer.
const LARGEST_REDUCED_ANGLE: f64 = 1.0e12;

impl Interval {
    /// An increasing function of the platform, widened.
    fn increasing(self, f: impl Fn(f64) -> f64) -> Self {
        Self::outward(f(self.lo), f(self.hi), LIBRARY_ULPS)
    }

    /// Whether `phase` + k · `period` lies inside for an integer k, answered "yes" when in doubt.
    fn may_contain_multiple(self, phase: f64, period: f64) -> bool {
        let periods = |angle: f64, side: f64| {
            let margin = 8.0 * f64::EPSILON * (angle.abs() + period);
            ((angle + side * margin - phase) / period).floor()
        };
        periods(self.lo, -1.0) < periods(self.hi, 1.0)
    }

    fn is_reducible_angle(self, period: f64) -> bool {
        self.width() < period && self.magnitude().hi <= LARGEST_REDUCED_ANGLE
    }

    /// sin or cos: monotone between the tops `top` + 2πk and the bottoms half a period further.
    fn wave(self, f: impl Fn(f64) -> f64, top: f64) -> Self {
        let range = Self { lo: -1.0, hi: 1.0 };
        if !self.is_reducible_angle(TAU) {
            return range;
        }
        let (a, b) = (f(self.lo), f(self.hi));
        let ends = Self::outward(a.min(b), a.max(b), LIBRARY_ULPS);
        Self {
            lo: if self.may_contain_multiple(top - PI, TAU) { -1.0 } else { ends.lo.max(-1.0) },
            hi: if self.may_contain_multiple(top, TAU) { 1.0 } else { ends.hi.min(1.0) },
        }
    }

    /// uⁿ, n ≥ 1, with both ends rounded outward in every product.
    fn positive_powi(self, n: u32) -> Self {
        let end = |u: f64| positive_power(Self { lo: u, hi: u }, n);
        if n % 2 == 1 {
            let end_of = |u: f64| if u < 0.0 { -end(-u) } else { end(u) };
            return Self { lo: end_of(self.lo).lo, hi: end_of(self.hi).hi };
        }
        let size = self.magnitude();
        Self { lo: end(size.lo).lo, hi: end(size.hi).hi }.at_least_zero()
    }
}

impl Number for Interval {
    fn constant(c: f64) -> Self {
        Self::new(c, c)
    }

    fn square(self) -> Self {
        self.positive_powi(2)
    }

    fn powi(self, n: i32) -> Self {
        match n {
            0 => Self::constant(1.0),
            1 => self,
            2.. => self.positive_powi(n.unsigned_abs()),
            _ => Self::constant(1.0) / self.positive_powi(n.unsigned_abs()),
        }
    }

    /// Below zero the power exists only for integers c, about which nothing is said here: the
    /// parser turns them into [`powi`](Number::powi).
    fn powf(self, c: f64) -> Self {
        let defined_below_zero = c.fract().abs() <= 0.0;
        if self.hi < 0.0 || (self.lo < 0.0 && defined_below_zero) {
            return Self::ENTIRE;
        }
        let inside = self.at_least_zero();
        let (a, b) = (inside.lo.powf(c), inside.hi.powf(c));
        Self::outward(a.min(b), a.max(b), LIBRARY_ULPS).at_least_zero()
    }

    fn sqrt(self) -> Self {
        if self.hi < 0.0 {
            return Self::ENTIRE;
        }
        let inside = self.at_least_zero();
        Self::outward(inside.lo.sqrt(), inside.hi.sqrt(), 1).at_least_zero()
    }

    fn exp(self) -> Self {
        self.increasing(f64::exp).at_least_zero()
    }

    fn ln(self) -> Self {
        if self.hi < 0.0 { Self::ENTIRE } else { self.at_least_zero().increasing(f64::ln) }
    }

    fn sin(self) -> Self {
        self.wave(f64::sin, FRAC_PI_2)
    }

    fn cos(self) -> Self {
        self.wave(f64::cos, 0.0)
    }

    fn tan(self) -> Self {
        if !self.is_reducible_angle(PI) || self.may_contain_multiple(FRAC_PI_2, PI) {
            return Self::ENTIRE;
        }
        self.increasing(f64::tan)
    }

    fn tanh(self) -> Self {
        let range = self.increasing(f64::tanh);
        Self { lo: range.lo.max(-1.0), hi: range.hi.min(1.0) }
    }

    /// The whole circle if the box touches the origin or the cut along the negative x-axis;
    /// otherwise the angle has its extremes at corners.
    fn atan2(self, x: Self) -> Self {
        let half_turn = PI.next_up();
        let on_cut = self.contains_zero() && x.lo <= 0.0;
        if on_cut || [self.lo, self.hi, x.lo, x.hi].iter().any(|end| end.is_infinite()) {
            return Self { lo: -half_turn, hi: half_turn };
        }
        let corners =
            [self.lo.atan2(x.lo), self.lo.atan2(x.hi), self.hi.atan2(x.lo), self.hi.atan2(x.hi)];
        let lo = corners.into_iter().fold(f64::INFINITY, f64::min);
        let hi = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self::outward(lo, hi, LIBRARY_ULPS)
    }

    fn abs(self) -> Self {
        self.magnitude()
    }

    fn min(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.min(other.hi) }
    }

    fn max(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.max(other.hi) }
    }
}
