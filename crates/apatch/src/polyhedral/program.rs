//! The quadratic program of the quintic.

use clarabel::algebra::CscMatrix;
use nalgebra::{DMatrix, DVector};

use super::conditions::{Row, conditions};
use super::dofs::Dofs;
use super::form::{Form, Scaled, scaled};
use super::hull::Hull;
use super::kkt::{Half, Kkt, largest};
use super::multipliers::non_negative;

/// The fairest function with the smoothness conditions, and with conditions on signs as they are needed.
///
/// Its unknowns are the weights and, after them, the jumps of the third derivatives between cells.
pub(crate) struct Program {
    kkt: Kkt,
    /// Minus the gradient at zero.
    linear: Vec<f64>,
    /// Smoothness conditions in the unscaled unknowns.
    conditions: Vec<Row>,
    /// Unscaled unknowns are these times those of the program, whose form has a unit diagonal.
    scale: Vec<f64>,
    /// Unknowns and multipliers of the smoothness conditions.
    solution: Vec<f64>,
    signs: Vec<Sign>,
    held: Vec<Held>,
    /// The products of the held conditions after elimination of everything else.
    gram: DMatrix<f64>,
}

/// A condition `row >= right side`.
struct Sign {
    row: Row,
    state: State,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Free,
    Held,
    /// The smoothness conditions and the data leave no choice.
    Decided,
}

/// A condition that was found violated.
struct Held {
    sign: usize,
    /// In the unknowns of the program, scaled so that the product with itself is 1.
    terms: Vec<(usize, f64)>,
    unit: f64,
    half: Half,
    multiplier: f64,
}

/// Conditions aim at this much more than asked, in units of the program's size.
const SPARE: f64 = 1e-7;
/// Violations below this count as none, in units of the program's size.
const TOUCH: f64 = 1e-9;
/// Added to the unit diagonal of the dual problem; repetition removes its effect.
const SHIFT: f64 = 1e-8;
/// Products below this times the square of a condition mean that it is decided.
const DECIDED: f64 = 1e-10;
/// Largest number of conditions that are taken up at a time.
const BATCH: usize = 64;
/// Violations of smoothness conditions that are round-off, in units of the program's size.
const SMOOTH: f64 = 1e-15;
const MAX_STEPS: usize = 100;
/// Steps without progress after which conditions count as impossible.
const PATIENCE: usize = 6;
/// Steps of refinement of a solution that is not the last one.
const ROUGH: usize = 2;

impl Program {
    /// The program and its solution without conditions on signs; `None` if the factorisation fails.
    pub(crate) fn new(hull: &Hull, dofs: &Dofs) -> Option<Self> {
        let mut form = Form::new(dofs);
        form.add_cells(hull, dofs);
        let conditions = conditions(hull, dofs);
        let mut rows = conditions.clone();
        form.add_jumps(hull, dofs, &mut rows);
        let Scaled { quadratic, linear, scale } = form.finish();
        let rows = rows.iter().map(|row| scaled(row, &scale)).collect();
        let mut kkt = Kkt::new(quadratic, rows)?;
        let mut solution = Vec::new();
        kkt.refine(&mut solution, &linear, MAX_STEPS);
        let (signs, held, gram) = (Vec::new(), Vec::new(), DMatrix::zeros(0, 0));
        Some(Self { kkt, linear, conditions, scale, solution, signs, held, gram })
    }

    /// The unknowns.
    pub(crate) fn unknowns(&self) -> Vec<f64> {
        self.solution.iter().zip(&self.scale).map(|(z, s)| z * s).collect()
    }

    /// Number of smoothness conditions, and the largest violation of one.
    pub(crate) fn smoothness(&self) -> (usize, f64) {
        let x = self.unknowns();
        (self.conditions.len(), largest(self.conditions.iter().map(|row| row.excess(&x))))
    }

    /// Moves the unknowns as little as possible to where the smoothness conditions hold to round-off, if
    /// they do not yet: over very flat tetrahedra refinement of the whole system stops before.
    pub(crate) fn polish(&mut self) {
        if self.smoothness().1 <= SMOOTH {
            return;
        }
        let x = self.unknowns();
        let n = x.len();
        let identity = CscMatrix::new(n, n, (0..=n).collect(), (0..n).collect(), vec![1.0; n]);
        let Some(mut kkt) = Kkt::new(identity, self.conditions.clone()) else { return };
        let mut moved = x.clone();
        kkt.refine(&mut moved, &x, MAX_STEPS);
        self.solution
            .iter_mut()
            .zip(moved.iter().zip(&self.scale))
            .for_each(|(z, (x, s))| *z = x / s);
    }

    /// Adds conditions `row >= right side`, which [`Self::satisfy`] will meet.
    pub(crate) fn add(&mut self, rows: Vec<Row>) {
        self.signs.extend(rows.into_iter().map(|row| Sign { row, state: State::Free }));
    }

    /// The fairest function with all conditions; whether it meets them.
    ///
    /// Conditions are taken up as they are violated, and given up as soon as they do not pull: the dual
    /// problem stays small.
    pub(crate) fn satisfy(&mut self) -> bool {
        let (mut least, mut stalled) = (f64::INFINITY, 0);
        for _ in 0..MAX_STEPS {
            let x = self.unknowns();
            let violations: Vec<f64> = self.signs.iter().map(|s| -s.row.excess(&x)).collect();
            let worst = self.worst(&violations);
            if worst <= 0.0 || stalled > PATIENCE || !worst.is_finite() {
                break;
            }
            self.release(&violations);
            let taken = self.take_up(&violations);
            let progress = taken > 0 || worst < 0.9 * least;
            stalled = if progress { 0 } else { stalled + 1 };
            least = least.min(worst);
            self.step(&violations);
        }
        self.refine(MAX_STEPS);
        let x = self.unknowns();
        let violations: Vec<f64> = self.signs.iter().map(|s| -s.row.excess(&x)).collect();
        // the margin may be out of reach, the signs may not
        let limit = |s: &Sign| s.row.right.max(0.0) + TOUCH;
        self.signs.iter().zip(&violations).all(|(s, v)| *v <= limit(s))
    }

    /// The largest violation of a condition that can be met; infinite if one is not a number.
    fn worst(&self, violations: &[f64]) -> f64 {
        let open = self.signs.iter().zip(violations).filter(|(s, _)| s.state != State::Decided);
        largest(open.map(|(_, v)| if *v < 0.0 { 0.0 } else { *v }))
    }

    /// Gives up held conditions that are met without a multiplier.
    fn release(&mut self, violations: &[f64]) {
        let stays = |h: &Held| h.multiplier > 0.0 || violations[h.sign] > 0.0;
        let kept: Vec<usize> = (0..self.held.len()).filter(|&k| stays(&self.held[k])).collect();
        self.gram = self.gram.select_rows(&kept).select_columns(&kept);
        let signs = &mut self.signs;
        self.held.retain(|h| {
            if !stays(h) {
                signs[h.sign].state = State::Free;
            }
            stays(h)
        });
    }

    /// Takes up the worst of the violated conditions; returns how many.
    fn take_up(&mut self, violations: &[f64]) -> usize {
        let open = |k: &usize| violations[*k] > 0.0 && self.signs[*k].state == State::Free;
        let mut new: Vec<usize> = (0..violations.len()).filter(open).collect();
        new.sort_by(|&a, &b| violations[b].total_cmp(&violations[a]).then(a.cmp(&b)));
        new.truncate(BATCH);
        let before = self.held.len();
        let held: Vec<Held> = new.iter().filter_map(|&sign| self.hold(sign)).collect();
        self.held.extend(held);
        let n = self.held.len();
        let gram = std::mem::replace(&mut self.gram, DMatrix::zeros(0, 0));
        self.gram = gram.resize(n, n, 0.0);
        for i in before..n {
            let halves = self.held[..i].iter().map(|h| &h.half);
            for (k, product) in
                self.kkt.products(&self.held[i].half, halves).into_iter().enumerate()
            {
                self.gram[(i, k)] = product;
                self.gram[(k, i)] = product;
            }
            self.gram[(i, i)] = 1.0 + SHIFT;
        }
        n - before
    }

    /// Prepares a condition, unless it turns out to be decided.
    fn hold(&mut self, sign: usize) -> Option<Held> {
        let of = &mut self.signs[sign];
        let mut terms: Vec<_> = of.row.terms.iter().map(|&(u, f)| (u, f * self.scale[u])).collect();
        let size = terms.iter().map(|t| t.1 * t.1).sum::<f64>();
        let mut half = self.kkt.half(&terms);
        let square = self.kkt.products(&half, std::iter::once(&half))[0];
        if square.is_nan() || square <= DECIDED * size {
            of.state = State::Decided;
            return None;
        }
        of.state = State::Held;
        let unit = square.sqrt();
        terms.iter_mut().for_each(|t| t.1 /= unit);
        half.scale(1.0 / unit);
        Some(Held { sign, terms, unit, half, multiplier: 0.0 })
    }

    /// New multipliers of the held conditions, and the unknowns for them.
    fn step(&mut self, violations: &[f64]) {
        let mut y: Vec<f64> = self.held.iter().map(|h| h.multiplier).collect();
        let product = &self.gram * DVector::from_column_slice(&y);
        let g: Vec<f64> = (self.held.iter().zip(product.iter()))
            .map(|(h, p)| (SPARE + violations[h.sign]) / h.unit + p)
            .collect();
        non_negative(&self.gram, &g, &mut y);
        self.held.iter_mut().zip(&y).for_each(|(held, &y)| held.multiplier = y);
        self.refine(ROUGH);
    }

    /// The unknowns for the multipliers of the held conditions.
    fn refine(&mut self, steps: usize) {
        let mut f = self.linear.clone();
        for held in &self.held {
            held.terms.iter().for_each(|&(u, factor)| f[u] += held.multiplier * factor);
        }
        self.kkt.refine(&mut self.solution, &f, steps);
    }
}
