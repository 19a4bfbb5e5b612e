//! The 7×7 Lagrange–Newton system [TK09 (11)].

use nalgebra::{SMatrix, SVector};

use crate::problem::{EdgeProblem, Unknowns};

/// Pivots below this fraction of the largest one send the system to the pseudo-inverse: where both
/// curvatures vanish and the normals agree (a plane, the generator of a cylinder) the two
/// constraints coincide and the matrix is singular up to round-off, elsewhere the ratio stays
/// above 1e-6. The same value cuts off singular values.
const SINGULAR: f64 = 1e-12;

/// A step of the unknowns and the new multipliers.
pub(crate) struct Step {
    pub(crate) unknowns: Unknowns,
    pub(crate) multipliers: SVector<f64, 2>,
}

/// Solves `[[W, -G], [Gᵀ, 0]] [u; v] = [-2 (A x - b); -c]` with
/// `W = 2 A - 8 r0 k0 e0 e0ᵀ - 8 r1 k1 e1 e1ᵀ`.
///
/// `None` if the solution is not finite.
pub(crate) fn step(
    problem: &EdgeProblem,
    x: &Unknowns,
    multipliers: &SVector<f64, 2>,
) -> Option<Step> {
    let gradients = problem.constraint_gradients(x);
    let mut w = problem.matrix * 2.0;
    for (i, end) in problem.ends.iter().enumerate() {
        w[(i, i)] -= 8.0 * multipliers[i] * end.curvature;
    }
    let mut matrix = SMatrix::<f64, 7, 7>::zeros();
    matrix.fixed_view_mut::<5, 5>(0, 0).copy_from(&w);
    matrix.fixed_view_mut::<5, 2>(0, 5).copy_from(&-gradients);
    matrix.fixed_view_mut::<2, 5>(5, 0).copy_from(&gradients.transpose());
    let mut rhs = SVector::<f64, 7>::zeros();
    rhs.fixed_rows_mut::<5>(0).copy_from(&(problem.half_gradient(x) * -2.0));
    rhs.fixed_rows_mut::<2>(5).copy_from(&-problem.constraints(x));

    let solution = solve(matrix, &rhs)?;
    Some(Step {
        unknowns: solution.fixed_rows::<5>(0).into_owned(),
        multipliers: solution.fixed_rows::<2>(5).into_owned(),
    })
}

fn solve(matrix: SMatrix<f64, 7, 7>, rhs: &SVector<f64, 7>) -> Option<SVector<f64, 7>> {
    let lu = matrix.lu();
    let pivots = lu.lu_internal().diagonal().abs();
    let solution = if pivots.min() > SINGULAR * pivots.max() {
        lu.solve(rhs)
    } else {
        let svd = matrix.svd(true, true);
        let cut_off = SINGULAR * svd.singular_values.max();
        svd.solve(rhs, cut_off).ok()
    };
    solution.filter(|s| s.iter().all(|v| v.is_finite()))
}
