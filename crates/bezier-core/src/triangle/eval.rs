//! Evaluation: de Casteljau's algorithm as the readable reference, sums over constant tables as the
//! fast road.
//!
//! Summing `Σ c_{m+a} B_m` over the Bernstein basis of degree `n - s` gives the control points `a`,
//! `|a| = s`, that de Casteljau's algorithm has left after `n - s` levels. Point and derivatives of
//! order up to `s` follow from them. By the numbering of
//! [`MultiIndex`](crate::MultiIndex) the point `m + a` is found without knowing the degree.

use glam::DVec3;

use super::BezierTriangle;
use crate::barycentric::Barycentric;
use crate::bernstein::binomial;
use crate::coefficient::Coefficient;
use crate::jet::PatchJet;
use crate::patch::ParametricPatch;

/// Highest degree of a patch that can be evaluated.
pub(crate) const MAX_DEGREE: usize = 12;

/// Powers `x^0 ..= x^MAX_DEGREE`.
#[inline]
fn powers(x: f64, degree: usize) -> [f64; MAX_DEGREE + 1] {
    let mut powers = [1.0; MAX_DEGREE + 1];
    for d in 1..=degree {
        powers[d] = powers[d - 1] * x;
    }
    powers
}

/// Calls `f(rank, row, value)` for each Bernstein polynomial of this degree.
#[inline]
fn for_each_basis_value(degree: usize, at: Barycentric, mut f: impl FnMut(usize, usize, f64)) {
    let (pu, pv, pw) = (powers(at.u, degree), powers(at.v, degree), powers(at.w, degree));
    let mut rank = 0;
    for row in 0..=degree {
        let outer = binomial(degree, row) * pu[degree - row];
        for k in 0..=row {
            f(rank, row, outer * (binomial(row, k) * (pv[row - k] * pw[k])));
            rank += 1;
        }
    }
}

impl<V: Coefficient, const P: usize> BezierTriangle<V, P> {
    /// Value by de Casteljau's algorithm: slower than [`eval`](Self::eval), equal to round-off.
    #[must_use]
    pub fn eval_de_casteljau(&self, at: Barycentric) -> V {
        let mut level = self.net;
        for degree in (0..Self::DEGREE).rev() {
            let mut rank = 0;
            for row in 0..=degree {
                for _ in 0..=row {
                    level[rank] = level[rank] * at.u
                        + level[rank + row + 1] * at.v
                        + level[rank + row + 2] * at.w;
                    rank += 1;
                }
            }
        }
        level[0]
    }

    /// Value at these parameters; they may lie outside the triangle.
    #[inline]
    #[must_use]
    pub fn eval(&self, at: Barycentric) -> V {
        const { assert!(Self::DEGREE <= MAX_DEGREE, "degree above the tables") };
        let mut sum = V::ZERO;
        for_each_basis_value(Self::DEGREE, at, |rank, _, b| sum = sum + self.net[rank] * b);
        sum
    }

    /// The three control points left after all levels of de Casteljau's algorithm but one:
    /// `eval = u a + v b + w c`, the derivative from corner `i` to corner `j` is
    /// `degree * (point_j - point_i)`.
    #[inline]
    #[must_use]
    pub fn last_triangle(&self, at: Barycentric) -> [V; 3] {
        const { assert!(Self::DEGREE >= 1 && Self::DEGREE <= MAX_DEGREE, "degree not in range") };
        let mut last = [V::ZERO; 3];
        for_each_basis_value(Self::DEGREE - 1, at, |rank, row, b| {
            last[0] = last[0] + self.net[rank] * b;
            last[1] = last[1] + self.net[rank + row + 1] * b;
            last[2] = last[2] + self.net[rank + row + 2] * b;
        });
        last
    }

    /// The six control points left after all levels but two, by rank.
    #[inline]
    fn last_quadratic(&self, at: Barycentric) -> [V; 6] {
        const { assert!(Self::DEGREE >= 2 && Self::DEGREE <= MAX_DEGREE, "degree not in range") };
        let mut last = [V::ZERO; 6];
        for_each_basis_value(Self::DEGREE - 2, at, |rank, row, b| {
            let next = rank + row + 1;
            let after = next + row + 2;
            for (slot, source) in
                [rank, next, next + 1, after, after + 1, after + 2].into_iter().enumerate()
            {
                last[slot] = last[slot] + self.net[source] * b;
            }
        });
        last
    }
}

impl<const P: usize> BezierTriangle<DVec3, P> {
    /// Point and area normal `du × dv` (not normalised), the cheapest way to both.
    #[inline]
    #[must_use]
    pub fn point_and_area_normal(&self, at: Barycentric) -> (DVec3, DVec3) {
        let [a, b, c] = self.last_triangle(at);
        let degree = Self::DEGREE as f64;
        let normal = (a - c).cross(b - c) * (degree * degree);
        (a * at.u + b * at.v + c * at.w, normal)
    }
}

impl<const P: usize> ParametricPatch for BezierTriangle<DVec3, P> {
    #[inline]
    fn point(&self, at: Barycentric) -> DVec3 {
        self.eval(at)
    }

    fn jet(&self, at: Barycentric) -> PatchJet {
        let [q200, q110, q101, q020, q011, q002] = self.last_quadratic(at);
        let Barycentric { u, v, w } = at;
        let a = q200 * u + q110 * v + q101 * w;
        let b = q110 * u + q020 * v + q011 * w;
        let c = q101 * u + q011 * v + q002 * w;
        let first = Self::DEGREE as f64;
        let second = first * (first - 1.0);
        PatchJet {
            point: a * u + b * v + c * w,
            du: (a - c) * first,
            dv: (b - c) * first,
            duu: ((q200 - q101) - (q101 - q002)) * second,
            duv: ((q110 - q101) - (q011 - q002)) * second,
            dvv: ((q020 - q011) - (q011 - q002)) * second,
        }
    }
}
