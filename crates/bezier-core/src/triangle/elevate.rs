//! The same patch with more control points: degree elevation and subdivision.

use super::BezierTriangle;
use crate::barycentric::Barycentric;
use crate::bernstein::binomial;
use crate::coefficient::Coefficient;
use crate::local_edge::Corner;
use crate::multi_index::MultiIndex;

impl<V: Coefficient, const P: usize> BezierTriangle<V, P> {
    /// The same patch with `Q` control points, of a degree at least as high.
    #[must_use]
    pub fn elevate_to<const Q: usize>(&self) -> BezierTriangle<V, Q> {
        let (low, high) = (Self::DEGREE, BezierTriangle::<V, Q>::DEGREE);
        const { assert!(Q >= P, "elevation cannot lower the degree") };
        BezierTriangle::from_fn(|m| {
            MultiIndex::all(low).filter(|s| s.i <= m.i && s.j <= m.j && s.k <= m.k).fold(
                V::ZERO,
                |sum, s| {
                    let weight = binomial(m.i, s.i) * binomial(m.j, s.j) * binomial(m.k, s.k)
                        / binomial(high, low);
                    sum + self[s] * weight
                },
            )
        })
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
}
