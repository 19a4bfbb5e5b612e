//! Constant weights of the points of rows and curves.

use std::sync::LazyLock;

use bezier_core::{bernstein, binomial};

/// Parameters at which rows and surface are compared: midpoints of nine sections.
pub(super) const SAMPLES: usize = 9;
/// Degrees along the edge that rows should not have.
const HIGH_DEGREES: [usize; 2] = [5, 6];

pub(super) const fn parameter(j: usize) -> f64 {
    (j as f64 + 0.5) / SAMPLES as f64
}

/// Bernstein polynomials at the samples.
pub(super) const SEXTICS: [[f64; 7]; SAMPLES] = bernstein_at_samples();
pub(super) const CUBICS: [[f64; 4]; SAMPLES] = bernstein_at_samples();

const fn bernstein_at_samples<const P: usize>() -> [[f64; P]; SAMPLES] {
    let mut values = [[0.0; P]; SAMPLES];
    let mut j = 0;
    while j < SAMPLES {
        values[j] = bernstein(parameter(j));
        j += 1;
    }
    values
}

/// [`legendre_coefficients`] of the high degrees.
pub(super) static LEGENDRE: LazyLock<[[f64; 7]; 2]> =
    LazyLock::new(|| HIGH_DEGREES.map(legendre_coefficients));

/// Weights that turn the Bernstein coefficients of a sextic into its coefficient of degree `l` in
/// the orthonormal Legendre polynomials of [0, 1]:
/// `√(2l+1) Σ_i (-1)^(l+i) C(l,i)² C(6,j) / (C(l+6, i+j) (l+7))`.
fn legendre_coefficients(l: usize) -> [f64; 7] {
    let scale = ((2 * l + 1) as f64).sqrt() / (l + 7) as f64;
    std::array::from_fn(|j| {
        let sum: f64 = (0..=l)
            .map(|i| {
                let sign = if (l + i).is_multiple_of(2) { 1.0 } else { -1.0 };
                sign * binomial(l, i).powi(2) * binomial(6, j) / binomial(l + 6, i + j)
            })
            .sum();
        scale * sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legendre_coefficients_see_only_their_degree() {
        // t^k in Bernstein form of degree 6 has the coefficients C(i, k) / C(6, k)
        let power =
            |k: usize| -> [f64; 7] { std::array::from_fn(|i| binomial(i, k) / binomial(6, k)) };
        let apply = |l: usize, k: usize| -> f64 {
            legendre_coefficients(l).iter().zip(power(k)).map(|(c, b)| c * b).sum()
        };
        for (l, k) in [(5, 0), (5, 3), (5, 4), (6, 0), (6, 4), (6, 5)] {
            assert!(apply(l, k).abs() <= 1e-15, "degree {l} of t^{k}: {:e}", apply(l, k));
        }
        // leading coefficients of the shifted Legendre polynomials: C(2l, l)
        for (l, leading) in [(5, 252.0), (6, 924.0)] {
            let expected = 1.0 / (leading * ((2 * l + 1) as f64).sqrt());
            assert!((apply(l, l) / expected - 1.0).abs() <= 1e-10, "degree {l}");
        }
    }
}
