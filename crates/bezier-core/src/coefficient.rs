//! What can stand in a control net.

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

use glam::DVec3;

/// A value that can be averaged: what the coefficients of a Bernstein form must be.
///
/// Implemented for `f64` (weight functions, trivariate forms) and [`DVec3`] (points).
pub trait Coefficient:
    Copy + Debug + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
    /// The neutral element of addition.
    const ZERO: Self;

    /// `(1 - t) a + t b`, the step of de Casteljau's algorithm.
    #[inline]
    #[must_use]
    fn between(a: Self, b: Self, t: f64) -> Self {
        a * (1.0 - t) + b * t
    }
}

impl Coefficient for f64 {
    const ZERO: Self = 0.0;
}

impl Coefficient for DVec3 {
    const ZERO: Self = Self::ZERO;
}
