//! Constant linear combinations of points.

use bezier_core::glam::DVec3;

/// Sums that run side by side, so that they become vector instructions.
const LANES: usize = 4;

/// `OUT` fixed combinations of as many points as it is applied to.
pub(crate) struct PointMap<const OUT: usize> {
    points: usize,
    /// For each group of `LANES` combinations the weights of all points, one after the other.
    weights: Vec<[f64; LANES]>,
}

impl<const OUT: usize> PointMap<OUT> {
    /// The map with the weight `weight(out, point)`.
    pub(crate) fn new(points: usize, weight: impl Fn(usize, usize) -> f64) -> Self {
        let groups = 0..OUT.div_ceil(LANES);
        let entry = |out, point| if out < OUT { weight(out, point) } else { 0.0 };
        let weights = groups.flat_map(|group| {
            let entry = &entry;
            (0..points)
                .map(move |point| std::array::from_fn(|lane| entry(group * LANES + lane, point)))
        });
        Self { points, weights: weights.collect() }
    }

    /// The combinations of these points.
    #[inline]
    pub(crate) fn apply(&self, points: &[DVec3]) -> [DVec3; OUT] {
        debug_assert_eq!(points.len(), self.points, "one weight for each point");
        let mut combined = [DVec3::ZERO; OUT];
        let groups = self.weights.chunks_exact(self.points);
        for (out, weights) in combined.chunks_mut(LANES).zip(groups) {
            let mut sums = [[0.0; LANES]; 3];
            for (weights, point) in weights.iter().zip(points) {
                for lane in 0..LANES {
                    sums[0][lane] += weights[lane] * point.x;
                    sums[1][lane] += weights[lane] * point.y;
                    sums[2][lane] += weights[lane] * point.z;
                }
            }
            for (lane, out) in out.iter_mut().enumerate() {
                *out = DVec3::new(sums[0][lane], sums[1][lane], sums[2][lane]);
            }
        }
        combined
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_and_remainders() {
        let weight = |out: usize, point: usize| (out + 1) as f64 - 2.0 * point as f64;
        let points = [DVec3::X, DVec3::new(1.0, 2.0, -4.0), DVec3::new(0.5, 0.0, 3.0)];
        let combined = PointMap::<6>::new(points.len(), weight).apply(&points);
        for (out, got) in combined.into_iter().enumerate() {
            let terms = points.iter().enumerate().map(|(j, &p)| p * weight(out, j));
            assert_eq!(got, terms.sum::<DVec3>(), "combination {out}");
        }
    }
}
