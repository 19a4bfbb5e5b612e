//! An orthonormal frame of the unknowns: first the gradients of the two conditions, then the
//! directions that keep both.

use nalgebra::{SMatrix, SVector};

/// Conditions whose gradients are closer to parallel than this count as one.
const DEPENDENT: f64 = 1e-12;

/// A QR decomposition of the gradients by two Householder reflections.
pub(crate) struct Frame {
    /// The orthonormal frame, one vector a column.
    q: SMatrix<f64, 7, 7>,
    /// The upper triangular factor.
    r: [[f64; 2]; 2],
}

impl Frame {
    /// The frame of two gradients.
    ///
    /// A component in which both gradients vanish stays a frame vector of its own, in its place.
    pub(crate) fn new(gradients: &SMatrix<f64, 7, 2>) -> Self {
        let mut work = *gradients;
        let mut q = SMatrix::<f64, 7, 7>::identity();
        for pivot in 0..2 {
            let mut v: SVector<f64, 7> = work.column(pivot).into_owned();
            v.rows_mut(0, pivot).fill(0.0);
            let norm = v.norm();
            v[pivot] += norm.copysign(v[pivot]);
            let square = v.norm_squared();
            if square > 0.0 {
                let scale = 2.0 / square;
                work -= v * (v.transpose() * work) * scale;
                q -= (q * v) * v.transpose() * scale;
            }
        }
        Self { q, r: [[work[(0, 0)], work[(0, 1)]], [0.0, work[(1, 1)]]] }
    }

    /// The directions that keep both conditions, orthonormal, one a column.
    pub(crate) fn null_space(&self) -> SMatrix<f64, 7, 5> {
        self.q.fixed_columns::<5>(2).into_owned()
    }

    /// The smallest vector that changes the conditions by `defect`; where they depend on each
    /// other, the smallest that meets the first.
    pub(crate) fn smallest_solution(&self, defect: &SVector<f64, 2>) -> SVector<f64, 7> {
        let [[r00, r01], [_, r11]] = self.r;
        if r00.abs() <= f64::MIN_POSITIVE {
            return SVector::zeros();
        }
        let first = defect[0] / r00;
        let rest = defect[1] - r01 * first;
        let second = if r11.abs() > DEPENDENT * r00.abs() { rest / r11 } else { 0.0 };
        self.q.column(0) * first + self.q.column(1) * second
    }
}
