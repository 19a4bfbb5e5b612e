//! The numbering of the control points of a triangle.
//!
//! Control point `(i, j, k)` carries the exponents of the barycentric coordinates `u`, `v`, `w`.
//! There is one order in this workspace; degree 3 and the first rows of degree 7:
//!
//! ```text
//!             300                    0              700                        0
//!          210   201               1   2         610   601                   1   2
//!       120   111   102          3   4   5     520   511   502             3   4   5
//!    030   021   012   003      6   7   8   9         ...                     ...
//!                                              070 061 ... 016 007        28 29 ... 34 35
//! ```
//!
//! With row `r = j + k`, the rank is `r (r + 1) / 2 + k`. It does not contain the degree: the
//! neighbourhood of the first corner has the same ranks in a cubic and in a septic net.

use crate::local_edge::LocalEdge;

/// Exponents `(i, j, k)` of a Bernstein polynomial over a triangle; their sum is the degree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MultiIndex {
    /// Exponent of `u`.
    pub i: usize,
    /// Exponent of `v`.
    pub j: usize,
    /// Exponent of `w`.
    pub k: usize,
}

impl MultiIndex {
    /// The index with these exponents.
    #[inline]
    #[must_use]
    pub const fn new(i: usize, j: usize, k: usize) -> Self {
        Self { i, j, k }
    }

    /// Number of indices of this degree: `(degree + 1) (degree + 2) / 2`.
    #[inline]
    #[must_use]
    pub const fn count(degree: usize) -> usize {
        (degree + 1) * (degree + 2) / 2
    }

    /// Sum of the exponents.
    #[inline]
    #[must_use]
    pub const fn degree(self) -> usize {
        self.i + self.j + self.k
    }

    /// Position in the net; see the drawing above.
    #[inline]
    #[must_use]
    pub const fn rank(self) -> usize {
        let row = self.j + self.k;
        row * (row + 1) / 2 + self.k
    }

    /// The index of this degree with this rank.
    ///
    /// # Panics
    ///
    /// If there is none.
    #[must_use]
    pub const fn at_rank(degree: usize, rank: usize) -> Self {
        assert!(rank < Self::count(degree), "rank out of range for this degree");
        let mut row = 0;
        while (row + 1) * (row + 2) / 2 <= rank {
            row += 1;
        }
        let k = rank - row * (row + 1) / 2;
        Self { i: degree - row, j: row - k, k }
    }

    /// All indices of this degree, by rank.
    pub fn all(degree: usize) -> impl Iterator<Item = Self> {
        (0..=degree)
            .flat_map(move |row| (0..=row).map(move |k| Self::new(degree - row, row - k, k)))
    }

    /// The index with these exponents at the start, the end and the apex of an edge.
    #[inline]
    #[must_use]
    pub const fn along(edge: LocalEdge, start: usize, end: usize, apex: usize) -> Self {
        let mut exponents = [0; 3];
        exponents[edge.start().index()] = start;
        exponents[edge.end().index()] = end;
        exponents[edge.apex().index()] = apex;
        let [i, j, k] = exponents;
        Self { i, j, k }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_drawing() {
        let ranks = |indices: &[(usize, usize, usize)]| -> Vec<usize> {
            indices.iter().map(|&(i, j, k)| MultiIndex::new(i, j, k).rank()).collect()
        };
        assert_eq!(
            ranks(&[(3, 0, 0), (2, 1, 0), (2, 0, 1), (1, 1, 1), (0, 0, 3)]),
            [0, 1, 2, 4, 9]
        );
        assert_eq!(ranks(&[(7, 0, 0), (6, 0, 1), (0, 7, 0), (0, 0, 7)]), [0, 2, 28, 35]);
    }

    #[test]
    fn rank_and_back() {
        for degree in 0..9 {
            let all: Vec<_> = MultiIndex::all(degree).collect();
            assert_eq!(all.len(), MultiIndex::count(degree));
            for (rank, m) in all.into_iter().enumerate() {
                assert_eq!(m.rank(), rank);
                assert_eq!(MultiIndex::at_rank(degree, rank), m);
                assert_eq!(m.degree(), degree);
            }
        }
    }
}
