//! The seven unknowns of a curve whose end tangents may also turn in their tangent planes.

use bezier_core::glam::DVec3;
use bezier_core::{QuarticCurve, bernstein};
use nalgebra::{SMatrix, SVector};

use crate::frame::Frame;
use crate::problem::{EdgeProblem, End};

/// Where Newton steps towards the conditions end, in chord lengths.
const CONDITIONS_HOLD: f64 = 1e-15;

/// `(a0, a1, q2, b0, b1)` in chord lengths: `q1 = q0 + a0 t0 + b0 s0`, `q3 = q4 + a1 t1 + b1 s1`, with
/// `t` the end tangents of the problem and `s = N × t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeTangents(pub(crate) SVector<f64, 7>);

fn sideways(end: &End) -> DVec3 {
    end.normal.cross(end.tangent)
}

fn middle(x: &SVector<f64, 7>) -> DVec3 {
    DVec3::new(x[2], x[3], x[4])
}

impl FreeTangents {
    /// The unknowns of a curve between the end points of the problem.
    pub(crate) fn of(problem: &EdgeProblem, curve: &QuarticCurve) -> Self {
        let q = curve.points;
        let [start, end] = &problem.ends;
        let first = (q[1] - q[0]) / problem.chord;
        let last = (q[3] - q[4]) / problem.chord;
        let q2 = (q[2] - q[0]) / problem.chord;
        Self(SVector::from([
            first.dot(start.tangent),
            last.dot(end.tangent),
            q2.x,
            q2.y,
            q2.z,
            first.dot(sideways(start)),
            last.dot(sideways(end)),
        ]))
    }

    /// Length along the chord's tangent direction and sideways part of an end tangent.
    pub(crate) fn end_tangent(&self, end: usize) -> (f64, f64) {
        (self.0[end], self.0[5 + end])
    }

    /// End tangent as a vector, in chord lengths.
    fn tangent(&self, problem: &EdgeProblem, i: usize) -> DVec3 {
        let (length, aside) = self.end_tangent(i);
        problem.ends[i].tangent * length + sideways(&problem.ends[i]) * aside
    }

    /// The curve in world coordinates.
    pub(crate) fn curve(&self, problem: &EdgeProblem) -> QuarticCurve {
        problem.curve_with(self.tangent(problem, 0), middle(&self.0), self.tangent(problem, 1))
    }

    /// The curvature conditions `4 II(q1 - q0, q1 - q0) - 3 (q2 - q0)·N`, and the same at the end.
    pub(crate) fn conditions(&self, problem: &EdgeProblem) -> SVector<f64, 2> {
        SVector::from_fn(|i, _| {
            let end = &problem.ends[i];
            let tangent = self.tangent(problem, i);
            4.0 * problem.second_form(i, tangent, tangent)
                - 3.0 * (middle(&self.0) - end.point).dot(end.normal)
        })
    }

    /// Their gradients, one column each; without `sideways`, those of `b0` and `b1` are zero.
    pub(crate) fn condition_gradients(
        &self,
        problem: &EdgeProblem,
        with_sideways: bool,
    ) -> SMatrix<f64, 7, 2> {
        let mut gradients = SMatrix::<f64, 7, 2>::zeros();
        for (i, end) in problem.ends.iter().enumerate() {
            let tangent = self.tangent(problem, i);
            gradients[(i, i)] = 8.0 * problem.second_form(i, tangent, end.tangent);
            for axis in 0..3 {
                gradients[(2 + axis, i)] = -3.0 * end.normal[axis];
            }
            if with_sideways {
                gradients[(5 + i, i)] = 8.0 * problem.second_form(i, tangent, sideways(end));
            }
        }
        gradients
    }
}

impl FreeTangents {
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
            if defect.norm() < CONDITIONS_HOLD {
                break;
            }
            let gradients = self.condition_gradients(problem, with_sideways);
            self.0 -= Frame::new(&gradients).smallest_solution(&defect);
        }
        self
    }
}

/// Motion of the curve point at `t`, in chord lengths, when the unknowns move by `direction`.
pub(crate) fn motion(problem: &EdgeProblem, direction: &SVector<f64, 7>, t: f64) -> DVec3 {
    let [_, b1, b2, b3, _] = bernstein::<5>(t);
    let step = FreeTangents(*direction);
    step.tangent(problem, 0) * b1 + middle(direction) * b2 + step.tangent(problem, 1) * b3
}
