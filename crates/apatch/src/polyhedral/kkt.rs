//! Quadratic programs with equalities only: one factorisation of the sparse KKT matrix.

use clarabel::algebra::CscMatrix;
use clarabel::qdldl::{QDLDLFactorisation, QDLDLSettingsBuilder};

use super::conditions::Row;

/// The matrix `[P Aᵀ; A 0]`, factored with a little added to its diagonal, which refinement removes.
pub(crate) struct Kkt<'a> {
    /// Upper triangle of `P`, with all diagonal entries.
    quadratic: &'a CscMatrix<f64>,
    rows: &'a [Row],
    factors: QDLDLFactorisation<f64>,
}

/// The largest of the absolute values; infinite if one is not a number.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m: f64, v| if v.is_nan() { f64::INFINITY } else { m.max(v.abs()) })
}

/// Added to the diagonals.
const SHIFT: f64 = 1e-9;
const MAX_STEPS: usize = 60;

impl<'a> Kkt<'a> {
    /// `None` if the factorisation fails.
    pub(crate) fn new(quadratic: &'a CscMatrix<f64>, rows: &'a [Row]) -> Option<Self> {
        let (n, m) = (quadratic.n, rows.len());
        let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
        for column in 0..n {
            for k in quadratic.colptr[column]..quadratic.colptr[column + 1] {
                let row = quadratic.rowval[k];
                i.push(row);
                j.push(column);
                v.push(quadratic.nzval[k] + if row == column { SHIFT } else { 0.0 });
            }
        }
        for (r, row) in rows.iter().enumerate() {
            for &(unknown, factor) in &row.terms {
                i.push(unknown);
                j.push(n + r);
                v.push(factor);
            }
            i.push(n + r);
            j.push(n + r);
            v.push(-SHIFT);
        }
        let matrix = CscMatrix::new_from_triplets(n + m, n + m, i, j, v);
        let signs = (0..n + m).map(|k| if k < n { 1 } else { -1 }).collect();
        let settings = QDLDLSettingsBuilder::default().Dsigns(signs).build().ok()?;
        let factors = QDLDLFactorisation::new(&matrix, Some(settings)).ok()?;
        Some(Self { quadratic, rows, factors })
    }

    /// The solution of `P x + Aᵀ y = f`, `A x = right sides`, refined until it gets no better.
    pub(crate) fn solve(&mut self, f: &[f64]) -> Vec<f64> {
        let n = self.quadratic.n;
        let mut right = f.to_vec();
        right.extend(self.rows.iter().map(|r| r.right));
        let mut solution = vec![0.0; right.len()];
        let mut best: Option<(f64, Vec<f64>)> = None;
        let mut stalled = 0;
        for _ in 0..MAX_STEPS {
            let mut residual = self.residual(&solution, &right);
            let size = largest(residual.iter().copied());
            let better = best.as_ref().is_none_or(|(known, _)| size < 0.5 * known);
            stalled = if better { 0 } else { stalled + 1 };
            if best.as_ref().is_none_or(|(known, _)| size < *known) {
                best = Some((size, solution.clone()));
            }
            if size == 0.0 || size.is_infinite() || stalled > 3 {
                break;
            }
            self.factors.solve(&mut residual);
            solution.iter_mut().zip(&residual).for_each(|(s, r)| *s += r);
        }
        let mut x = best.map_or(solution, |(_, s)| s);
        x.truncate(n);
        x
    }

    fn residual(&self, solution: &[f64], right: &[f64]) -> Vec<f64> {
        let n = self.quadratic.n;
        let mut residual = right.to_vec();
        let matrix = self.quadratic;
        for column in 0..n {
            for k in matrix.colptr[column]..matrix.colptr[column + 1] {
                let row = matrix.rowval[k];
                residual[row] -= matrix.nzval[k] * solution[column];
                if row != column {
                    residual[column] -= matrix.nzval[k] * solution[row];
                }
            }
        }
        for (r, row) in self.rows.iter().enumerate() {
            for &(unknown, factor) in &row.terms {
                residual[unknown] -= factor * solution[n + r];
                residual[n + r] -= factor * solution[unknown];
            }
        }
        residual
    }
}
