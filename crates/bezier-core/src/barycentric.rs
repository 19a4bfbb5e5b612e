//! Barycentric coordinates of a triangle.

use crate::local_edge::{Corner, LocalEdge};

/// Parameters `(u, v, w)` of a triangle with `u + v + w = 1`; corners are the unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Barycentric {
    /// Weight of the first corner.
    pub u: f64,
    /// Weight of the second corner.
    pub v: f64,
    /// Weight of the third corner.
    pub w: f64,
}

impl Barycentric {
    /// The centre of the triangle.
    pub const CENTROID: Self = Self { u: 1.0 / 3.0, v: 1.0 / 3.0, w: 1.0 / 3.0 };

    /// The point with the first two coordinates `u` and `v`; the third is `1 - u - v`.
    #[inline]
    #[must_use]
    pub const fn new(u: f64, v: f64) -> Self {
        Self { u, v, w: 1.0 - u - v }
    }

    /// A corner.
    #[must_use]
    pub const fn at(corner: Corner) -> Self {
        let mut weights = [0.0; 3];
        weights[corner.index()] = 1.0;
        Self::from_array(weights)
    }

    /// The point at parameter `t` in [0, 1] along a directed edge.
    #[inline]
    #[must_use]
    pub const fn on_edge(edge: LocalEdge, t: f64) -> Self {
        let mut weights = [0.0; 3];
        weights[edge.start().index()] = 1.0 - t;
        weights[edge.end().index()] = t;
        Self::from_array(weights)
    }

    /// From the three weights, which must add up to one.
    #[inline]
    #[must_use]
    pub const fn from_array([u, v, w]: [f64; 3]) -> Self {
        Self { u, v, w }
    }

    /// The three weights.
    #[inline]
    #[must_use]
    pub const fn to_array(self) -> [f64; 3] {
        [self.u, self.v, self.w]
    }

    /// All points `(i, j, k) / divisions` of the regular lattice, in the order of
    /// [`MultiIndex`](crate::MultiIndex).
    pub fn lattice(divisions: usize) -> impl Iterator<Item = Self> {
        let n = divisions as f64;
        crate::MultiIndex::all(divisions).map(move |m| Self {
            u: m.i as f64 / n,
            v: m.j as f64 / n,
            w: m.k as f64 / n,
        })
    }

    /// The lattice points that are on no edge.
    pub fn inner_lattice(divisions: usize) -> impl Iterator<Item = Self> {
        Self::lattice(divisions).filter(|b| b.u > 0.0 && b.v > 0.0 && b.w > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lattice_counts() {
        assert_eq!(Barycentric::lattice(16).count(), 153);
        assert_eq!(Barycentric::inner_lattice(12).count(), 55);
    }

    #[test]
    fn edges_run_from_corner_to_corner() {
        for edge in LocalEdge::ALL {
            assert_eq!(Barycentric::on_edge(edge, 0.0), Barycentric::at(edge.start()));
            assert_eq!(Barycentric::on_edge(edge, 1.0), Barycentric::at(edge.end()));
        }
    }
}
