//! What the two jets share: operators on either side of an `f64`, and derivatives of the
//! elementary functions.

use crate::number::Number;

/// A function of one variable at one point, or over an interval: value, first and second
/// derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outer<T> {
    pub(crate) value: T,
    pub(crate) first: T,
    pub(crate) second: T,
}

/// The functions whose derivatives are the same terms for points and for intervals.
impl<T: Number> Outer<T> {
    #[inline]
    pub(crate) fn square(u: T) -> Self {
        Self { value: u.square(), first: u * 2.0, second: T::constant(2.0) }
    }

    #[inline]
    pub(crate) fn powi(u: T, n: i32) -> Self {
        let [zero, one] = [0.0, 1.0].map(T::constant);
        // n = 0 and 1 are separate, so that 0 · u⁻¹ does not become NaN at u = 0
        match n {
            0 => Self { value: one, first: zero, second: zero },
            1 => Self { value: u, first: one, second: zero },
            _ => {
                let degree = f64::from(n);
                Self {
                    value: u.powi(n),
                    first: u.powi(n.saturating_sub(1)) * degree,
                    second: u.powi(n.saturating_sub(2)) * (T::constant(degree) * (degree - 1.0)),
                }
            }
        }
    }

    #[inline]
    pub(crate) fn sqrt(u: T) -> Self {
        let value = u.sqrt();
        let first = T::constant(0.5) / value;
        Self { value, first, second: first * -0.5 / u }
    }

    #[inline]
    pub(crate) fn exp(u: T) -> Self {
        let value = u.exp();
        Self { value, first: value, second: value }
    }

    #[inline]
    pub(crate) fn ln(u: T) -> Self {
        let first = T::constant(1.0) / u;
        Self { value: u.ln(), first, second: -first.square() }
    }

    #[inline]
    pub(crate) fn sin(u: T) -> Self {
        let (sin, cos) = (u.sin(), u.cos());
        Self { value: sin, first: cos, second: -sin }
    }

    #[inline]
    pub(crate) fn cos(u: T) -> Self {
        let (sin, cos) = (u.sin(), u.cos());
        Self { value: cos, first: -sin, second: -cos }
    }
}

/// The others at a point.
impl Outer<f64> {
    pub(crate) fn powf(u: f64, c: f64) -> Self {
        // a vanishing factor stands for a vanishing derivative, also where the power is infinite
        let times = |factor: f64, exponent: f64| {
            if factor.abs() > 0.0 { factor * u.powf(exponent) } else { 0.0 }
        };
        Self { value: u.powf(c), first: times(c, c - 1.0), second: times(c * (c - 1.0), c - 2.0) }
    }

    pub(crate) fn tan(u: f64) -> Self {
        let value = u.tan();
        let first = 1.0 + value * value;
        Self { value, first, second: 2.0 * value * first }
    }

    pub(crate) fn tanh(u: f64) -> Self {
        let value = u.tanh();
        // 1 − tanh² would lose all digits where tanh is nearly ±1
        let sech = 1.0 / u.cosh();
        let first = sech * sech;
        Self { value, first, second: -2.0 * value * first }
    }

    pub(crate) fn abs(u: f64) -> Self {
        Self { value: u.abs(), first: if u < 0.0 { -1.0 } else { 1.0 }, second: 0.0 }
    }
}

/// atan2 at one point, or over intervals: value, the two first derivatives, the three second ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle<T> {
    pub(crate) value: T,
    /// Derivatives by y and by x.
    pub(crate) first: [T; 2],
    /// Second derivatives yy and yx; xx is −yy, because the angle is harmonic.
    pub(crate) second: [T; 2],
}

impl Angle<f64> {
    pub(crate) fn of(y: f64, x: f64) -> Self {
        // divide by the larger size, so that the squares neither overflow nor vanish
        let size = y.abs().max(x.abs());
        let (sin, cos) = (y / size, x / size);
        let squared = sin * sin + cos * cos;
        let (sin, cos) = (sin / squared, cos / squared);
        Self {
            value: y.atan2(x),
            first: [cos / size, -sin / size],
            second: [-2.0 * sin * cos / size / size, (sin * sin - cos * cos) / size / size],
        }
    }
}

/// The operators of a jet with an `f64` on either side.
macro_rules! mixed_operators {
    ($jet:ty) => {
        impl Add<f64> for $jet {
            type Output = Self;
            #[inline]
            fn add(self, c: f64) -> Self {
                Self { value: self.value + c, ..self }
            }
        }
        impl Sub<f64> for $jet {
            type Output = Self;
            #[inline]
            fn sub(self, c: f64) -> Self {
                Self { value: self.value - c, ..self }
            }
        }
        impl Mul<f64> for $jet {
            type Output = Self;
            #[inline]
            fn mul(self, c: f64) -> Self {
                self.map(|u| u * c)
            }
        }
        impl Div<f64> for $jet {
            type Output = Self;
            #[inline]
            fn div(self, c: f64) -> Self {
                self.map(|u| u / c)
            }
        }
        impl Neg for $jet {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                self.map(|u| -u)
            }
        }
        impl Add<$jet> for f64 {
            type Output = $jet;
            #[inline]
            fn add(self, u: $jet) -> $jet {
                u + self
            }
        }
        impl Sub<$jet> for f64 {
            type Output = $jet;
            #[inline]
            fn sub(self, u: $jet) -> $jet {
                -u + self
            }
        }
        impl Mul<$jet> for f64 {
            type Output = $jet;
            #[inline]
            fn mul(self, u: $jet) -> $jet {
                u * self
            }
        }
        impl Div<$jet> for f64 {
            type Output = $jet;
            #[inline]
            fn div(self, u: $jet) -> $jet {
                <$jet>::constant(self) / u
            }
        }
    };
}

/// [`Number`] for a jet of `f64` or of intervals with `chain` (a function of one variable after the
/// jet) and `chain_angle`; the macro `choices` defines `min` and `max`.
macro_rules! jet_number {
    ($jet:ident<$scalar:ty>, $choices:ident) => {
        impl Number for $jet<$scalar> {
            #[inline]
            fn constant(c: f64) -> Self {
                Self::constant_of(<$scalar>::constant(c))
            }
            #[inline]
            fn square(self) -> Self {
                self.chain(Outer::square(self.value))
            }
            #[inline]
            fn powi(self, n: i32) -> Self {
                self.chain(Outer::powi(self.value, n))
            }
            #[inline]
            fn powf(self, c: f64) -> Self {
                self.chain(Outer::<$scalar>::powf(self.value, c))
            }
            #[inline]
            fn sqrt(self) -> Self {
                self.chain(Outer::sqrt(self.value))
            }
            #[inline]
            fn exp(self) -> Self {
                self.chain(Outer::exp(self.value))
            }
            #[inline]
            fn ln(self) -> Self {
                self.chain(Outer::ln(self.value))
            }
            #[inline]
            fn sin(self) -> Self {
                self.chain(Outer::sin(self.value))
            }
            #[inline]
            fn cos(self) -> Self {
                self.chain(Outer::cos(self.value))
            }
            #[inline]
            fn tan(self) -> Self {
                self.chain(Outer::<$scalar>::tan(self.value))
            }
            #[inline]
            fn tanh(self) -> Self {
                self.chain(Outer::<$scalar>::tanh(self.value))
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                self.chain_angle(x, Angle::<$scalar>::of(self.value, x.value))
            }
            #[inline]
            fn abs(self) -> Self {
                self.chain(Outer::<$scalar>::abs(self.value))
            }
            $choices!();
        }
    };
}

/// `min` and `max` of jets at a point.
macro_rules! choices_at_a_point {
    () => {
        #[inline]
        fn min(self, other: Self) -> Self {
            let in_order = self.value <= other.value;
            if takes_first(self.value, other.value, in_order) { self } else { other }
        }
        #[inline]
        fn max(self, other: Self) -> Self {
            let in_order = self.value >= other.value;
            if takes_first(self.value, other.value, in_order) { self } else { other }
        }
    };
}

pub(crate) use {choices_at_a_point, jet_number, mixed_operators};
