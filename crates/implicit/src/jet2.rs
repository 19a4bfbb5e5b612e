//! Value, gradient and Hessian as one number.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::{DMat3, DVec3};

use crate::field::FieldJet;
use crate::interval::{Interval, choices_over_a_box};
use crate::jet::{Angle, Outer, choices_at_a_point, jet_number, mixed_operators};
use crate::number::{Number, takes_first};

/// A value with gradient and Hessian, ten numbers: what a formula returns in forward mode, second
/// order.
///
/// ```
/// use implicit::{Jet2, Number};
///
/// let [x, y, z] = Jet2::variables([1.0, 2.0, 3.0]);
/// let f = x.square() * y + 2.0 * z;
/// assert_eq!(f.gradient, [4.0, 1.0, 2.0]);
/// assert_eq!(f.hessian, [4.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
/// ```
///
/// `Jet2` is that of a point; `Jet2<`[`Interval`]`>` encloses all three over a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet2<T = f64> {
    /// The value u.
    pub value: T,
    /// The derivatives by x, y, z.
    pub gradient: [T; 3],
    /// The second derivatives xx, yy, zz, xy, yz, zx.
    pub hessian: [T; 6],
}

/// The axes of the six second derivatives, in the order of [`Jet2::hessian`].
pub(crate) const AXES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

impl<T: Number> Jet2<T> {
    /// The coordinates of a point, or of a box, as the three independent variables.
    #[inline]
    #[must_use]
    pub fn variables(p: [T; 3]) -> [Self; 3] {
        from_fn(|axis| {
            let mut variable = Self::constant_of(p[axis]);
            variable.gradient[axis] = T::constant(1.0);
            variable
        })
    }

    #[inline]
    pub(crate) fn constant_of(value: T) -> Self {
        let zero = T::constant(0.0);
        Self { value, gradient: [zero; 3], hessian: [zero; 6] }
    }

    #[inline]
    fn map(self, f: impl Fn(T) -> T) -> Self {
        Self { value: f(self.value), gradient: self.gradient.map(&f), hessian: self.hessian.map(f) }
    }

    #[inline]
    fn chain(self, outer: Outer<T>) -> Self {
        let g = self.gradient;
        let bent = g.map(|d| outer.second * d);
        Self {
            value: outer.value,
            gradient: g.map(|d| outer.first * d),
            hessian: from_fn(|k| {
                let (i, j) = AXES[k];
                outer.first * self.hessian[k] + bent[i] * g[j]
            }),
        }
    }

    #[inline]
    fn chain_angle(self, x: Self, angle: Angle<T>) -> Self {
        let [by_y, by_x] = angle.first;
        let [by_yy, by_yx] = angle.second;
        let (u, v) = (self.gradient, x.gradient);
        Self {
            value: angle.value,
            gradient: from_fn(|i| by_y * u[i] + by_x * v[i]),
            hessian: from_fn(|k| {
                let (i, j) = AXES[k];
                by_y * self.hessian[k]
                    + by_x * x.hessian[k]
                    + by_yy * (u[i] * u[j] - v[i] * v[j])
                    + by_yx * (u[i] * v[j] + u[j] * v[i])
            }),
        }
    }
}

impl From<Jet2> for FieldJet {
    #[inline]
    fn from(u: Jet2) -> Self {
        let [xx, yy, zz, xy, yz, zx] = u.hessian;
        Self {
            value: u.value,
            gradient: DVec3::from_array(u.gradient),
            hessian: DMat3::from_cols_array(&[xx, xy, zx, xy, yy, yz, zx, yz, zz]),
        }
    }
}

impl<T: Number> Add for Jet2<T> {
    type Output = Self;
    #[inline]
    fn add(self, v: Self) -> Self {
        Self {
            value: self.value + v.value,
            gradient: from_fn(|i| self.gradient[i] + v.gradient[i]),
            hessian: from_fn(|k| self.hessian[k] + v.hessian[k]),
        }
    }
}

impl<T: Number> Sub for Jet2<T> {
    type Output = Self;
    #[inline]
    fn sub(self, v: Self) -> Self {
        Self {
            value: self.value - v.value,
            gradient: from_fn(|i| self.gradient[i] - v.gradient[i]),
            hessian: from_fn(|k| self.hessian[k] - v.hessian[k]),
        }
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
impl<T: Number> Mul for Jet2<T> {
    type Output = Self;
    #[inline]
    fn mul(self, v: Self) -> Self {
        let (g, h) = (self.gradient, v.gradient);
        Self {
            value: self.value * v.value,
            gradient: from_fn(|i| self.value * h[i] + v.value * g[i]),
            hessian: from_fn(|k| {
                let (i, j) = AXES[k];
                let mixed = g[i] * h[j] + g[j] * h[i];
                self.value * v.hessian[k] + v.value * self.hessian[k] + mixed
            }),
        }
    }
}

impl<T: Number> Div for Jet2<T> {
    type Output = Self;
    #[inline]
    fn div(self, v: Self) -> Self {
        // u = q v differentiated twice and solved for the derivatives of q
        let value = self.value / v.value;
        let inverse = T::constant(1.0) / v.value;
        let h = v.gradient;
        let g: [T; 3] = from_fn(|i| (self.gradient[i] - value * h[i]) * inverse);
        Self {
            value,
            gradient: g,
            hessian: from_fn(|k| {
                let (i, j) = AXES[k];
                let mixed = g[i] * h[j] + g[j] * h[i];
                (self.hessian[k] - value * v.hessian[k] - mixed) * inverse
            }),
        }
    }
}

mixed_operators!(Jet2<f64>);
mixed_operators!(Jet2<Interval>);
jet_number!(Jet2<f64>, choices_at_a_point);
jet_number!(Jet2<Interval>, choices_over_a_box);
