//! A triangle as three quadrilaterals: corner, middle of an edge, centre, middle of the edge before.
//!
//! With the blossom `f` of a patch of degree `n`, the control point `(i, j)` of the quadrilateral at
//! corner `A`, `i` towards the middle `M` of the edge that starts there and `j` towards the middle
//! `L` of the edge that ends there, `C` the centre, is
//!
//! ```text
//! q(i, j) = sum over c of C(i, c) C(n-i, j-c) / C(n, j) f[A^(n-i-j+c), M^(i-c), C^c, L^(j-c)]
//! ```
//!
//! because the bilinear map to the quadrilateral is linear in each of its parameters.

use bezier_core::MultiIndex;
use bezier_core::binomial;
use glam::DVec3;

/// Weights of the control points of a triangle in those of the quadrilateral at its first corner.
#[derive(Debug)]
pub(super) struct ThreeQuads {
    degree: usize,
    /// For each `(i, j)`, rows of `j`, the weight of each control point by rank.
    weights: Vec<Vec<f64>>,
    /// The ranks of the control points of a patch that starts at each corner.
    turned: [Vec<usize>; 3],
}

impl ThreeQuads {
    pub(super) fn new(degree: usize) -> Self {
        let at = |i, j| quad_weights(degree, i, j);
        let weights = (0..=degree).flat_map(|j| (0..=degree).map(move |i| at(i, j))).collect();
        let turn = |corner: usize| {
            let turned = |m: MultiIndex| match corner {
                0 => m,
                1 => MultiIndex::new(m.k, m.i, m.j),
                _ => MultiIndex::new(m.j, m.k, m.i),
            };
            MultiIndex::all(degree).map(|m| turned(m).rank()).collect()
        };
        Self { degree, weights, turned: [0, 1, 2].map(turn) }
    }

    /// The control point `(i, j)` of the quadrilateral at a corner.
    pub(super) fn point(&self, net: &[DVec3], corner: usize, i: usize, j: usize) -> DVec3 {
        let weights = &self.weights[j * (self.degree + 1) + i];
        let turned = self.turned[corner].iter().zip(weights);
        turned.fold(DVec3::ZERO, |sum, (&rank, &weight)| sum + net[rank] * weight)
    }
}

fn quad_weights(n: usize, i: usize, j: usize) -> Vec<f64> {
    const THIRD: f64 = 1.0 / 3.0;
    let [corner, middle, centre, last] =
        [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [THIRD; 3], [0.5, 0.0, 0.5]];
    let mut sum = vec![0.0; MultiIndex::count(n)];
    for c in (i + j).saturating_sub(n)..=i.min(j) {
        let factor = binomial(i, c) * binomial(n - i, j - c) / binomial(n, j);
        let times = [(corner, n + c - i - j), (middle, i - c), (centre, c), (last, j - c)];
        let arguments = times.into_iter().flat_map(|(at, count)| std::iter::repeat_n(at, count));
        for (total, weight) in sum.iter_mut().zip(blossom_weights(arguments)) {
            *total += factor * weight;
        }
    }
    sum
}

/// The weight of each control point in the blossom at these points: the coefficients of the product
/// of their linear forms.
fn blossom_weights(arguments: impl Iterator<Item = [f64; 3]>) -> Vec<f64> {
    let mut weights = vec![1.0];
    for (degree, [u, v, w]) in arguments.enumerate() {
        let mut product = vec![0.0; MultiIndex::count(degree + 1)];
        for (MultiIndex { i, j, k }, weight) in MultiIndex::all(degree).zip(weights) {
            product[MultiIndex::new(i + 1, j, k).rank()] += u * weight;
            product[MultiIndex::new(i, j + 1, k).rank()] += v * weight;
            product[MultiIndex::new(i, j, k + 1).rank()] += w * weight;
        }
        weights = product;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use bezier_core::bernstein;
    use bezier_core::{Barycentric, SepticTriangle};

    fn patch() -> SepticTriangle {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        SepticTriangle::from_fn(|m| {
            DVec3::new(m.j as f64, m.k as f64, 0.0) + DVec3::new(next(), next(), next())
        })
    }

    /// The point of the quadrilateral with these control points.
    fn on_quad(at: impl Fn(usize, usize) -> DVec3, s: f64, t: f64) -> DVec3 {
        let (bs, bt): ([f64; 8], [f64; 8]) = (bernstein(s), bernstein(t));
        let terms = (0..8).flat_map(|i| (0..8).map(move |j| (i, j)));
        terms.map(|(i, j)| at(i, j) * (bs[i] * bt[j])).sum()
    }

    #[test]
    fn quads_are_parts_of_the_patch() {
        let (patch, quads) = (patch(), ThreeQuads::new(7));
        let third = 1.0 / 3.0;
        for corner in 0..3 {
            let turn = |[a, b, c]: [f64; 3]| {
                let mut turned = [a, b, c];
                turned.rotate_right(corner);
                turned
            };
            for (s, t) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.3, 0.8), (0.9, 0.1), (0.5, 1.0)] {
                let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
                let places = [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [third; 3], [0.5, 0.0, 0.5]];
                let mut at = [0.0; 3];
                for (weight, place) in weights.into_iter().zip(places.map(turn)) {
                    at.iter_mut().zip(place).for_each(|(sum, p)| *sum += weight * p);
                }
                let expected = patch.eval_de_casteljau(Barycentric::from_array(at));
                let found = on_quad(|i, j| quads.point(patch.net(), corner, i, j), s, t);
                let size = 8.0;
                assert!(found.distance(expected) < 16.0 * f64::EPSILON * size, "{corner} {s} {t}");
            }
        }
    }
}
