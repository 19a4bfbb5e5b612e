//! The same patch with more control points: degree elevation and subdivision.

use super::{BezierTriangle, degree_of};
use crate::barycentric::Barycentric;
use crate::bernstein::binomial;
use crate::coefficient::Coefficient;
use crate::local_edge::Corner;
use crate::multi_index::MultiIndex;

/// From `P` to `Q` control points.
struct Elevation<const P: usize, const Q: usize>;

impl<const P: usize, const Q: usize> Elevation<P, Q> {
    /// The weight of each old point, by rank, in each new one.
    const WEIGHTS: [[f64; Q]; P] = {
        let (low, high) = (degree_of(P), degree_of(Q));
        let mut weights = [[0.0; Q]; P];
        let mut old = 0;
        while old < P {
            let s = MultiIndex::at_rank(low, old);
            let mut new = 0;
            while new < Q {
                let m = MultiIndex::at_rank(high, new);
                if s.i <= m.i && s.j <= m.j && s.k <= m.k {
                    weights[old][new] =
                        binomial(m.i, s.i) * binomial(m.j, s.j) * binomial(m.k, s.k)
                            / binomial(high, low);
                }
                new += 1;
            }
            old += 1;
        }
        weights
    };
}

impl<V: Coefficient, const P: usize> BezierTriangle<V, P> {
    /// The same patch with `Q` control points, of a degree at least as high.
    ///
    /// Control point `s` adds to each point `s + d`, `d` an index of the degree that is added, with
    /// the weight `C(m.i, s.i) C(m.j, s.j) C(m.k, s.k) / C(high, low)` of `m = s + d`.
    #[must_use]
    pub fn elevate_to<const Q: usize>(&self) -> BezierTriangle<V, Q> {
        const { assert!(Q >= P, "elevation cannot lower the degree") };
        let added = BezierTriangle::<V, Q>::DEGREE - Self::DEGREE;
        let mut net = [V::ZERO; Q];
        for (rank, s) in MultiIndex::all(Self::DEGREE).enumerate() {
            for row in 0..=added {
                for k in 0..=row {
                    let m = MultiIndex::new(s.i + added - row, s.j + row - k, s.k + k).rank();
                    net[m] = net[m] + self.net[rank] * Elevation::<P, Q>::WEIGHTS[rank][m];
                }
            }
        }
        BezierTriangle { net }
    }

    /// The blossom: the symmetric multi-affine form whose diagonal is the patch.
    ///
    /// `arguments` yields one point per degree.
    ///
    /// # Panics
    ///
    /// If `arguments` yields fewer points than the degree.
    #[must_use]
    pub fn blossom(&self, arguments: impl IntoIterator<Item = Barycentric>) -> V {
        let mut level = self.net;
        let mut arguments = arguments.into_iter();
        for degree in (0..Self::DEGREE).rev() {
            let at = arguments.next().expect("one argument per degree");
            let mut rank = 0;
            for row in 0..=degree {
                for _ in 0..=row {
                    level[rank] = level[rank] * at.u
                        + level[rank + row + 1] * at.v
                        + level[rank + row + 2] * at.w;
                    rank += 1;
                }
            }
        }
        level[0]
    }

    /// The patch over the sub-triangle with these corners, as a patch of the same degree.
    #[must_use]
    pub fn over(&self, corners: [Barycentric; 3]) -> Self {
        Self::from_fn(|m| {
            let repeated =
                |corner: Corner, times| std::iter::repeat_n(corners[corner.index()], times);
            self.blossom(
                repeated(Corner::First, m.i)
                    .chain(repeated(Corner::Second, m.j))
                    .chain(repeated(Corner::Third, m.k)),
            )
        })
    }

    /// The three patches around an inner point, each with the corner of that index replaced by it.
    #[must_use]
    pub fn subdivide_at(&self, at: Barycentric) -> [Self; 3] {
        Corner::ALL.map(|replaced| {
            let mut corners = Corner::ALL.map(Barycentric::at);
            corners[replaced.index()] = at;
            self.over(corners)
        })
    }

    /// The patches on both sides of the line from the first corner to the middle of the opposite edge.
    ///
    /// Their first corner is that middle, so that halving again cuts another edge. Much faster than
    /// [`over`](Self::over).
    #[must_use]
    pub fn halves(&self) -> [Self; 2] {
        let mut work = *self;
        let [mut second, mut third] = [*self; 2];
        // de Casteljau's steps along each row of points, a curve from the second to the third corner
        for i in 0..=Self::DEGREE {
            let degree = Self::DEGREE - i;
            let at = |k| MultiIndex::new(i, degree - k, k);
            for step in 0..=degree {
                if step > 0 {
                    for k in (step..=degree).rev() {
                        work[at(k)] = (work[at(k - 1)] + work[at(k)]) * 0.5;
                    }
                }
                second[MultiIndex::new(step, i, degree - step)] = work[at(step)];
                third[MultiIndex::new(step, degree - step, i)] = work[at(degree)];
            }
        }
        [second, third]
    }
}
