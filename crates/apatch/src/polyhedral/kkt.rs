//! Quadratic programs with equalities only: one factorisation of the sparse KKT matrix.

use clarabel::algebra::CscMatrix;
use clarabel::qdldl::{QDLDLFactorisation, QDLDLSettingsBuilder};

use super::conditions::Row;

/// The matrix `[P Aᵀ; A 0]`, factored with a little added to its diagonal, which refinement removes.
pub(crate) struct Kkt {
    /// Upper triangle of `P`, with all diagonal entries.
    quadratic: CscMatrix<f64>,
    rows: Vec<Row>,
    factors: QDLDLFactorisation<f64>,
    /// Where each unknown and multiplier stands in the factors.
    places: Vec<usize>,
}

/// A linear form after the forward half of a solution: stretches of places with values that are not
/// zero, and where they start.
pub(crate) struct Half(Vec<(usize, Vec<f64>)>);

/// Zeros that may stand between values of one stretch.
const GAP: usize = 8;

impl Half {
    /// Adds a value at a place after all others.
    fn push(&mut self, place: usize, value: f64) {
        if let Some((start, values)) = self.0.last_mut()
            && place - *start < values.len() + GAP
        {
            values.resize(place - *start, 0.0);
            values.push(value);
        } else {
            self.0.push((place, vec![value]));
        }
    }

    pub(crate) fn scale(&mut self, factor: f64) {
        self.0.iter_mut().flat_map(|s| &mut s.1).for_each(|value| *value *= factor);
    }
}

/// Sum of products, several at a time.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// The largest of the absolute values; infinite if one is not a number.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m: f64, v| if v.is_nan() { f64::INFINITY } else { m.max(v.abs()) })
}

/// Added to the diagonal of the quadratic form, and subtracted from that of the conditions, which need
/// not be independent: refinement then still converges, because it is the method of multipliers.
///
/// The first pair whose factorisation keeps all signs is taken: flat tetrahedra need larger ones, with
/// which refinement takes more steps.
const SHIFTS: [[f64; 2]; 4] = [[1e-11, 3e-8], [1e-10, 1e-6], [1e-9, 1e-5], [1e-8, 1e-4]];
/// Steps of refinement in which the residual must be halved.
const PATIENCE: usize = 3;

impl Kkt {
    /// `None` if the factorisation fails.
    pub(crate) fn new(quadratic: CscMatrix<f64>, rows: Vec<Row>) -> Option<Self> {
        let factors = SHIFTS.iter().find_map(|&shifts| factors(&quadratic, &rows, shifts))?;
        let mut places = vec![0; factors.perm.len()];
        factors.perm.iter().enumerate().for_each(|(place, &k)| places[k] = place);
        Some(Self { quadratic, rows, factors, places })
    }

    /// Improves the solution of `P x + Aᵀ y = f`, `A x = right sides`, unknowns before multipliers,
    /// until it gets no better or for a number of steps.
    pub(crate) fn refine(&mut self, solution: &mut Vec<f64>, f: &[f64], steps: usize) {
        let n = self.quadratic.n;
        let mut right = f.to_vec();
        right.extend(self.rows.iter().map(|r| r.right));
        solution.resize(right.len(), 0.0);
        debug_assert_eq!(f.len(), n, "one for each unknown");
        let mut best: Option<(f64, Vec<f64>)> = None;
        let (mut mark, mut stalled) = (f64::INFINITY, 0);
        for step in 0..=steps {
            let mut residual = self.residual(solution, &right);
            let size = largest(residual.iter().copied());
            if size < 0.5 * mark {
                (mark, stalled) = (size, 0);
            } else {
                stalled += 1;
            }
            if best.as_ref().is_none_or(|(known, _)| size < *known) {
                best = Some((size, solution.clone()));
            }
            if size == 0.0 || size.is_infinite() || stalled > PATIENCE || step == steps {
                break;
            }
            self.factors.solve(&mut residual);
            solution.iter_mut().zip(&residual).for_each(|(s, r)| *s += r);
        }
        if let Some((_, known)) = best {
            *solution = known;
        }
    }

    fn residual(&self, solution: &[f64], right: &[f64]) -> Vec<f64> {
        let n = self.quadratic.n;
        let mut residual = right.to_vec();
        let matrix = &self.quadratic;
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

    /// The forward half of the solution for a linear form of the unknowns.
    pub(crate) fn half(&self, terms: &[(usize, f64)]) -> Half {
        let factors = &self.factors.L;
        let mut all = vec![0.0; factors.n];
        terms.iter().for_each(|&(unknown, factor)| all[self.places[unknown]] += factor);
        let mut half = Half(Vec::new());
        for k in 0..all.len() {
            let value = all[k];
            if value == 0.0 {
                continue;
            }
            half.push(k, value);
            let column = factors.colptr[k]..factors.colptr[k + 1];
            for (row, factor) in factors.rowval[column.clone()].iter().zip(&factors.nzval[column]) {
                all[*row] -= factor * value;
            }
        }
        half
    }

    /// The products `c K⁻¹ dᵀ` of one linear form with others, after their forward halves.
    pub(crate) fn products<'a>(&self, of: &Half, with: impl Iterator<Item = &'a Half>) -> Vec<f64> {
        let mut all = vec![0.0; self.factors.Dinv.len()];
        for (start, values) in &of.0 {
            let inverse = &self.factors.Dinv[*start..];
            let scaled = all[*start..].iter_mut().zip(values.iter().zip(inverse));
            scaled.for_each(|(a, (value, inverse))| *a = value * inverse);
        }
        let product =
            |(start, values): &(usize, Vec<f64>)| dot(&all[*start..*start + values.len()], values);
        with.map(|half| half.0.iter().map(product).sum()).collect()
    }
}

/// Factors of the matrix with shifts on its diagonal; `None` if it is too close to singular for them.
fn factors(
    quadratic: &CscMatrix<f64>,
    rows: &[Row],
    [shift, row_shift]: [f64; 2],
) -> Option<QDLDLFactorisation<f64>> {
    let (n, m) = (quadratic.n, rows.len());
    let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
    for column in 0..n {
        for k in quadratic.colptr[column]..quadratic.colptr[column + 1] {
            let row = quadratic.rowval[k];
            i.push(row);
            j.push(column);
            v.push(quadratic.nzval[k] + if row == column { shift } else { 0.0 });
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
        v.push(-row_shift);
    }
    let matrix = CscMatrix::new_from_triplets(n + m, n + m, i, j, v);
    let signs = (0..n + m).map(|k| if k < n { 1 } else { -1 }).collect();
    let settings = QDLDLSettingsBuilder::default().Dsigns(signs).build().ok()?;
    let factors = QDLDLFactorisation::new(&matrix, Some(settings)).ok()?;
    (factors.regularize_count() == 0 && factors.D.iter().all(|d| d.is_finite())).then_some(factors)
}
