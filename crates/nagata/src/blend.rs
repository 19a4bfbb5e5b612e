//! The blending function that carries a correction into the patch.
//!
//! For the edge opposite corner `i`, from `j` to `k` \[Nagata10 (2.66), (2.73)\],
//!
//! ```text
//! h = b_i b_j² b_k² / w,      w = b_0 b_1 + b_1 b_2 + b_2 b_0,      u = b_k / (b_j + b_k)
//! ```
//!
//! `h` vanishes on all edges. Its derivative across an edge vanishes on the other two and is `b_j b_k`
//! on its own. Value and first derivatives vanish at the corners; the second derivatives have no limit
//! there. With the ratios `α_i = b_j b_k / w` (`α_j`, `α_k` likewise), which lie in [0, 1], every
//! derivative of `h` is a sum of products of one sign: nothing cancels, nothing becomes 0/0.

use bezier_core::{Barycentric, Corner};
use glam::DVec3;

use crate::along::Along;
use crate::base_patch::BarycentricJet;
use crate::triangle::ends_opposite;

/// Bound of the second derivatives of `Σ h_i Γ_i(u_i)` by `(b_0, b_1)` in unit directions, from bounds of
/// `|Γ|`, `|Γ'|` and `|Γ''|`: the largest sums, over the triangle, of the norms of what each is multiplied
/// with. The first one is reached at the corners.
pub(crate) fn largest_second([value, first, second]: [f64; 3]) -> f64 {
    10.17 * value + 0.70 * first + 0.085 * second
}

/// Bound of `|Σ h_i Γ_i|` from one of `|Γ|`: the sum of the `h_i` is `b_0 b_1 b_2`.
pub(crate) fn largest_value(gamma: f64) -> f64 {
    gamma / 27.0
}

/// The blending function of one edge at one point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blend {
    /// The corner opposite the edge, and the corners of the edge.
    corners: [usize; 3],
    /// Barycentric coordinates in this order.
    b: [f64; 3],
    /// Ratios `α` in this order.
    ratios: [f64; 3],
    /// Parameter along the edge.
    pub(crate) u: f64,
}

impl Blend {
    /// For the edge opposite `corner`; `None` at the corners, where all is zero, and beyond them,
    /// where there is no patch.
    #[inline]
    pub(crate) fn at(at: Barycentric, corner: Corner) -> Option<Self> {
        let b = at.to_array();
        let (i, [j, k]) = (corner.index(), ends_opposite(corner));
        let [b_i, b_j, b_k] = [b[i], b[j], b[k]];
        let products = [b_j * b_k, b_k * b_i, b_i * b_j];
        let (w, sum) = (products[0] + products[1] + products[2], b_j + b_k);
        (w > 0.0 && sum > 0.0).then(|| Self {
            corners: [i, j, k],
            b: [b_i, b_j, b_k],
            ratios: products.map(|product| product / w),
            u: b_k / sum,
        })
    }

    /// `h`.
    #[inline]
    pub(crate) fn weight(&self) -> f64 {
        let [b_i, b_j, b_k] = self.b;
        b_i * b_j * b_k * self.ratios[0]
    }

    /// Adds the derivatives of `h Γ(u)`: those of `h` \[Nagata10 (2.87)\], and those of `Γ`.
    #[inline]
    pub(crate) fn add_first(
        &self,
        Along([gamma, slope]): Along<DVec3, 2>,
        partials: &mut [DVec3; 3],
    ) {
        let [b_i, b_j, b_k] = self.b;
        let [r_i, r_j, r_k] = self.ratios;
        let [i, j, k] = self.corners;
        let turn = slope * self.weight_over_square();
        partials[i] += gamma * (b_j * b_k * r_i * r_i);
        partials[j] += gamma * (b_i * b_k * r_i * (1.0 + r_j)) - turn * b_k;
        partials[k] += gamma * (b_i * b_j * r_i * (1.0 + r_k)) + turn * b_j;
    }

    /// Adds the second derivatives of `h Γ(u)`.
    pub(crate) fn add_second(&self, gamma: Along<DVec3, 3>, jet: &mut BarycentricJet) {
        let Along([gamma, slope, half_bend]) = gamma;
        let (u, w) = (self.u, 1.0 - self.u);
        let (first, second) = (self.first_over_sum(), self.second());
        let scale = self.weight_over_square();
        // derivatives of u times b_j + b_k, and the second ones times its square
        let u_first = [0.0, -u, w];
        let u_second = [[0.0; 3], [0.0, 2.0 * u, u - w], [0.0, 0.0, -2.0 * w]];
        for r in 0..3 {
            for s in r..3 {
                let with_slope =
                    first[r] * u_first[s] + first[s] * u_first[r] + scale * u_second[r][s];
                let with_bend = 2.0 * scale * u_first[r] * u_first[s];
                let sum = gamma * second[r][s] + slope * with_slope + half_bend * with_bend;
                jet.add_second(self.corners[r], self.corners[s], sum);
            }
        }
    }

    /// `h / (b_j + b_k)²`.
    #[inline]
    fn weight_over_square(&self) -> f64 {
        self.b[0] * self.ratios[0] * self.u * (1.0 - self.u)
    }

    /// Derivatives of `h` by `b_i, b_j, b_k`, divided by `b_j + b_k`.
    fn first_over_sum(&self) -> [f64; 3] {
        let [b_i, b_j, b_k] = self.b;
        let [r_i, r_j, r_k] = self.ratios;
        let (u, w) = (self.u, 1.0 - self.u);
        [(b_j + b_k) * u * w * r_i * r_i, b_i * u * r_i * (1.0 + r_j), b_i * w * r_i * (1.0 + r_k)]
    }

    /// Second derivatives of `h`; the lower triangle is not filled.
    fn second(&self) -> [[f64; 3]; 3] {
        let [b_i, b_j, b_k] = self.b;
        let [r_i, r_j, r_k] = self.ratios;
        [
            [
                -2.0 * r_i * r_i * r_i * (b_j + b_k),
                b_k * r_i * r_i * (1.0 + 2.0 * r_j),
                b_j * r_i * r_i * (1.0 + 2.0 * r_k),
            ],
            [0.0, 2.0 * b_k * r_j * r_j * r_j, b_i * r_i * (1.0 + r_j + r_k + 2.0 * r_j * r_k)],
            [0.0, 0.0, 2.0 * b_j * r_k * r_k * r_k],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest norms of the three forms `Γ`, `Γ'` and `Γ''` are multiplied with.
    fn norms(at: Barycentric) -> [f64; 3] {
        let of = |corner: Corner, gamma: [f64; 3]| {
            let zero = BarycentricJet {
                point: DVec3::ZERO,
                first: [DVec3::ZERO; 3],
                second: [[DVec3::ZERO; 3]; 3],
            };
            let mut jet = zero;
            let gamma = Along(gamma.map(|g| DVec3::X * g));
            Blend::at(at, corner).expect("not a corner").add_second(gamma, &mut jet);
            let jet = jet.patch_jet();
            let mean = 0.5 * (jet.duu.x + jet.dvv.x);
            mean.abs() + (0.5 * (jet.duu.x - jet.dvv.x)).hypot(jet.duv.x)
        };
        // the last coefficient of a power series is half the second derivative
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.5]]
            .map(|gamma| Corner::ALL.into_iter().map(|corner| of(corner, gamma)).sum())
    }

    #[test]
    fn second_derivatives_stay_below_the_bound_and_reach_it() {
        let mut largest = [0.0_f64; 3];
        let mut look = |at: Barycentric| {
            for (largest, norm) in largest.iter_mut().zip(norms(at)) {
                *largest = largest.max(norm);
            }
        };
        Barycentric::lattice(150).filter(|b| b.u.max(b.v).max(b.w) < 1.0).for_each(&mut look);
        // the directions around the corners
        for k in 0..=400 {
            let (t, e) = (f64::from(k) / 400.0, 1e-9);
            let near = [1.0 - e, e * t, e * (1.0 - t)];
            for turn in 0..3 {
                look(Barycentric::from_array([0, 1, 2].map(|i| near[(i + turn) % 3])));
            }
        }
        for (n, largest) in largest.into_iter().enumerate() {
            let mut only = [0.0; 3];
            only[n] = 1.0;
            let bound = largest_second(only);
            assert!(largest <= bound && largest > 0.98 * bound, "{n}: {largest}, bound {bound}");
        }
    }
}
