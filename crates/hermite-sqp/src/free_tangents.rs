//! The seven unknowns of a curve whose end tangents may also turn in their tangent planes.

use bezier_core::QuarticCurve;
use bezier_core::glam::DVec3;

use crate::gradients::{Vector, smallest_solution};
use crate::problem::EdgeProblem;

/// Where Newton steps towards the conditions end, in chord lengths.
const CONDITIONS_HOLD: f64 = 1e-15;

/// `(a0, a1, q2, b0, b1)` in chord lengths: `q1 = q0 + a0 t0 + b0 s0`, `q3 = q4 + a1 t1 + b1 s1`, with
/// `t` the end tangents of the problem and `s = N × t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeTangents(pub(crate) Vector);

impl FreeTangents {
    /// The unknowns of a curve between the end points of the problem.
    pub(crate) fn of(problem: &EdgeProblem, curve: &QuarticCurve) -> Self {
        let q = curve.points;
        let [start, end] = &problem.ends;
        let first = (q[1] - q[0]) / problem.chord;
        let last = (q[3] - q[4]) / problem.chord;
        let q2 = (q[2] - q[0]) / problem.chord;
        Self(Vector::from([
            first.dot(start.tangent),
            last.dot(end.tangent),
            q2.x,
            q2.y,
            q2.z,
            first.dot(start.sideways),
            last.dot(end.sideways),
        ]))
    }

    /// Length along the chord's tangent direction and sideways part of an end tangent.
    pub(crate) fn end_tangent(&self, end: usize) -> (f64, f64) {
        (self.0[end], self.0[5 + end])
    }

    /// End tangent as a vector, in chord lengths.
    pub(crate) fn tangent(&self, problem: &EdgeProblem, i: usize) -> DVec3 {
        let (length, aside) = self.end_tangent(i);
        problem.ends[i].tangent * length + problem.ends[i].sideways * aside
    }

    /// The middle control point, in chord lengths from the start.
    pub(crate) fn middle(&self) -> DVec3 {
        DVec3::new(self.0[2], self.0[3], self.0[4])
    }

    /// The curve in world coordinates.
    pub(crate) fn curve(&self, problem: &EdgeProblem) -> QuarticCurve {
        problem.curve_with(self.tangent(problem, 0), self.middle(), self.tangent(problem, 1))
    }

    /// The curvature conditions `4 II(q1 - q0, q1 - q0) - 3 (q2 - q0)·N`, and the same at the end.
    pub(crate) fn conditions(&self, problem: &EdgeProblem) -> [f64; 2] {
        [0, 1].map(|i| {
            let end = &problem.ends[i];
            let (length, aside) = self.end_tangent(i);
            4.0 * end.second_form([length, aside], [length, aside])
                - 3.0 * (self.middle() - end.point).dot(end.normal)
        })
    }

    /// Their gradients; without `sideways`, those of `b0` and `b1` are zero.
    pub(crate) fn condition_gradients(
        &self,
        problem: &EdgeProblem,
        with_sideways: bool,
    ) -> [Vector; 2] {
        [0, 1].map(|i| {
            let end = &problem.ends[i];
            let (length, aside) = self.end_tangent(i);
            let mut gradient = Vector::zeros();
            gradient[i] = 8.0 * end.second_form([length, aside], [1.0, 0.0]);
            for axis in 0..3 {
                gradient[2 + axis] = -3.0 * end.normal[axis];
            }
            if with_sideways {
                gradient[5 + i] = 8.0 * end.second_form([length, aside], [0.0, 1.0]);
            }
            gradient
        })
    }

    /// Newton steps of smallest norm towards the curvature conditions, until they hold to round-off
    /// or `steps` have been taken.
    pub(crate) fn towards_conditions(
        mut self,
        problem: &EdgeProblem,
        with_sideways: bool,
        steps: usize,
    ) -> Self {
        for _ in 0..steps {
            let defect = self.conditions(problem);
            if norm(defect) < CONDITIONS_HOLD {
                break;
            }
            let gradients = self.condition_gradients(problem, with_sideways);
            self.0 -= smallest_solution(&gradients, defect);
        }
        self
    }
}

/// Length of the vector of both conditions.
pub(crate) fn norm([a, b]: [f64; 2]) -> f64 {
    (a * a + b * b).sqrt()
}
