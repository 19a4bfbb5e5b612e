//! The quadratic form of the fairness, in unknowns of about the same size.

use clarabel::algebra::CscMatrix;

use super::conditions::{Joint, Row, neighbours};
use super::dofs::{COUNT, DEGREE, Dofs};
use super::energy::{JUMPS, energy, jump_energy};
use super::hull::Hull;
use crate::bernstein::indices;

/// A quadratic form in scaled unknowns.
pub(crate) struct Scaled {
    /// The upper triangle.
    pub(crate) quadratic: CscMatrix<f64>,
    /// Minus the gradient at zero.
    pub(crate) linear: Vec<f64>,
    /// Unscaled unknowns are these times the scaled ones.
    pub(crate) scale: Vec<f64>,
}

/// The quadratic form while it is collected.
pub(crate) struct Form {
    n: usize,
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    linear: Vec<f64>,
}

impl Form {
    pub(crate) fn new(dofs: &Dofs) -> Self {
        let (n, linear) = (dofs.unknowns, vec![0.0; dofs.unknowns]);
        Self { n, rows: Vec::new(), columns: Vec::new(), values: Vec::new(), linear }
    }

    fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows.push(row);
        self.columns.push(column);
        self.values.push(value);
    }

    pub(crate) fn add_cells(&mut self, hull: &Hull, dofs: &Dofs) {
        for (cell, numbers) in hull.cells.iter().zip(&dofs.of_cell) {
            let form = energy(&hull.tetrahedron(*cell));
            for (a, &p) in numbers.iter().enumerate() {
                if dofs.fixed[p].is_some() {
                    continue;
                }
                for (b, &q) in numbers.iter().enumerate() {
                    let (entry, row) = (form[a * COUNT + b], dofs.unknown[p]);
                    match dofs.fixed[q] {
                        Some(value) => self.linear[row] -= entry * value,
                        None if row <= dofs.unknown[q] => self.add(row, dofs.unknown[q], entry),
                        None => {}
                    }
                }
            }
        }
    }

    /// Jumps between cells as further unknowns, with the rows that define them.
    pub(crate) fn add_jumps(&mut self, hull: &Hull, dofs: &Dofs, rows: &mut Vec<Row>) {
        for pair in neighbours(hull) {
            let joint = Joint::new(hull, dofs, pair);
            let tetrahedron = hull.tetrahedron(hull.cells[pair[1]]);
            let Some(off) = joint.corner_off() else { continue };
            let form = jump_energy(&tetrahedron, off);
            let first = self.n;
            for (i, index) in indices(DEGREE).filter(|index| index[off] == 3).enumerate() {
                let mut row = Row::plain(dofs, joint.difference(index), 0.0);
                row.terms.push((first + i, -1.0));
                rows.push(row);
            }
            for (i, entries) in form.iter().enumerate() {
                (i..JUMPS).for_each(|j| self.add(first + i, first + j, entries[j]));
            }
            self.n += JUMPS;
        }
    }

    /// In unknowns for which the matrix has a unit diagonal, to powers of two.
    pub(crate) fn finish(mut self) -> Scaled {
        self.linear.resize(self.n, 0.0);
        let mut matrix =
            CscMatrix::new_from_triplets(self.n, self.n, self.rows, self.columns, self.values);
        let scale = unit_diagonal(&mut matrix);
        self.linear.iter_mut().zip(&scale).for_each(|(l, s)| *l *= s);
        Scaled { quadratic: matrix, linear: self.linear, scale }
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
pub(crate) fn scaled(row: &Row, scale: &[f64]) -> Row {
    let mut row = row.clone();
    row.terms.iter_mut().for_each(|t| t.1 *= scale[t.0]);
    let largest = row.terms.iter().fold(0.0_f64, |m, t| m.max(t.1.abs()));
    row.terms.iter_mut().for_each(|t| t.1 /= largest);
    row.right /= largest;
    row
}
