//! Curves drawn towards the surface itself, instead of towards samples at fixed parameters.
//!
//! The quartic of [`solve`](crate::solve) fits points that belong to fixed parameters, so part of
//! its freedom is spent on the parametrisation. Here the distance along the surface's normals is
//! minimised under the same curvature conditions, by Levenberg–Marquardt steps in the null space of
//! the conditions. A weight on tangential motion keeps the step determined; it is proportional to
//! `θ²`, `θ` the turning of the normals along the edge, because the free parameters of a curve with
//! given end curvatures influence its normal distance only through terms of that order.

use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, Turning, bernstein, damped_least_squares};

use crate::free_tangents::{FreeTangents, norm};
use crate::gradients::{NullSpace, Vector};
use crate::problem::EdgeProblem;
use crate::settings::{CurveRefinement, Settings};

/// Samples of the curve, at `j / 10`.
const SAMPLES: usize = 9;
/// Rounds of each of two stages, and of a single one.
const ROUNDS: usize = 4;
const SINGLE_STAGE_ROUNDS: usize = 6;
/// Weight of tangential motion over `θ²`: at the start, and its lower limit.
const TANGENTIAL: f64 = 0.005;
const TANGENTIAL_FLOOR: f64 = 1e-4;
/// Weight that determines a step where nothing else does (a straight edge).
const FLOOR: f64 = 1e-9;
/// Newton steps back onto the curvature conditions after a step, and what a result must satisfy.
const CORRECTIONS: usize = 6;
const CONDITIONS_MET: f64 = 1e-12;
/// Longest end tangent, and largest sideways part of it as a fraction of its length.
const MAX_LENGTH: f64 = 0.42;
const MAX_SIDEWAYS: f64 = 0.2;
/// Smallest turning that counts, in radians: flatter edges are treated as turning by this angle.
const MIN_TURNING: f64 = 1e-3;

/// Directions of motion that keep the conditions: seven unknowns less two conditions; the last two
/// turn the end tangents.
const DIRECTIONS: usize = 5;
const TURNING: usize = 2;
/// Samples with one that counts for nothing, because vector instructions take them in pairs.
const LANES: usize = SAMPLES + 1;
/// Equations of a step: the motions of all samples along the normal and along two tangents.
const EQUATIONS: usize = 3 * LANES;

/// One number for each sample.
type Lanes = [f64; LANES];

/// Bernstein polynomials of degree 4 at the samples, zero at the one that does not count.
static BASIS: [Lanes; 5] = {
    let mut basis = [[0.0; LANES]; 5];
    let mut j = 0;
    while j < SAMPLES {
        let values = bernstein::<5>(parameter(j));
        let mut i = 0;
        while i < 5 {
            basis[i][j] = values[i];
            i += 1;
        }
        j += 1;
    }
    basis
};

/// Most points for which [`refine`] asks feet at a time.
pub const MOST_FEET: usize = SAMPLES;

/// A surface point near a curve point, with the unit normal there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveFoot {
    /// The point.
    pub point: DVec3,
    /// The unit normal.
    pub normal: DVec3,
}

/// Sets each foot to a surface point near the point of the same index and the unit normal there, and
/// says whether all were found.
pub type FindFeet<'a> = dyn Fn(&[DVec3], &mut [CurveFoot]) -> bool + 'a;

/// What refinement did to one curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refined {
    /// The curve, never farther from the surface than the given one.
    pub curve: QuarticCurve,
    /// Accepted steps; zero if the given curve was kept.
    pub accepted: usize,
}

/// Moves `start`, a curve of [`solve`](crate::solve) for the same problem, towards the surface.
///
/// `find_feet` is asked for at most [`MOST_FEET`] feet at a time. A step is accepted only if the
/// root mean square of the normal distances at nine parameters falls, the conditions hold and the
/// end tangents keep sensible lengths. Where a foot is missing the curve is kept.
pub fn refine(
    problem: &EdgeProblem,
    start: &QuarticCurve,
    refinement: CurveRefinement,
    settings: &Settings,
    find_feet: &FindFeet<'_>,
) -> Refined {
    let kept = Refined { curve: *start, accepted: 0 };
    let run = Run { problem, settings, find_feet };
    if refinement == CurveRefinement::None {
        return kept;
    }
    let Some(theta) = run.turning(start) else { return kept };
    let Some(mut state) = run.state(FreeTangents::of(problem, start)) else { return kept };
    const FIXED: usize = DIRECTIONS - TURNING;
    let accepted = match refinement {
        CurveRefinement::None => 0,
        CurveRefinement::TangentFixed => run.stage::<FIXED>(&mut state, SINGLE_STAGE_ROUNDS, theta),
        // started cold, the free tangents stick in bad minima
        CurveRefinement::TangentFree => {
            run.stage::<FIXED>(&mut state, ROUNDS, theta)
                + run.stage::<DIRECTIONS>(&mut state, ROUNDS, theta)
        }
    };
    if accepted == 0 { kept } else { Refined { curve: state.x.curve(problem), accepted } }
}

/// A candidate and how far it is from the surface.
struct State {
    x: FreeTangents,
    /// Distance along the normal in chord lengths.
    distances: Lanes,
    normals: [DVec3; SAMPLES],
    square_distance: f64,
}

impl State {
    /// Coordinates of the normals and of two tangents at each sample.
    fn axes(&self) -> [[Lanes; 3]; 3] {
        let mut axes = [[[0.0; LANES]; 3]; 3];
        for (j, normal) in self.normals.iter().enumerate() {
            let (u, v) = normal.any_orthonormal_pair();
            for (axis, vector) in axes.iter_mut().zip([*normal, u, v]) {
                for (i, lanes) in axis.iter_mut().enumerate() {
                    lanes[j] = vector[i];
                }
            }
        }
        axes
    }
}

/// How the samples move along directions that keep the conditions.
struct Motions<const D: usize> {
    directions: [Vector; D],
    /// For each direction the motions along the normals and along two tangents.
    columns: [[f64; EQUATIONS]; D],
}

impl<const D: usize> Motions<D> {
    fn new(problem: &EdgeProblem, state: &State) -> Self {
        let sideways = D == DIRECTIONS;
        let null_space = NullSpace::of(&state.x.condition_gradients(problem, sideways));
        let directions = std::array::from_fn(|d| null_space.direction(d));
        let axes = state.axes();
        let mut columns = [[0.0; EQUATIONS]; D];
        for (column, direction) in columns.iter_mut().zip(&directions) {
            let motion = motion(problem, direction);
            for (axis, along_axis) in axes.iter().zip(column.chunks_exact_mut(LANES)) {
                project(&motion, axis, along_axis);
            }
        }
        Self { directions, columns }
    }
}

struct Run<'a> {
    problem: &'a EdgeProblem,
    settings: &'a Settings,
    find_feet: &'a FindFeet<'a>,
}

impl Run<'_> {
    /// Turning of the normals along a curve, in radians.
    fn turning(&self, curve: &QuarticCurve) -> Option<f64> {
        let [start, end] = [0, 1].map(|i| self.problem.ends[i].normal);
        let [a, b, c] = self.feet(&[0.25, 0.5, 0.75].map(|t| curve.eval(t)))?;
        let normals = [start, a.normal, b.normal, c.normal, end];
        Some(Turning::of(&normals)?.angle.max(MIN_TURNING))
    }

    /// Feet of some points; `None` if one is missing.
    fn feet<const COUNT: usize>(&self, points: &[DVec3; COUNT]) -> Option<[CurveFoot; COUNT]> {
        let mut feet = [CurveFoot { point: DVec3::ZERO, normal: DVec3::ZERO }; COUNT];
        (self.find_feet)(points, &mut feet).then_some(feet)
    }

    fn state(&self, x: FreeTangents) -> Option<State> {
        let points = points(&x.curve(self.problem));
        let feet = self.feet(&points)?;
        let mut state = State {
            x,
            distances: [0.0; LANES],
            normals: feet.map(|foot| foot.normal),
            square_distance: 0.0,
        };
        for (j, (point, foot)) in points.iter().zip(&feet).enumerate() {
            let distance = (point - foot.point).dot(foot.normal) / self.problem.chord;
            state.distances[j] = distance;
            state.square_distance += distance * distance;
        }
        state.square_distance.is_finite().then_some(state)
    }

    /// Rounds of steps along the first `D` directions; returns how many were accepted.
    fn stage<const D: usize>(&self, state: &mut State, rounds: usize, theta: f64) -> usize {
        let mut accepted = 0;
        let mut weight = TANGENTIAL * theta * theta;
        let mut motions = None;
        for _ in 0..rounds {
            let motions_here =
                motions.get_or_insert_with(|| Motions::<D>::new(self.problem, state));
            let next = self.step(state, motions_here, weight);
            if let Some(next) = next.filter(|next| self.accepts(state, next)) {
                *state = next;
                motions = None;
                accepted += 1;
                weight = (0.5 * weight).max(TANGENTIAL_FLOOR * theta * theta);
            } else {
                weight *= 10.0;
            }
        }
        accepted
    }

    /// One step along directions that keep the conditions, then back onto the conditions.
    fn step<const D: usize>(
        &self,
        state: &State,
        motions: &Motions<D>,
        tangential: f64,
    ) -> Option<State> {
        let mut columns = motions.columns;
        for column in &mut columns {
            column[LANES..].iter_mut().for_each(|entry| *entry *= tangential);
        }
        let mut rhs = [0.0; EQUATIONS];
        for (rhs, distance) in rhs.iter_mut().zip(state.distances) {
            *rhs = -distance;
        }
        let coordinates = damped_least_squares(&mut columns, &mut rhs, &[FLOOR; D])?;
        let step = |x, (direction, c): (&Vector, f64)| x + direction * c;
        let moved = FreeTangents(motions.directions.iter().zip(coordinates).fold(state.x.0, step));
        self.state(moved.towards_conditions(self.problem, D == DIRECTIONS, CORRECTIONS))
    }

    fn accepts(&self, before: &State, after: &State) -> bool {
        let sensible = |i: usize| {
            let (length, sideways) = after.x.end_tangent(i);
            length > self.settings.min_length
                && length < MAX_LENGTH
                && sideways.abs() < MAX_SIDEWAYS * length
        };
        after.square_distance < before.square_distance
            && sensible(0)
            && sensible(1)
            && norm(after.x.conditions(self.problem)) < CONDITIONS_MET
    }
}

const fn parameter(j: usize) -> f64 {
    (j + 1) as f64 / (SAMPLES + 1) as f64
}

/// The samples of a curve.
fn points(curve: &QuarticCurve) -> [DVec3; SAMPLES] {
    let [q0, .., q4] = curve.points;
    std::array::from_fn(|j| {
        let inner = (1..4).map(|i| curve.points[i] * BASIS[i][j]);
        inner.fold(q0 * BASIS[0][j] + q4 * BASIS[4][j], |sum, term| sum + term)
    })
}

/// Motion of the samples when the unknowns move in a direction.
fn motion(problem: &EdgeProblem, direction: &Vector) -> [Lanes; 3] {
    let step = FreeTangents(*direction);
    let [a, b] = [0, 1].map(|i| step.tangent(problem, i));
    let middle = step.middle();
    let mut motion = [[0.0; LANES]; 3];
    for (i, lanes) in motion.iter_mut().enumerate() {
        for (j, lane) in lanes.iter_mut().enumerate() {
            *lane = BASIS[1][j] * a[i] + BASIS[2][j] * middle[i] + BASIS[3][j] * b[i];
        }
    }
    motion
}

/// The components of the motions along an axis.
fn project(motion: &[Lanes; 3], axis: &[Lanes; 3], out: &mut [f64]) {
    let [[mx, my, mz], [ax, ay, az]] = [motion, axis];
    for (j, out) in out.iter_mut().enumerate() {
        *out = mx[j] * ax[j] + my[j] * ay[j] + mz[j] * az[j];
    }
}
