//! Curves drawn towards the surface itself, instead of towards samples at fixed parameters.
//!
//! The quartic of [`solve`](crate::solve) fits points that belong to fixed parameters, so part of
//! its freedom is spent on the parametrisation. Here the distance along the surface's normals is
//! minimised under the same curvature conditions, by Levenberg–Marquardt steps in the null space of
//! the conditions. A weight on tangential motion keeps the step determined; it is proportional to
//! `θ²`, `θ` the turning of the normals along the edge, because the free parameters of a curve with
//! given end curvatures influence its normal distance only through terms of that order.

use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, Turning};
use nalgebra::{SMatrix, SVector};

use crate::frame::Frame;
use crate::free_tangents::{self, FreeTangents};
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

/// Directions of motion that keep the conditions: seven unknowns less two conditions.
const DIRECTIONS: usize = 5;
/// Equations of a step: three for each sample and one for each direction.
const EQUATIONS: usize = 3 * SAMPLES + DIRECTIONS;

/// A surface point near a curve point, with the unit normal there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveFoot {
    /// The point.
    pub point: DVec3,
    /// The unit normal.
    pub normal: DVec3,
}

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
/// `foot` returns a surface point near a point and the unit normal there. A step is accepted only
/// if the root mean square of the normal distances at nine parameters falls, the conditions hold
/// and the end tangents keep sensible lengths. Where a foot is missing the curve is kept.
pub fn refine(
    problem: &EdgeProblem,
    start: &QuarticCurve,
    refinement: CurveRefinement,
    settings: &Settings,
    foot: &dyn Fn(DVec3) -> Option<CurveFoot>,
) -> Refined {
    // (directions of motion, rounds); started cold, the free tangents stick in bad minima
    let stages: &[(usize, usize)] = match refinement {
        CurveRefinement::None => &[],
        CurveRefinement::TangentFixed => &[(DIRECTIONS - 2, SINGLE_STAGE_ROUNDS)],
        CurveRefinement::TangentFree => &[(DIRECTIONS - 2, ROUNDS), (DIRECTIONS, ROUNDS)],
    };
    let kept = Refined { curve: *start, accepted: 0 };
    let run = Run { problem, settings, foot };
    let Some(theta) = run.turning(start) else { return kept };
    let Some(mut state) = run.state(FreeTangents::of(problem, start)) else { return kept };
    let mut accepted = 0;
    for &(directions, rounds) in stages {
        let mut weight = TANGENTIAL * theta * theta;
        for _ in 0..rounds {
            let next = run.step(&state, directions, weight);
            if let Some(next) = next.filter(|next| run.accepts(&state, next)) {
                state = next;
                accepted += 1;
                weight = (0.5 * weight).max(TANGENTIAL_FLOOR * theta * theta);
            } else {
                weight *= 10.0;
            }
        }
    }
    if accepted == 0 { kept } else { Refined { curve: state.x.curve(problem), accepted } }
}

/// A candidate and how far it is from the surface.
struct State {
    x: FreeTangents,
    /// Distance along the normal in chord lengths, and the normal, at each sample.
    feet: [(f64, DVec3); SAMPLES],
    square_distance: f64,
}

struct Run<'a> {
    problem: &'a EdgeProblem,
    settings: &'a Settings,
    foot: &'a dyn Fn(DVec3) -> Option<CurveFoot>,
}

impl Run<'_> {
    /// Turning of the normals along a curve, in radians.
    fn turning(&self, curve: &QuarticCurve) -> Option<f64> {
        let [start, end] = [0, 1].map(|i| self.problem.ends[i].normal);
        let normal = |t: f64| (self.foot)(curve.eval(t)).map(|foot| foot.normal);
        let normals = [start, normal(0.25)?, normal(0.5)?, normal(0.75)?, end];
        Some(Turning::of(&normals)?.angle.max(MIN_TURNING))
    }

    fn state(&self, x: FreeTangents) -> Option<State> {
        let curve = x.curve(self.problem);
        let mut feet = [(0.0, DVec3::ZERO); SAMPLES];
        let mut square_distance = 0.0;
        for (j, slot) in feet.iter_mut().enumerate() {
            let point = curve.eval(parameter(j));
            let foot = (self.foot)(point)?;
            let distance = (point - foot.point).dot(foot.normal) / self.problem.chord;
            *slot = (distance, foot.normal);
            square_distance += distance * distance;
        }
        square_distance.is_finite().then_some(State { x, feet, square_distance })
    }

    /// One step along the first `directions` of the null space, then back onto the conditions.
    fn step(&self, state: &State, directions: usize, tangential: f64) -> Option<State> {
        let sideways = directions == DIRECTIONS;
        let frame = Frame::new(&state.x.condition_gradients(self.problem, sideways));
        let step = self.least_squares(state, &frame, directions, tangential)?;
        let moved = FreeTangents(state.x.0 + step);
        self.state(moved.towards_conditions(self.problem, sideways, CORRECTIONS))
    }

    /// Normal distances to zero with little tangential motion, by QR.
    fn least_squares(
        &self,
        state: &State,
        frame: &Frame,
        directions: usize,
        tangential: f64,
    ) -> Option<SVector<f64, 7>> {
        let mut space = frame.null_space();
        space.columns_mut(directions, DIRECTIONS - directions).fill(0.0);
        let mut matrix = SMatrix::<f64, EQUATIONS, DIRECTIONS>::zeros();
        let mut rhs = SVector::<f64, EQUATIONS>::zeros();
        for (j, &(distance, normal)) in state.feet.iter().enumerate() {
            let (u, v) = normal.any_orthonormal_pair();
            rhs[3 * j] = -distance;
            for d in 0..directions {
                let motion =
                    free_tangents::motion(self.problem, &space.column(d).into(), parameter(j));
                matrix[(3 * j, d)] = motion.dot(normal);
                matrix[(3 * j + 1, d)] = tangential * motion.dot(u);
                matrix[(3 * j + 2, d)] = tangential * motion.dot(v);
            }
        }
        for d in 0..DIRECTIONS {
            matrix[(3 * SAMPLES + d, d)] = FLOOR;
        }
        let qr = matrix.qr();
        qr.q_tr_mul(&mut rhs);
        let coordinates =
            qr.r().solve_upper_triangular(&rhs.fixed_rows::<DIRECTIONS>(0).into_owned())?;
        let step = space * coordinates;
        step.iter().all(|v| v.is_finite()).then_some(step)
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
            && after.x.conditions(self.problem).norm() < CONDITIONS_MET
    }
}

fn parameter(j: usize) -> f64 {
    (j + 1) as f64 / (SAMPLES + 1) as f64
}
