//! Step 4: the middle of the first inner rows along each edge [TK09, section 6.4].
//!
//! Rows 0, 1, 6, 7 of the smoothness condition hold by the vertex systems. The alternating sum of
//! all rows is, identically,
//!
//! ```text
//! Σ (-1)^(7-k) row_k = (λ1 - λ0) D6(r - p) - D4(μ) D4(q),
//! ```
//!
//! `Dm` the m-th difference, so `μ2` must make `D4(μ)` vanish together with `λ1 - λ0`:
//! `μ2 = (-μ0 + 4 μ1 + 4 μ3 - μ4) / 6 + (λ1 - λ0) ν / 6`. Rows 2 to 5 are replaced by their
//! neighbouring sums and by the limit of the row that gets lost,
//!
//! ```text
//! row2 + row3,   row3 + row4,   row4 + row5,   D6(r - p) = ν D4(q) .
//! ```
//!
//! This 4×6 system (the same for x, y and z) has condition about 6 for every `λ1 - λ0`, zero
//! included, where the printed system is singular.

use basemesh::{EdgeId, FaceMap, HalfedgeMap, Topology};
use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, SepticTriangle};
use nalgebra::SMatrix;

use crate::faces::local_edge;
use crate::network::CurveNetwork;
use crate::vertex_system::SpokeSolution;
use crate::weights::{EdgeWeights, OriginWeights};

/// Rows of six points `(p2, r2, p3, r3, p4, r4)` or four equations; x, y, z in columns.
type Points = SMatrix<f64, 6, 3>;
type Equations = SMatrix<f64, 4, 3>;

/// Where the curve has no leading coefficient to speak of (relative to its squared chord), `ν` does
/// not act and is set to zero.
const NO_LEADING_TERM: f64 = 1e-10;

/// An edge with everything that is known before its rows are solved for.
#[derive(Clone, Debug)]
pub(crate) struct EdgeSystem {
    /// The boundary quartic along the canonical half-edge.
    pub(crate) curve: QuarticCurve,
    pub(crate) lambda: [f64; 2],
    /// `μ` with `μ2` at `ν = 0`.
    pub(crate) mu_at_zero: [f64; 5],
    /// First inner row of the left patch; points 2, 3, 4 are the initial guess.
    pub(crate) left: [DVec3; 7],
    /// First inner row of the right patch along the same direction.
    pub(crate) right: [DVec3; 7],
}

/// The solved middle of the rows along an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeRows {
    /// Points 2, 3, 4 of the first inner row of the left patch, along the canonical half-edge.
    pub left: [DVec3; 3],
    /// Points 2, 3, 4 of the first inner row of the right patch in the same direction.
    pub right: [DVec3; 3],
    /// The weight functions that prove the smoothness.
    pub weights: EdgeWeights,
}

impl EdgeSystem {
    /// Collects the known quantities of an edge from its two patches, whose twist points are final;
    /// `None` on a boundary.
    pub(crate) fn new(
        topology: &Topology,
        network: &CurveNetwork,
        nets: &FaceMap<SepticTriangle>,
        origin: &HalfedgeMap<Option<OriginWeights>>,
        spokes: &HalfedgeMap<SpokeSolution>,
        edge: EdgeId,
    ) -> Option<Self> {
        let h = topology.canonical(edge);
        let w = topology.twin(h)?;
        let (start, end) = (origin[h]?, origin[w]?);
        let mut right = nets[w.face()].first_inner_row::<7>(local_edge(w));
        right.reverse();
        let [mu0, mu1] = [start.mu0, spokes[h].mu1];
        let [mu4, mu3] = [1.0 - end.mu0, 1.0 - spokes[w].mu1];
        let mu2 = (4.0 * (mu1 + mu3) - (mu0 + mu4)) / 6.0;
        Some(Self {
            curve: network.curves()[edge],
            lambda: [start.lambda0, 1.0 - end.lambda0],
            mu_at_zero: [mu0, mu1, mu2, mu3, mu4],
            left: nets[h.face()].first_inner_row::<7>(local_edge(h)),
            right,
        })
    }

    /// Distance of the ends of the edge.
    pub(crate) fn chord(&self) -> f64 {
        self.curve.points[0].distance(self.curve.points[4])
    }

    fn slope(&self) -> f64 {
        self.lambda[1] - self.lambda[0]
    }

    /// The 4×6 matrix of the equations.
    pub(crate) fn matrix(&self) -> SMatrix<f64, 4, 6> {
        let [l0, l1] = self.lambda;
        let [k0, k1] = [1.0 - l0, 1.0 - l1];
        #[rustfmt::skip]
        let rows = SMatrix::<f64, 4, 6>::from_row_slice(&[
            15.0 * (k0 + k1), 15.0 * (l0 + l1), 20.0 * k0, 20.0 * l0, 0.0, 0.0,
            15.0 * k1, 15.0 * l1, 20.0 * (k0 + k1), 20.0 * (l0 + l1), 15.0 * k0, 15.0 * l0,
            0.0, 0.0, 20.0 * k1, 20.0 * l1, 15.0 * (k0 + k1), 15.0 * (l0 + l1),
            -15.0, 15.0, 20.0, -20.0, -15.0, 15.0,
        ]);
        rows
    }

    /// Right-hand side at `ν = 0` and its derivative in `ν`, relative to the start of the curve.
    pub(crate) fn right_hand_sides(&self) -> [Equations; 2] {
        let [l0, l1] = self.lambda;
        let origin = self.curve.points[0];
        let p = self.left.map(|x| x - origin);
        let r = self.right.map(|x| x - origin);
        let q = self.curve.points.map(|x| x - origin);
        let mix = |l: f64, i: usize| p[i] * (1.0 - l) + r[i] * l;
        // row_k of the right-hand side with the known terms in p1, p5, r1, r5 moved over
        let mut row = self.convolution(&q);
        row[0] -= mix(l1, 1) * 6.0;
        row[3] -= mix(l0, 5) * 6.0;
        let dq: [DVec3; 4] = std::array::from_fn(|i| q[i + 1] - q[i]);
        let slope = self.slope() / 6.0;
        let s: [DVec3; 7] = std::array::from_fn(|i| r[i] - p[i]);
        let constant = [
            row[0] + row[1],
            row[1] + row[2],
            row[2] + row[3],
            s[1] * 6.0 + s[5] * 6.0 - s[0] - s[6],
        ];
        let linear = [
            (dq[0] * 6.0 + dq[1] * 18.0) * slope,
            (dq[1] + dq[2]) * (18.0 * slope),
            (dq[2] * 18.0 + dq[3] * 6.0) * slope,
            QuarticCurve::new(q).top_difference(),
        ];
        [constant, linear].map(|e| Equations::from_fn(|row, axis| e[row][axis]))
    }

    /// Rows 2 to 5 of `(1 - μ) q_b + μ q_t` at `ν = 0`, times `C(7, k)`.
    fn convolution(&self, q: &[DVec3; 5]) -> [DVec3; 4] {
        let full = g1_right_hand_side(q, &self.mu_at_zero);
        std::array::from_fn(|k| full[k + 2])
    }

    /// The initial guess, relative to the start of the curve.
    pub(crate) fn start(&self) -> Points {
        let origin = self.curve.points[0];
        Points::from_fn(|row, axis| {
            let side = if row % 2 == 0 { &self.left } else { &self.right };
            (side[2 + row / 2] - origin)[axis]
        })
    }

    /// Turns unknowns (relative to the start of the curve) and `ν` into a solution.
    pub(crate) fn solution(&self, x: &Points, nu: f64) -> EdgeRows {
        let origin = self.curve.points[0];
        let point = |row: usize| origin + DVec3::new(x[(row, 0)], x[(row, 1)], x[(row, 2)]);
        let mut mu = self.mu_at_zero;
        mu[2] += self.slope() * nu / 6.0;
        EdgeRows {
            left: [point(0), point(2), point(4)],
            right: [point(1), point(3), point(5)],
            weights: EdgeWeights { lambda: self.lambda, mu },
        }
    }

    /// The solution nearest to the initial guess: the objective of the published scheme
    /// [TK09 (24), (25)], continuous through `λ0 = λ1`. `None` if it is not finite.
    pub(crate) fn nearest(&self) -> Option<EdgeRows> {
        let a = self.matrix();
        let [constant, linear] = self.right_hand_sides();
        let x0 = self.start();
        let gram = (a * a.transpose()).cholesky()?;
        let defect = gram.solve(&(constant - a * x0));
        let response = gram.solve(&linear);
        let denominator = linear.dot(&response);
        let nu = if denominator > NO_LEADING_TERM * self.chord().powi(2) {
            -linear.dot(&defect) / denominator
        } else {
            0.0
        };
        let x = x0 + a.transpose() * (defect + response * nu);
        (nu.is_finite() && x.iter().all(|v| v.is_finite())).then(|| self.solution(&x, nu))
    }
}

/// `Σ_i C(4, i) C(3, k - i) ((1 - μ_i) q_{k-i} + μ_i q_{k-i+1})` for `k = 0..=7`: the right-hand
/// sides of [TK09 (3)], each times `C(7, k)`.
pub(crate) fn g1_right_hand_side(q: &[DVec3; 5], mu: &[f64; 5]) -> [DVec3; 8] {
    const QUARTIC: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
    const CUBIC: [f64; 4] = [1.0, 3.0, 3.0, 1.0];
    let mut rows = [DVec3::ZERO; 8];
    for (i, &mu) in mu.iter().enumerate() {
        for j in 0..4 {
            rows[i + j] += (q[j] * (1.0 - mu) + q[j + 1] * mu) * (QUARTIC[i] * CUBIC[j]);
        }
    }
    rows
}
