//! How two patches meet along an edge.

use glam::DVec3;

use crate::barycentric::Barycentric;
use crate::bernstein::binomial;
use crate::local_edge::LocalEdge;
use crate::triangle::BezierTriangle;

/// Two patches seen from their common edge.
///
/// The edge runs counter-clockwise in the left patch, and backwards in the right one.
#[derive(Clone, Copy, Debug)]
pub struct Seam<'a, const P: usize> {
    /// Patch on the left.
    pub left: &'a BezierTriangle<DVec3, P>,
    /// The common edge in the left patch.
    pub left_edge: LocalEdge,
    /// Patch on the right.
    pub right: &'a BezierTriangle<DVec3, P>,
    /// The common edge in the right patch.
    pub right_edge: LocalEdge,
}

impl<const P: usize> Seam<'_, P> {
    /// Largest distance of corresponding boundary control points: zero if and only if the patches
    /// join without a gap. Unit: length.
    #[must_use]
    pub fn position_gap<const Q: usize>(&self) -> f64 {
        let left = self.left.boundary::<Q>(self.left_edge);
        let right = self.right.boundary::<Q>(self.right_edge).reversed();
        left.points.iter().zip(&right.points).map(|(l, r)| l.distance(*r)).fold(0.0, f64::max)
    }

    /// Angle in radians between the two patch normals at parameter `t` of the edge; `None` where
    /// a patch has no normal.
    #[must_use]
    pub fn normal_angle(&self, t: f64) -> Option<f64> {
        let normal = |patch: &BezierTriangle<DVec3, P>, at| {
            patch.point_and_area_normal(at).1.try_normalize()
        };
        let l = normal(self.left, Barycentric::on_edge(self.left_edge, t))?;
        let r = normal(self.right, Barycentric::on_edge(self.right_edge, 1.0 - t))?;
        Some(l.cross(r).length().atan2(l.dot(r)))
    }

    /// Largest [`normal_angle`](Self::normal_angle) over `samples` equidistant parameters, ends
    /// included; `None` if one of them has no normal.
    #[must_use]
    pub fn max_normal_angle(&self, samples: usize) -> Option<f64> {
        let last = samples.saturating_sub(1).max(1) as f64;
        (0..samples).try_fold(0.0_f64, |max, i| Some(max.max(self.normal_angle(i as f64 / last)?)))
    }

    /// Polynomial residual of the G1 condition, without weight functions: the largest Bernstein
    /// coefficient of `det(q', l, r) / L³`, where `q'` is the derivative along the edge, `l` and
    /// `r` the derivatives into the two patches and `L` the distance of the ends.
    ///
    /// The determinant vanishes identically if and only if the tangent planes agree along the
    /// whole edge; its coefficients bound it there. `Q` is the degree.
    #[must_use]
    pub fn coplanarity_residual<const Q: usize>(&self) -> f64 {
        let degree = Q as f64;
        let along = |edge: LocalEdge, patch: &BezierTriangle<DVec3, P>| {
            let row = patch.first_inner_row::<Q>(edge);
            let start: [DVec3; Q] =
                std::array::from_fn(|i| patch[crate::MultiIndex::along(edge, Q - i, i, 0)]);
            let end: [DVec3; Q] =
                std::array::from_fn(|i| patch[crate::MultiIndex::along(edge, Q - 1 - i, i + 1, 0)]);
            (start, end, row)
        };
        let (start, end, inner) = along(self.left_edge, self.left);
        let (mut right_end, _, mut right_inner) = along(self.right_edge, self.right);
        right_end.reverse();
        right_inner.reverse();
        let tangent: [DVec3; Q] = std::array::from_fn(|i| (end[i] - start[i]) * degree);
        let left: [DVec3; Q] = std::array::from_fn(|i| (inner[i] - start[i]) * degree);
        // the reversed rows of the right patch lie one step further along the edge
        let right: [DVec3; Q] = std::array::from_fn(|i| (right_inner[i] - right_end[i]) * degree);
        let length = start[0].distance(end[Q - 1]);
        determinant_bound(&tangent, &left, &right) / length.powi(3)
    }
}

/// Largest Bernstein coefficient, in absolute value, of the determinant of three vector polynomials
/// given by their Bernstein coefficients.
fn determinant_bound<const Q: usize>(a: &[DVec3; Q], b: &[DVec3; Q], c: &[DVec3; Q]) -> f64 {
    let low = Q - 1;
    let mut coefficients = vec![0.0; 3 * low + 1];
    for (i, ai) in a.iter().enumerate() {
        for (j, bj) in b.iter().enumerate() {
            let cross = ai.cross(*bj) * (binomial(low, i) * binomial(low, j));
            for (k, ck) in c.iter().enumerate() {
                coefficients[i + j + k] += cross.dot(*ck) * binomial(low, k);
            }
        }
    }
    coefficients
        .iter()
        .enumerate()
        .map(|(m, value)| value.abs() / binomial(3 * low, m))
        .fold(0.0, f64::max)
}
