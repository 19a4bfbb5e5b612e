//! The point deepest inside half-spaces, by a linear program.

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::NonnegativeConeT;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus};
use glam::DVec3;

/// The points `x` with `normal · x + offset >= 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HalfSpace {
    pub(crate) normal: DVec3,
    pub(crate) offset: f64,
    /// Must hold by a margin, but does not count for how deep a point is.
    pub(crate) hard: bool,
}

/// Least distance from the border of a hard half-space, in the unit of the offsets.
const HARD_MARGIN: f64 = 1e-3;

impl HalfSpace {
    /// The same half-space with a unit normal; `None` if the normal vanishes.
    pub(crate) fn normalized(self) -> Option<Self> {
        let length = self.normal.length();
        let (normal, offset) = (self.normal / length, self.offset / length);
        let hard = self.hard;
        (normal.is_finite() && offset.is_finite()).then_some(Self { normal, offset, hard })
    }
}

/// The point whose least value of `normal · x + offset` is largest, up to `cap`, with coordinates
/// within `±size`; and that value, which is negative if the half-spaces have no point in common. Hard
/// half-spaces only have to hold; `None` if they cannot.
///
/// An interior-point method: where the best point is not unique, it returns one in the middle of
/// them. `None` if the solver fails.
pub(crate) fn deepest_point(spaces: &[HalfSpace], cap: f64, size: f64) -> Option<(DVec3, f64)> {
    // unknowns: x and the slack s; rows: A (x, s) <= b
    let mut rows: Vec<([f64; 4], f64)> = spaces.iter().map(row).collect();
    rows.push(([0.0, 0.0, 0.0, 1.0], cap));
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut row = [0.0; 4];
            row[axis] = sign;
            rows.push((row, size));
        }
    }
    let columns = (0..4).map(|c| rows.iter().map(|(row, _)| row[c]).collect::<Vec<_>>());
    let (count, values): (usize, Vec<f64>) = (rows.len(), columns.flatten().collect());
    let matrix = CscMatrix::new(
        count,
        4,
        (0..=4).map(|c| c * count).collect(),
        (0..4).flat_map(|_| 0..count).collect(),
        values,
    );
    let limits: Vec<f64> = rows.iter().map(|&(_, b)| b).collect();
    let settings = DefaultSettingsBuilder::default().verbose(false).build().ok()?;
    let (cost, quadratic) = ([0.0, 0.0, 0.0, -1.0], CscMatrix::zeros((4, 4)));
    let cones = [NonnegativeConeT(count)];
    let mut solver =
        DefaultSolver::new(&quadratic, &cost, &matrix, &limits, &cones, settings).ok()?;
    solver.solve();
    let usable =
        matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
    let point = DVec3::from_slice(solver.solution.x.get(..3)?);
    // the slack of the point itself, not what the solver believes
    let depth = |h: &HalfSpace| h.normal.dot(point) + h.offset;
    let holds = spaces.iter().filter(|h| h.hard).all(|h| depth(h) > 0.0);
    let slack = spaces.iter().filter(|h| !h.hard).map(depth).fold(cap, f64::min);
    (usable && holds && point.is_finite()).then_some((point, slack))
}

fn row(h: &HalfSpace) -> ([f64; 4], f64) {
    let [x, y, z] = (-h.normal).to_array();
    if h.hard { ([x, y, z, 0.0], h.offset - HARD_MARGIN) } else { ([x, y, z, 1.0], h.offset) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_centre_of_a_cube() {
        let spaces: Vec<_> = [DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .flat_map(|n| [(n, 1.0), (-n, 3.0)])
            .map(|(normal, offset)| HalfSpace { normal, offset, hard: false })
            .collect();
        let (x, slack) = deepest_point(&spaces, 10.0, 100.0).expect("a cube");
        assert!(x.distance(DVec3::ONE) <= 1e-6 && (slack - 2.0).abs() <= 1e-6, "{x} {slack}");
        let (_, slack) = deepest_point(&spaces, 0.5, 100.0).expect("a cube");
        assert!((slack - 0.5).abs() <= 1e-6, "capped: {slack}");
    }

    #[test]
    fn nothing_in_common() {
        let spaces = [(DVec3::X, -1.0), (-DVec3::X, -1.0)].map(|(normal, offset)| HalfSpace {
            normal,
            offset,
            hard: false,
        });
        let (_, slack) = deepest_point(&spaces, 1.0, 10.0).expect("a least bad point");
        assert!((slack + 1.0).abs() <= 1e-6, "{slack}");
        let mut one_hard = spaces;
        one_hard[0].hard = true;
        let (x, slack) = deepest_point(&one_hard, 1.0, 10.0).expect("a point of the hard one");
        assert!(x.x > 1.0 && (slack + 2.0).abs() <= 1e-2, "{x} {slack}");
        one_hard[1].hard = true;
        assert_eq!(deepest_point(&one_hard, 1.0, 10.0), None);
    }
}
