//! The patch that three edge curves determine, and derivatives in barycentric parameters.

use bezier_core::{Barycentric, Corner, LocalEdge, PatchJet};
use glam::DVec3;

use crate::edge_curve::EdgeCurve;
use crate::triangle::ends_opposite;

/// `x(b) = Σ P_i b_i - Σ b_j b_k (C_i + W_i (b_j - b_k))`; quadratic if all `W_i` vanish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BasePatch {
    pub(crate) corners: [DVec3; 3],
    /// The curve opposite each corner, counter-clockwise.
    pub(crate) edges: [EdgeCurve; 3],
}

/// A point and its derivatives by `b_0, b_1, b_2` as if these were independent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BarycentricJet {
    pub(crate) point: DVec3,
    pub(crate) first: [DVec3; 3],
    /// Symmetric.
    pub(crate) second: [[DVec3; 3]; 3],
}

impl BarycentricJet {
    /// Derivatives by `(b_0, b_1)` with `b_2 = 1 - b_0 - b_1`.
    pub(crate) fn patch_jet(&self) -> PatchJet {
        let [d0, d1, d2] = self.first;
        let [[h00, h01, h02], [_, h11, h12], [_, _, h22]] = self.second;
        PatchJet {
            point: self.point,
            du: d0 - d2,
            dv: d1 - d2,
            duu: h00 - h02 * 2.0 + h22,
            duv: h01 - h02 - h12 + h22,
            dvv: h11 - h12 * 2.0 + h22,
        }
    }

    /// Adds a second derivative, on both sides of the diagonal.
    pub(crate) fn add_second(&mut self, a: usize, b: usize, value: DVec3) {
        self.second[a][b] += value;
        if a != b {
            self.second[b][a] += value;
        }
    }
}

impl BasePatch {
    /// On an edge the values of [`EdgeCurve::point`] bit for bit.
    #[inline]
    pub(crate) fn point(&self, at: Barycentric) -> DVec3 {
        let b = at.to_array();
        let [p0, p1, p2] = self.corners;
        let bow = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let EdgeCurve { curvature, skew } = self.edges[i];
            (curvature + skew * (b[j] - b[k])) * (b[j] * b[k])
        };
        p0 * b[0] + p1 * b[1] + p2 * b[2] - (bow(0) + bow(1) + bow(2))
    }

    #[inline]
    pub(crate) fn partials(&self, at: Barycentric) -> [DVec3; 3] {
        let b = at.to_array();
        let mut partials = self.corners;
        for corner in Corner::ALL {
            let [j, k] = ends_opposite(corner);
            let EdgeCurve { curvature, skew } = self.edges[corner.index()];
            let bow = curvature + skew * (b[j] - b[k]);
            let twist = skew * (b[j] * b[k]);
            partials[j] -= bow * b[k] + twist;
            partials[k] -= bow * b[j] - twist;
        }
        partials
    }

    pub(crate) fn jet(&self, at: Barycentric) -> BarycentricJet {
        let b = at.to_array();
        let mut jet = BarycentricJet {
            point: self.point(at),
            first: self.partials(at),
            second: [[DVec3::ZERO; 3]; 3],
        };
        for corner in Corner::ALL {
            let [j, k] = ends_opposite(corner);
            let EdgeCurve { curvature, skew } = self.edges[corner.index()];
            jet.add_second(j, k, -(curvature + skew * (2.0 * (b[j] - b[k]))));
            jet.add_second(j, j, skew * (-2.0 * b[k]));
            jet.add_second(k, k, skew * (2.0 * b[j]));
        }
        jet
    }

    /// `P_k - P_j` of the edge opposite a corner.
    #[inline]
    pub(crate) fn chord(&self, corner: Corner) -> DVec3 {
        let [j, k] = ends_opposite(corner);
        self.corners[k] - self.corners[j]
    }

    /// Tangents at both ends of an edge, each pointing into the edge: `T_ij` and `T_ik`.
    #[inline]
    pub(crate) fn end_tangents(&self, edge: LocalEdge) -> [DVec3; 2] {
        let curve = self.edges[edge.apex().index()];
        let [start, end] = curve.end_tangents(self.chord(edge.apex()));
        [start, -end]
    }
}
