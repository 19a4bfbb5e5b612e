//! Step 5: the three control points that no smoothness condition touches.

use std::sync::LazyLock;

use basemesh::SurfaceTarget;
use bezier_core::glam::DVec3;
use bezier_core::{MultiIndex, PointMap, SepticTriangle, binomial};
use nalgebra::DMatrix;

use crate::normal_fit::{along_mean_normal, point_to_plane};
use crate::plan::InnerPoints;
use crate::samples::FreePoints;

/// The free control points, by exponents.
const FREE: [MultiIndex; 3] =
    [MultiIndex::new(3, 2, 2), MultiIndex::new(2, 3, 2), MultiIndex::new(2, 2, 3)];
/// Rounds of projecting and fitting.
const ROUNDS: usize = 2;
/// Damping of the fit along the normals.
const DAMPING: f64 = 1e-2;
/// Weight of the part that is not of degree 5 against the part that is not of degree 6.
const DEGREE_FIVE: f64 = 0.1;

/// Chooses the free points of a patch; one whose samples cannot be projected keeps what it has.
pub(crate) fn choose(
    net: &SepticTriangle,
    objective: InnerPoints,
    target: &dyn SurfaceTarget,
) -> SepticTriangle {
    static FIT: LazyLock<FreePoints<36>> = LazyLock::new(|| FreePoints::new(FREE));
    match objective {
        InnerPoints::Keep => *net,
        InnerPoints::PointToPlane => {
            let mut net = *net;
            FIT.fit(&mut net, ROUNDS, target, |columns, feet| {
                point_to_plane(columns, feet, DAMPING)
            });
            net
        }
        InnerPoints::LowDegree => {
            let mut net = low_degree(net);
            FIT.fit(&mut net, ROUNDS, target, along_mean_normal);
            net
        }
    }
}

/// The free points that make the patch as nearly of degree 6, and with less weight of degree 5, as
/// the others allow, in the L2 norm over the triangle.
fn low_degree(net: &SepticTriangle) -> SepticTriangle {
    static FROM_OTHERS: LazyLock<PointMap> = LazyLock::new(|| {
        let weights = low_degree_weights();
        PointMap::new(3, 36, |slot, rank| weights[slot][rank])
    });
    let origin = net.net()[0];
    let combined: [DVec3; 3] = FROM_OTHERS.to_array(&net.net().map(|p| p - origin));
    let mut chosen = *net;
    for (m, relative) in FREE.into_iter().zip(combined) {
        chosen[m] = origin + relative;
    }
    chosen
}

/// The combination of the 33 other points that gives each free point (zero weight on the free
/// ones): the least squares solution of `(R6; 0.1 R5) b = 0`, `R_d` what degree `d` cannot
/// represent.
fn low_degree_weights() -> [[f64; 36]; 3] {
    let (six, five) = (remainder(6), remainder(5) * DEGREE_FIVE);
    let row = |i: usize, j: usize| if i < 36 { six[(i, j)] } else { five[(i - 36, j)] };
    let free = FREE.map(MultiIndex::rank);
    let inner = DMatrix::from_fn(72, 3, |i, j| row(i, free[j])).qr();
    let known = DMatrix::from_fn(72, 36, |i, j| if free.contains(&j) { 0.0 } else { -row(i, j) });
    let weights = inner
        .r()
        .solve_upper_triangular(&(inner.q().transpose() * known))
        .expect("invariant: the free points leave a remainder");
    std::array::from_fn(|i| std::array::from_fn(|j| weights[(i, j)]))
}

/// A square root of the quadratic form "squared L2 distance of a degree-7 polynomial to degree `d`":
/// `(I - P) Lᵀ` with `L Lᵀ` the Gram matrix of the Bernstein basis and `P` the projector onto the
/// image of elevation from `d`.
fn remainder(d: usize) -> DMatrix<f64> {
    let high: Vec<MultiIndex> = MultiIndex::all(7).collect();
    let low: Vec<MultiIndex> = MultiIndex::all(d).collect();
    // up to a common factor
    let gram = DMatrix::from_fn(36, 36, |a, b| {
        let (m, n) = (high[a], high[b]);
        binomial(m.i + n.i, m.i) * binomial(m.j + n.j, m.j) * binomial(m.k + n.k, m.k)
            / binomial(14, 7)
    });
    let elevation = DMatrix::from_fn(36, low.len(), |a, b| {
        let (m, s) = (high[a], low[b]);
        if s.i > m.i || s.j > m.j || s.k > m.k {
            return 0.0;
        }
        binomial(m.i, s.i) * binomial(m.j, s.j) * binomial(m.k, s.k) / binomial(7, d)
    });
    let root =
        gram.cholesky().expect("invariant: a Gram matrix is positive definite").l().transpose();
    let image = (&root * &elevation).qr().q();
    &root - &image * (image.transpose() * &root)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values printed by an independent implementation for the point (3, 2, 2).
    #[test]
    fn low_degree_weights_agree() {
        let [row, ..] = low_degree_weights();
        let weight = |i, j, k| row[MultiIndex::new(i, j, k).rank()];
        for (got, expected) in [
            (weight(7, 0, 0), -0.040_999),
            (weight(5, 1, 1), -0.465_461),
            (weight(4, 2, 1), 0.370_520),
            (weight(4, 1, 2), 0.370_520),
            (weight(1, 4, 2), 0.068_182),
            (weight(2, 4, 1), -0.052_093),
            (weight(0, 7, 0), -0.032_416),
            (weight(0, 0, 7), -0.032_416),
        ] {
            assert!((got - expected).abs() <= 0.5e-6, "{got} for {expected}");
        }
        assert!((row.iter().sum::<f64>() - 1.0).abs() <= 1e-12, "affine combination");
    }

    #[test]
    fn degree_five_is_reproduced() {
        let quintic = bezier_core::QuinticTriangle::from_fn(|m| {
            DVec3::new((m.i * m.j) as f64, (m.j * m.k) as f64, (m.i + 2 * m.k * m.k) as f64)
        });
        let elevated = quintic.elevate_to::<36>();
        let mut disturbed = elevated;
        FREE.into_iter().for_each(|m| disturbed[m] += DVec3::new(1.0, -2.0, 3.0));
        for m in FREE {
            let distance = low_degree(&disturbed)[m].distance(elevated[m]);
            assert!(distance <= 1e-12 * elevated[m].length(), "{distance:e}");
        }
    }
}
