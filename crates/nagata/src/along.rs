//! Quantities along an edge with their derivatives: truncated power series.

use std::ops::{Add, Sub};

use glam::DVec3;

/// The first `K` coefficients of a power series in the edge parameter: value, first derivative, half
/// the second derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Along<V, const K: usize>(pub(crate) [V; K]);

impl<V: Copy + Default, const K: usize> Along<V, K> {
    pub(crate) fn zero() -> Self {
        Self([V::default(); K])
    }

    pub(crate) fn constant(value: V) -> Self {
        Self::quadratic(value, V::default(), V::default())
    }

    /// From the coefficients of a polynomial of degree two.
    #[inline]
    fn quadratic(value: V, first: V, half_second: V) -> Self {
        Self(std::array::from_fn(|n| match n {
            0 => value,
            1 => first,
            2 => half_second,
            _ => V::default(),
        }))
    }

    #[inline]
    fn product<A: Copy, B: Copy>(a: &[A; K], b: &[B; K], times: impl Fn(A, B) -> V) -> Self
    where
        V: Add<Output = V>,
    {
        Self(std::array::from_fn(|n| {
            (0..=n).fold(V::default(), |sum, k| sum + times(a[k], b[n - k]))
        }))
    }
}

impl<const K: usize> Along<f64, K> {
    /// The linear function with these values at 0 and 1.
    #[inline]
    pub(crate) fn line([start, end]: [f64; 2], u: f64) -> Self {
        Self::quadratic(start * (1.0 - u) + end * u, end - start, 0.0)
    }

    #[inline]
    pub(crate) fn times(&self, other: &Self) -> Self {
        Self::product(&self.0, &other.0, |a, b| a * b)
    }

    /// The quotient; the divisor's value must not be zero.
    #[inline]
    pub(crate) fn over(&self, divisor: &Self) -> Self {
        let mut quotient = Self::zero();
        for n in 0..K {
            let known = (0..n).fold(0.0, |sum, k| sum + quotient.0[k] * divisor.0[n - k]);
            quotient.0[n] = (self.0[n] - known) / divisor.0[0];
        }
        quotient
    }
}

impl<const K: usize> Along<DVec3, K> {
    /// The linear function with these values at 0 and 1.
    #[inline]
    pub(crate) fn line([start, end]: [DVec3; 2], u: f64) -> Self {
        Self::quadratic(start * (1.0 - u) + end * u, end - start, DVec3::ZERO)
    }

    /// The quadratic with these Bézier coefficients.
    #[inline]
    pub(crate) fn bezier([a, b, c]: [DVec3; 3], u: f64) -> Self {
        let w = 1.0 - u;
        Self::quadratic(
            a * (w * w) + b * (2.0 * w * u) + c * (u * u),
            ((b - a) * w + (c - b) * u) * 2.0,
            a - b * 2.0 + c,
        )
    }

    #[inline]
    pub(crate) fn dot(&self, other: &Self) -> Along<f64, K> {
        Along::product(&self.0, &other.0, DVec3::dot)
    }

    #[inline]
    pub(crate) fn times(&self, factor: &Along<f64, K>) -> Self {
        Self::product(&self.0, &factor.0, |a, b| a * b)
    }
}

impl<V: Copy + Sub<Output = V>, const K: usize> Sub for Along<V, K> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|n| self.0[n] - other.0[n]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_power_series() {
        // (1 + u)² / (1 + u) = 1 + u, at u = 0.25
        let line = Along::<f64, 3>::line([1.0, 2.0], 0.25);
        let quotient = line.times(&line).over(&line);
        assert_eq!(quotient, line);
    }

    #[test]
    fn coefficients_are_those_of_the_polynomial() {
        let points = [DVec3::X, DVec3::new(0.5, 1.0, -1.0), DVec3::Z];
        let Along([value, first, half_second]) = Along::<DVec3, 3>::bezier(points, 0.25);
        let moved = Along::<DVec3, 3>::bezier(points, 0.75).0[0];
        let expected = value + first * 0.5 + half_second * 0.25;
        assert!(moved.distance(expected) <= 4.0 * f64::EPSILON, "{moved} {expected}");
    }
}
