//! Parameters of patches.
//!
//! ```text
//! v                        v
//! 1  2                     1  3 --- 2
//!    | \                      |     |       side s runs from corner s to the next one
//! 0  0 - 1   Triangle      0  0 --- 1   Square
//!    0   1  u                 0     1  u
//! ```

use glam::DVec2;

/// The parameters of a patch: the triangle `u, v ≥ 0, u + v ≤ 1`, or the square `0 ≤ u, v ≤ 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Three corners.
    Triangle,
    /// Four corners.
    Square,
}

impl Domain {
    /// Corners in order.
    #[must_use]
    pub fn corners(self) -> &'static [DVec2] {
        const CORNERS: [[DVec2; 4]; 2] = [
            [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ZERO],
            [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y],
        ];
        match self {
            Self::Triangle => &CORNERS[0][..3],
            Self::Square => &CORNERS[1],
        }
    }

    /// Corners where a side begins and ends.
    pub(crate) fn side(self, side: usize) -> [DVec2; 2] {
        let corners = self.corners();
        [corners[side], corners[(side + 1) % corners.len()]]
    }

    /// A linear function that is zero on a side and grows into the patch: its value and its
    /// derivatives.
    pub(crate) fn inward(self, side: usize, at: DVec2) -> (f64, DVec2) {
        let [start, end] = self.side(side);
        let gradient = (end - start).perp();
        (gradient.dot(at - start), gradient)
    }

    /// The points of a regular lattice, row by row; a row has the same `v`.
    pub(crate) fn lattice(self, divisions: usize) -> impl Iterator<Item = DVec2> {
        let n = divisions;
        let step = 1.0 / n as f64;
        (0..=n).flat_map(move |j| {
            (0..=self.last_of_row(n, j)).map(move |i| DVec2::new(i as f64, j as f64) * step)
        })
    }

    /// The last step of a row of the lattice.
    pub(crate) fn last_of_row(self, divisions: usize, row: usize) -> usize {
        match self {
            Self::Triangle => divisions - row,
            Self::Square => divisions,
        }
    }

    /// Where the lattice point `(i, j)` comes in [`Self::lattice`].
    pub(crate) fn index(self, divisions: usize, i: usize, j: usize) -> usize {
        match self {
            // rows before have divisions + 1, divisions, … points
            Self::Triangle => j * (2 * divisions + 3 - j) / 2 + i,
            Self::Square => j * (divisions + 1) + i,
        }
    }

    /// The lattice point at a step along a side.
    pub(crate) fn along(self, divisions: usize, side: usize, step: usize) -> usize {
        let n = divisions;
        let (i, j) = match (self, side) {
            (_, 0) => (step, 0),
            (Self::Triangle, 1) => (n - step, step),
            (Self::Triangle, _) => (0, n - step),
            (Self::Square, 1) => (n, step),
            (Self::Square, 2) => (n - step, n),
            (Self::Square, _) => (0, n - step),
        };
        self.index(n, i, j)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lattice_points_are_where_their_index_says() {
        for domain in [Domain::Triangle, Domain::Square] {
            let n = 4;
            let points: Vec<_> = domain.lattice(n).collect();
            for side in 0..domain.corners().len() {
                let [start, end] = domain.side(side);
                for step in 0..=n {
                    let expected = start.lerp(end, step as f64 / n as f64);
                    let found = points[domain.along(n, side, step)];
                    assert_eq!(found, expected, "{domain:?}, side {side}, step {step}");
                    let (value, gradient) = domain.inward(side, found);
                    assert_eq!(value, 0.0, "on the side");
                    let centre =
                        domain.corners().iter().sum::<DVec2>() / domain.corners().len() as f64;
                    assert!(gradient.dot(centre - found) > 0.0, "grows inwards");
                }
            }
        }
    }
}
