//! Rows of the control net along an edge: boundary curve and first inner row.

use super::BezierTriangle;
use crate::coefficient::Coefficient;
use crate::curve::BezierCurve;
use crate::local_edge::LocalEdge;
use crate::multi_index::MultiIndex;

impl<V: Coefficient, const P: usize> BezierTriangle<V, P> {
    /// The boundary curve along `edge`, from its start to its end; `Q` is the degree plus one.
    #[must_use]
    pub fn boundary<const Q: usize>(&self, edge: LocalEdge) -> BezierCurve<V, Q> {
        const { assert!(Q == Self::DEGREE + 1, "a boundary has degree + 1 control points") };
        BezierCurve::new(std::array::from_fn(|i| {
            self[MultiIndex::along(edge, Self::DEGREE - i, i, 0)]
        }))
    }

    /// Replaces the boundary curve along `edge`.
    pub fn set_boundary<const Q: usize>(&mut self, edge: LocalEdge, curve: &BezierCurve<V, Q>) {
        const { assert!(Q == Self::DEGREE + 1, "a boundary has degree + 1 control points") };
        for (i, &point) in curve.points.iter().enumerate() {
            self[MultiIndex::along(edge, Self::DEGREE - i, i, 0)] = point;
        }
    }

    /// The control points next to the boundary along `edge`, from its start to its end; `Q` is the
    /// degree. The first and the last lie on the other two edges; the second and the last but one
    /// are the twist points of the two corners.
    #[must_use]
    pub fn first_inner_row<const Q: usize>(&self, edge: LocalEdge) -> [V; Q] {
        const { assert!(Q == Self::DEGREE, "a first inner row has as many points as the degree") };
        std::array::from_fn(|i| self[MultiIndex::along(edge, Self::DEGREE - 1 - i, i, 1)])
    }

    /// Replaces one point of the first inner row along `edge`.
    pub fn set_first_inner(&mut self, edge: LocalEdge, i: usize, point: V) {
        self[MultiIndex::along(edge, Self::DEGREE - 1 - i, i, 1)] = point;
    }
}
