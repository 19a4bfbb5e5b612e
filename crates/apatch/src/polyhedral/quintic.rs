//! The C2 quintic: of all functions with the data and second-order smoothness the fairest one whose
//! zero set is a single sheet.
//!
//! The order of the paper (Appendix D: second derivatives and the weights next to them first) cannot
//! work: its vertex systems are singular. All weights are found together. \[ours\]

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, ZeroConeT};
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus};

use super::conditions::{Row, conditions};
use super::dofs::{COUNT, Dofs};
use super::energy::energy;
use super::hull::Hull;
use super::kkt::{Kkt, largest};
use super::report::{FairnessReport, Report};
use super::settings::FairnessSettings;
use super::signs::{ray_cuts, sign_conditions};
use super::surface::PolyhedralSurface;

/// Steps of the grid of rays that are tried.
const RAYS: usize = 16;

/// The weights of all cells, 56 each.
///
/// First the fairest function whatever its signs, which takes one sparse factorisation; if all its
/// rays meet the surface once it is the answer. Otherwise a quadratic program with conditions on the
/// signs of the weights, to which rays that still go wrong add conditions.
pub(crate) fn quintic(
    hull: &Hull,
    report: &Report,
    settings: &FairnessSettings,
) -> (Vec<f64>, FairnessReport) {
    // in units of about the size: solvers have absolute tolerances
    let unit = hull.size().log2().floor().exp2();
    let hull = hull.clone().scaled(1.0 / unit);
    let dofs = Dofs::new(&hull);
    let problem = Problem::new(&hull, &dofs);
    let mut done = FairnessReport {
        unknowns: dofs.unknowns,
        conditions: problem.rows.len(),
        programs: 0,
        cuts: 0,
        accurate: true,
        residual: 0.0,
    };
    let mut surface = PolyhedralSurface {
        weights: dofs.weights(&problem.fairest()),
        hull,
        degree: 5,
        report: report.clone(),
    };
    if surface.count_bad_rays(RAYS)[0] > 0 {
        solve_with_signs(&problem, &dofs, &mut surface, settings, &mut done);
    }
    done.residual = problem.residual(&dofs, &surface.weights);
    (surface.weights.iter().map(|w| w * unit).collect(), done)
}

fn solve_with_signs(
    problem: &Problem,
    dofs: &Dofs,
    surface: &mut PolyhedralSurface,
    settings: &FairnessSettings,
    done: &mut FairnessReport,
) {
    let mut signs = sign_conditions(&surface.hull, dofs, settings.margin);
    let first = signs.len();
    for round in 0..=settings.rounds {
        let Some((x, accurate)) = problem.solve(&signs) else {
            done.accurate = false;
            break;
        };
        done.programs += 1;
        done.accurate = accurate;
        surface.weights = dofs.weights(&problem.projected(&x));
        let cuts = ray_cuts(surface, dofs, RAYS, settings.margin);
        if cuts.is_empty() || round == settings.rounds {
            break;
        }
        signs.extend(cuts);
    }
    done.cuts = signs.len() - first;
}

/// The quadratic form and the smoothness conditions, in unknowns scaled so that the form has a unit
/// diagonal.
struct Problem {
    quadratic: CscMatrix<f64>,
    /// Minus the gradient at zero.
    linear: Vec<f64>,
    rows: Vec<Row>,
    /// Conditions in the unscaled unknowns.
    plain: Vec<Row>,
    /// Unscaled unknowns are these times the scaled ones.
    scale: Vec<f64>,
}

impl Problem {
    fn new(hull: &Hull, dofs: &Dofs) -> Self {
        let n = dofs.unknowns;
        let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
        let mut linear = vec![0.0; n];
        for (cell, numbers) in hull.cells.iter().zip(&dofs.of_cell) {
            let form = energy(&hull.tetrahedron(*cell));
            for (a, &p) in numbers.iter().enumerate() {
                if dofs.fixed[p].is_some() {
                    continue;
                }
                for (b, &q) in numbers.iter().enumerate() {
                    let (entry, row) = (form[a * COUNT + b], dofs.unknown[p]);
                    match dofs.fixed[q] {
                        Some(value) => linear[row] -= entry * value,
                        None if row <= dofs.unknown[q] => {
                            i.push(row);
                            j.push(dofs.unknown[q]);
                            v.push(entry);
                        }
                        None => {}
                    }
                }
            }
        }
        let mut quadratic = CscMatrix::new_from_triplets(n, n, i, j, v);
        let scale = unit_diagonal(&mut quadratic);
        linear.iter_mut().zip(&scale).for_each(|(l, s)| *l *= s);
        let plain = conditions(hull, dofs);
        let rows = plain.iter().map(|row| scaled(row, &scale)).collect();
        Self { quadratic, linear, rows, plain, scale }
    }

    fn unscaled(&self, z: &[f64]) -> Vec<f64> {
        z.iter().zip(&self.scale).map(|(z, s)| z * s).collect()
    }

    /// The fairest function with the conditions; zeros if the factorisation fails, which the residual
    /// tells.
    fn fairest(&self) -> Vec<f64> {
        match Kkt::new(&self.quadratic, &self.rows) {
            Some(mut kkt) => self.unscaled(&kkt.solve(&self.linear)),
            None => vec![0.0; self.scale.len()],
        }
    }

    /// The nearest unknowns that satisfy the conditions.
    fn projected(&self, x: &[f64]) -> Vec<f64> {
        let n = x.len();
        let identity = CscMatrix::identity(n);
        let z: Vec<f64> = x.iter().zip(&self.scale).map(|(x, s)| x / s).collect();
        match Kkt::new(&identity, &self.rows) {
            Some(mut kkt) => self.unscaled(&kkt.solve(&z)),
            None => x.to_vec(),
        }
    }

    /// The fairest function with `sign row >= its right side` for all given rows, and whether it is as
    /// accurate as asked.
    fn solve(&self, signs: &[Row]) -> Option<(Vec<f64>, bool)> {
        let (n, m) = (self.scale.len(), self.rows.len());
        let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
        let mut right = Vec::with_capacity(m + signs.len());
        let signs = signs.iter().map(|row| {
            let mut row = scaled(row, &self.scale);
            row.terms.iter_mut().for_each(|t| t.1 = -t.1);
            row.right = -row.right;
            row
        });
        let all: Vec<Row> = self.rows.iter().cloned().chain(signs).collect();
        for (r, row) in all.iter().enumerate() {
            for &(unknown, factor) in &row.terms {
                i.push(r);
                j.push(unknown);
                v.push(factor);
            }
            right.push(row.right);
        }
        let matrix = CscMatrix::new_from_triplets(all.len(), n, i, j, v);
        let cones = [ZeroConeT(m), NonnegativeConeT(all.len() - m)];
        let settings =
            DefaultSettingsBuilder::default().verbose(false).max_iter(200).build().ok()?;
        let cost: Vec<f64> = self.linear.iter().map(|l| -l).collect();
        let mut solver =
            DefaultSolver::new(&self.quadratic, &cost, &matrix, &right, &cones, settings).ok()?;
        solver.solve();
        let accurate = solver.solution.status == SolverStatus::Solved;
        let x = self.unscaled(&solver.solution.x);
        x.iter().all(|x| x.is_finite()).then_some((x, accurate))
    }

    /// Largest violation of a condition; infinite if a weight is not a number.
    fn residual(&self, dofs: &Dofs, weights: &[f64]) -> f64 {
        let mut x = vec![0.0; self.scale.len()];
        for (&dof, &w) in dofs.of_cell.iter().flatten().zip(weights) {
            if dofs.fixed[dof].is_none() {
                x[dofs.unknown[dof]] = w;
            }
        }
        largest(self.plain.iter().map(|row| row.excess(&x)))
    }
}

/// Scales rows and columns of a symmetric matrix to a unit diagonal.
fn unit_diagonal(matrix: &mut CscMatrix<f64>) -> Vec<f64> {
    let entries = |column: usize| matrix.colptr[column]..matrix.colptr[column + 1];
    let diagonal = |column: usize| {
        let found = entries(column).find(|&k| matrix.rowval[k] == column);
        found.map_or(0.0, |k| matrix.nzval[k])
    };
    // powers of two keep all digits
    let unit = |d: f64| if d > 0.0 { (-0.5 * d.log2()).round().exp2() } else { 1.0 };
    let scale: Vec<f64> = (0..matrix.n).map(|column| unit(diagonal(column))).collect();
    for (column, of_column) in scale.iter().enumerate() {
        for k in matrix.colptr[column]..matrix.colptr[column + 1] {
            matrix.nzval[k] *= of_column * scale[matrix.rowval[k]];
        }
    }
    scale
}

/// A row in scaled unknowns, its largest factor 1 or -1 again.
fn scaled(row: &Row, scale: &[f64]) -> Row {
    let mut row = row.clone();
    row.terms.iter_mut().for_each(|t| t.1 *= scale[t.0]);
    let largest = row.terms.iter().fold(0.0_f64, |m, t| m.max(t.1.abs()));
    row.terms.iter_mut().for_each(|t| t.1 /= largest);
    row.right /= largest;
    row
}
