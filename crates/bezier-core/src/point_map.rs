//! Constant linear combinations of points.

use glam::DVec3;

/// Sums that run side by side, so that they become vector instructions.
const LANES: usize = 4;

/// Fixed linear combinations of a fixed number of points: a constant matrix for many patches.
///
/// With the feature `simd` the widest vector instructions of the processor are used, chosen at run
/// time. Where it has a fused multiply-add, results differ from those without by rounding, below
/// `n ε Σ |weight| |point|` for `n` points.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMap {
    outputs: usize,
    points: usize,
    /// A row for each point: its weight in every combination, padded with zeros to whole lanes.
    weights: Vec<f64>,
}

impl PointMap {
    /// The map from `points` points to `outputs` combinations with the weights
    /// `weight(output, point)`.
    #[must_use]
    pub fn new(outputs: usize, points: usize, weight: impl Fn(usize, usize) -> f64) -> Self {
        let width = outputs.next_multiple_of(LANES);
        let entry = |at: usize| {
            let (point, output) = (at / width, at % width);
            if output < outputs { weight(output, point) } else { 0.0 }
        };
        Self { outputs, points, weights: (0..points * width).map(entry).collect() }
    }

    /// Number of combinations.
    #[must_use]
    pub const fn outputs(&self) -> usize {
        self.outputs
    }

    /// Writes the combinations of these points to `out`.
    ///
    /// # Panics
    ///
    /// If the number of points or of combinations is another.
    pub fn apply(&self, points: &[DVec3], out: &mut [DVec3]) {
        assert_eq!(points.len(), self.points, "one weight for each point");
        assert_eq!(out.len(), self.outputs, "one place for each combination");
        combine(&self.weights, self.outputs.next_multiple_of(LANES), points, out);
    }

    /// The combinations of these points in an array.
    ///
    /// # Panics
    ///
    /// As [`apply`](Self::apply).
    #[inline]
    #[must_use]
    pub fn to_array<const OUT: usize>(&self, points: &[DVec3]) -> [DVec3; OUT] {
        let mut out = [DVec3::ZERO; OUT];
        self.apply(points, &mut out);
        out
    }
}

/// Writes the combinations with a row of `width` weights for each point, `width` a multiple of
/// [`LANES`], to the places of `out`.
#[cfg(feature = "simd")]
use vector::combine;

/// Writes the combinations with a row of `width` weights for each point, `width` a multiple of
/// [`LANES`], to the places of `out`.
#[cfg(not(feature = "simd"))]
fn combine(weights: &[f64], width: usize, points: &[DVec3], out: &mut [DVec3]) {
    for (block, out) in out.chunks_mut(LANES).enumerate() {
        let mut sums = [[0.0; LANES]; 3];
        for (row, point) in weights.chunks_exact(width).zip(points) {
            let row: &[f64; LANES] =
                row[block * LANES..].first_chunk().expect("invariant: whole lanes");
            for lane in 0..LANES {
                sums[0][lane] += row[lane] * point.x;
                sums[1][lane] += row[lane] * point.y;
                sums[2][lane] += row[lane] * point.z;
            }
        }
        for (lane, out) in out.iter_mut().enumerate() {
            *out = DVec3::new(sums[0][lane], sums[1][lane], sums[2][lane]);
        }
    }
}

#[cfg(feature = "simd")]
mod vector {
    use glam::DVec3;
    use pulp::{Arch, Simd, WithSimd};

    use super::LANES;
    use crate::vector_block::{MOST, VectorBlock, sums};

    pub(super) fn combine(weights: &[f64], width: usize, points: &[DVec3], out: &mut [DVec3]) {
        Arch::new().dispatch(Combine { weights, width, points, out });
    }

    struct Combine<'a> {
        weights: &'a [f64],
        width: usize,
        points: &'a [DVec3],
        out: &'a mut [DVec3],
    }

    impl WithSimd for Combine<'_> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(mut self, simd: S) {
            const { assert!(LANES.is_multiple_of(S::F64_LANES), "rows are whole vectors") };
            let mut first = 0;
            while first < self.width {
                let vectors = (self.width - first) / S::F64_LANES;
                let done = if vectors >= MOST {
                    self.block::<S, MOST>(simd, first)
                } else if vectors == 3 {
                    self.block::<S, 3>(simd, first)
                } else if vectors == 2 {
                    self.block::<S, 2>(simd, first)
                } else {
                    self.block::<S, 1>(simd, first)
                };
                first += done;
            }
        }
    }

    impl Combine<'_> {
        /// `K` vectors of combinations from `first` on; returns how many combinations these are.
        #[inline(always)]
        fn block<S: Simd, const K: usize>(&mut self, simd: S, first: usize) -> usize {
            let count = K * S::F64_LANES;
            let rows = self.weights.chunks_exact(self.width).map(|row| &row[first..]);
            let sums = sums::<S, K>(simd, rows, self.points);
            for (k, sums) in sums.into_iter().enumerate() {
                let at = (first + k * S::F64_LANES).min(self.out.len());
                VectorBlock::of::<S>(sums).write(&mut self.out[at..]);
            }
            count
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_and_remainders() {
        let weight = |out: usize, point: usize| (out + 1) as f64 - 2.0 * point as f64;
        let points = [DVec3::X, DVec3::new(1.0, 2.0, -4.0), DVec3::new(0.5, 0.0, 3.0)];
        for outputs in [1, 3, 4, 6, 9, 15, 16, 17, 33, 55] {
            let mut combined = vec![DVec3::NAN; outputs];
            PointMap::new(outputs, points.len(), weight).apply(&points, &mut combined);
            for (out, got) in combined.into_iter().enumerate() {
                let terms = points.iter().enumerate().map(|(j, &p)| p * weight(out, j));
                assert_eq!(got, terms.sum::<DVec3>(), "combination {out} of {outputs}");
            }
        }
    }
}
