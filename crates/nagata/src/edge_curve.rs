//! The curve of an edge: quadratic, or cubic where a quadratic cannot meet the normals.

use bezier_core::BezierCurve;
use glam::DVec3;

use crate::curvature_parameter::{EdgeNormals, Terms, accepted};
use crate::settings::EdgeSettings;
use crate::singular_terms::singular_terms;

/// The shape of an edge curve, apart from its end points:
///
/// ```text
/// x(u) = P_j (1-u) + P_k u - u (1-u) (C + W (1-2u))
/// ```
///
/// with end tangents `x'(0) = d - C - W` and `x'(1) = d + C - W`. The reversed curve has the same
/// `C` and the opposite `W`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EdgeCurve {
    /// The curvature parameter `C`.
    pub curvature: DVec3,
    /// The cubic part `W`; zero for a quadratic curve.
    pub skew: DVec3,
}

impl EdgeCurve {
    /// The quadratic curve with this curvature parameter.
    #[must_use]
    pub const fn quadratic(curvature: DVec3) -> Self {
        Self { curvature, skew: DVec3::ZERO }
    }

    /// The cubic curve whose end tangents `d - A` and `d + B` differ from the chord `d` as little as
    /// the normals allow; for one normal at each end `A = n_j (n_j·d)`, `B = -n_k (n_k·d)`. \[ours\]
    ///
    /// An end without normals takes the other end's value.
    #[must_use]
    pub fn cubic(chord: DVec3, normals: EdgeNormals<'_>, settings: &EdgeSettings) -> Self {
        let start = end_defect(chord, normals.start, settings);
        let end = end_defect(-chord, normals.end, settings);
        let (a, b) = match (start, end) {
            (Some(a), Some(b)) => (a, b),
            (Some(c), None) | (None, Some(c)) => (c, c),
            (None, None) => (DVec3::ZERO, DVec3::ZERO),
        };
        Self { curvature: (a + b) * 0.5, skew: (a - b) * 0.5 }
    }

    /// Whether this is a quadratic curve.
    #[inline]
    #[must_use]
    pub fn is_quadratic(&self) -> bool {
        self.skew == DVec3::ZERO
    }

    /// The same curve from its other end.
    #[inline]
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { skew: -self.skew, ..self }
    }

    /// The point at parameter `u`, between these end points.
    ///
    /// The reversed curve at `1 - u` is the same point, and the same bits if `u` and `1 - u` add up
    /// to one exactly.
    #[inline]
    #[must_use]
    pub fn point(&self, [start, end]: [DVec3; 2], u: f64) -> DVec3 {
        let w = 1.0 - u;
        let line = start * w + end * u;
        line - (self.curvature + self.skew * (w - u)) * (w * u)
    }

    /// First derivatives at the start and at the end, both in the direction of the curve.
    #[inline]
    #[must_use]
    pub fn end_tangents(&self, chord: DVec3) -> [DVec3; 2] {
        [chord - self.curvature - self.skew, chord + self.curvature - self.skew]
    }

    /// Control points of degree three, between these end points.
    #[must_use]
    pub fn bezier(&self, [start, end]: [DVec3; 2]) -> BezierCurve<DVec3, 4> {
        let [first, last] = self.end_tangents(end - start);
        BezierCurve::new([start, start + first / 3.0, end - last / 3.0, end])
    }
}

/// The shortest vector `A` with `n·A = n·d` for all normals; `None` without normals.
fn end_defect(d: DVec3, normals: &[DVec3], settings: &EdgeSettings) -> Option<DVec3> {
    match normals {
        [] => None,
        [n] => Some(*n * n.dot(d)),
        _ => {
            let rows: Vec<_> = normals.iter().map(|n| (*n, n.dot(d))).collect();
            let terms = singular_terms(&rows, settings.rank);
            Some(accepted(Terms { shear: None, ..terms }, d, settings).value)
        }
    }
}
