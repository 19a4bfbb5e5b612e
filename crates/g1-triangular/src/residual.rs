//! How exactly the smoothness condition holds.

use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, binomial};

use crate::edge_system::g1_right_hand_side;
use crate::weights::EdgeWeights;

/// The Bernstein coefficients of `(1 - λ) p + λ r - (1 - μ) q_b - μ q_t`, degree 7, divided by the
/// chord of the boundary curve: identically zero if and only if [TK09 (3)] holds.
///
/// `left` and `right` are the first inner rows of the two patches in the direction of `curve`.
#[must_use]
pub fn g1_residual(
    curve: &QuarticCurve,
    left: &[DVec3; 7],
    right: &[DVec3; 7],
    weights: &EdgeWeights,
) -> [DVec3; 8] {
    // relative to the start, so that a surface far from the origin loses no digits
    let origin = curve.points[0];
    let chord = origin.distance(curve.points[4]);
    let rhs = g1_right_hand_side(&curve.points.map(|q| q - origin), &weights.mu);
    let mut rows = rhs.map(|row| -row);
    for (j, (&l, &r)) in left.iter().zip(right).enumerate() {
        for (i, &lambda) in weights.lambda.iter().enumerate() {
            let blend = (l - origin) * (1.0 - lambda) + (r - origin) * lambda;
            rows[i + j] += blend * binomial(6, j);
        }
    }
    std::array::from_fn(|k| rows[k] / (binomial(7, k) * chord))
}
