//! Bézier triangles: storage and indexing.

mod elevate;
mod eval;
mod rows;

use std::ops::{Index, IndexMut};

use glam::DVec3;

use crate::coefficient::Coefficient;
use crate::local_edge::Corner;
use crate::multi_index::MultiIndex;
pub(crate) use eval::MAX_DEGREE;

/// A polynomial patch (or function) over a triangle in Bernstein form, with `P` control points.
///
/// `P` must be a triangular number; the degree follows from it. Control points are ordered by
/// [`MultiIndex::rank`]. Corners are counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct BezierTriangle<V, const P: usize> {
    net: [V; P],
}

/// Degree 1.
pub type LinearTriangle<V = DVec3> = BezierTriangle<V, 3>;
/// Degree 2.
pub type QuadraticTriangle<V = DVec3> = BezierTriangle<V, 6>;
/// Degree 3.
pub type CubicTriangle<V = DVec3> = BezierTriangle<V, 10>;
/// Degree 4.
pub type QuarticTriangle<V = DVec3> = BezierTriangle<V, 15>;
/// Degree 5.
pub type QuinticTriangle<V = DVec3> = BezierTriangle<V, 21>;
/// Degree 7: the patches of the G1 spline.
pub type SepticTriangle<V = DVec3> = BezierTriangle<V, 36>;

const fn degree_of(points: usize) -> usize {
    let mut degree = 0;
    while MultiIndex::count(degree) < points {
        degree += 1;
    }
    degree
}

impl<V: Coefficient, const P: usize> BezierTriangle<V, P> {
    /// Polynomial degree.
    pub const DEGREE: usize = {
        let degree = degree_of(P);
        assert!(MultiIndex::count(degree) == P, "the number of control points is not triangular");
        degree
    };

    /// A patch from its control points, ordered by [`MultiIndex::rank`].
    #[must_use]
    pub const fn new(net: [V; P]) -> Self {
        Self { net }
    }

    /// A patch from a control point for each index.
    #[must_use]
    pub fn from_fn(mut f: impl FnMut(MultiIndex) -> V) -> Self {
        Self { net: std::array::from_fn(|rank| f(MultiIndex::at_rank(Self::DEGREE, rank))) }
    }

    /// The same patch with `corner` as its first corner.
    #[must_use]
    pub fn starting_at(&self, corner: Corner) -> Self {
        Self { net: Self::TURNED[corner.index()].map(|rank| self.net[rank]) }
    }

    /// The old ranks of the control points of a patch that starts at each corner.
    const TURNED: [[usize; P]; 3] = {
        let mut turned = [[0; P]; 3];
        let mut rank = 0;
        while rank < P {
            let MultiIndex { i, j, k } = MultiIndex::at_rank(Self::DEGREE, rank);
            turned[Corner::First.index()][rank] = rank;
            turned[Corner::Second.index()][rank] = MultiIndex::new(k, i, j).rank();
            turned[Corner::Third.index()][rank] = MultiIndex::new(j, k, i).rank();
            rank += 1;
        }
        turned
    };

    /// Control points by rank.
    #[inline]
    #[must_use]
    pub const fn net(&self) -> &[V; P] {
        &self.net
    }

    /// Control points by rank, to change.
    #[inline]
    pub const fn net_mut(&mut self) -> &mut [V; P] {
        &mut self.net
    }

    /// Indices and control points by rank.
    pub fn iter(&self) -> impl Iterator<Item = (MultiIndex, V)> {
        MultiIndex::all(Self::DEGREE).zip(self.net)
    }
}

impl<V: Coefficient, const P: usize> Index<MultiIndex> for BezierTriangle<V, P> {
    type Output = V;

    #[inline]
    fn index(&self, m: MultiIndex) -> &V {
        debug_assert_eq!(m.degree(), Self::DEGREE, "index of another degree");
        &self.net[m.rank()]
    }
}

impl<V: Coefficient, const P: usize> IndexMut<MultiIndex> for BezierTriangle<V, P> {
    #[inline]
    fn index_mut(&mut self, m: MultiIndex) -> &mut V {
        debug_assert_eq!(m.degree(), Self::DEGREE, "index of another degree");
        &mut self.net[m.rank()]
    }
}

impl<const P: usize> From<[[f64; 3]; P]> for BezierTriangle<DVec3, P> {
    fn from(points: [[f64; 3]; P]) -> Self {
        Self { net: points.map(DVec3::from_array) }
    }
}

impl<const P: usize> From<BezierTriangle<DVec3, P>> for [[f64; 3]; P] {
    fn from(patch: BezierTriangle<DVec3, P>) -> Self {
        patch.net.map(|p| p.to_array())
    }
}
