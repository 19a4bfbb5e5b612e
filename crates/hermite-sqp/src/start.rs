//! Where the iteration starts, and what is used where it does not arrive.

use bezier_core::QuarticCurve;
use nalgebra::{SMatrix, SVector, Vector3};

use crate::free_tangents::{FreeTangents, norm};
use crate::problem::{EdgeProblem, Unknowns};
use crate::settings::Settings;

/// Relative cut-off of the pseudo-inverse of the two end normals. Normals closer to parallel than
/// this share one curvature condition: without the cut-off their difference would move `q2` by
/// the defect divided by their angle.
const PARALLEL_NORMALS: f64 = 1e-3;

/// The least-squares fit without constraints. The guess of \[TK09\] for `λ` and `μ` from the
/// curvatures is undefined for straight sections and is not used.
pub(crate) fn unconstrained(problem: &EdgeProblem) -> Option<Unknowns> {
    let x = problem.matrix.cholesky()?.solve(&problem.rhs);
    x.iter().all(|v| v.is_finite()).then_some(x)
}

/// Newton steps that make the conditions hold exactly, and how far they may take the end tangents
/// out of the accepted range (a factor) and `q2` from its place (in chord lengths).
const RESTORING_STEPS: usize = 20;
const RESTORED: f64 = 1e-13;
const STRETCH: f64 = 2.0;
const MAX_SHIFT: f64 = 0.25;

/// A usable curve where the iteration fails: [`clamped`] lengths, then all of the curve, its end
/// tangents included, moved as little as possible so that both curvature conditions hold exactly.
/// Where that would distort the curve, as with end data that contradict each other, it is left out
/// and the surface will not be exactly smooth along the edge.
pub(crate) fn fallback(
    problem: &EdgeProblem,
    unconstrained: Option<Unknowns>,
    settings: &Settings,
) -> QuarticCurve {
    let curve = problem.curve(&clamped(problem, unconstrained, settings));
    let before = FreeTangents::of(problem, &curve);
    let after = before.towards_conditions(problem, true, RESTORING_STEPS);
    let range = settings.min_length / STRETCH..=settings.max_length * STRETCH;
    let sensible = norm(after.conditions(problem)) <= RESTORED
        && [0, 1].iter().all(|&end| range.contains(&after.end_tangent(end).0))
        && (after.0 - before.0).norm() <= MAX_SHIFT;
    if sensible { after.curve(problem) } else { curve }
}

/// End lengths clamped to the accepted range, and `q2` moved from the unconstrained fit by the
/// smallest vector that meets both curvature conditions for these lengths, as far as the normals
/// differ.
fn clamped(
    problem: &EdgeProblem,
    unconstrained: Option<Unknowns>,
    settings: &Settings,
) -> Unknowns {
    let middle = 0.5 * (settings.min_length + settings.max_length);
    let straight = Unknowns::new(middle, middle, 0.0, 0.0, 0.0);
    let mut x = unconstrained.unwrap_or_else(|| {
        // no samples to speak of: the middle of the chord
        let centre = problem.ends[1].point * 0.5;
        straight + Unknowns::new(0.0, 0.0, centre.x, centre.y, centre.z)
    });
    for length in [0, 1] {
        x[length] = x[length].clamp(settings.min_length, settings.max_length);
    }
    let defect: SVector<f64, 2> = problem.constraints(&x) / 3.0;
    let normals = SMatrix::<f64, 2, 3>::from_fn(|row, axis| problem.ends[row].normal[axis]);
    let svd = normals.svd(true, true);
    let cut_off = PARALLEL_NORMALS * svd.singular_values.max();
    let correction: Vector3<f64> = svd.solve(&defect, cut_off).unwrap_or_else(|_| Vector3::zeros());
    for axis in 0..3 {
        x[2 + axis] += correction[axis];
    }
    x
}
