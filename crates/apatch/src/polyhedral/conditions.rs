//! Linear conditions for second-order smoothness, by blossoms.

use std::collections::HashMap;

use super::dofs::{DEGREE, Dofs, dof_at};
use super::hull::{Cell, Hull};
use crate::bernstein::indices;
use crate::rational::{Convexity, Side};

/// A linear form in the unknowns, and its value.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Row {
    /// Unknowns in ascending order with their factors.
    pub(crate) terms: Vec<(usize, f64)>,
    pub(crate) right: f64,
}

impl Row {
    /// Collects terms in all weights; known ones go to the right side. `None` without unknowns.
    ///
    /// The largest factor becomes 1 or -1.
    pub(crate) fn new(dofs: &Dofs, mut terms: Vec<(usize, f64)>, right: f64) -> Option<Self> {
        terms.sort_by_key(|t| t.0);
        let mut row = Self { terms: Vec::new(), right };
        for (dof, factor) in terms {
            match (dofs.fixed[dof], row.terms.last_mut()) {
                (Some(value), _) => row.right -= factor * value,
                (None, Some(last)) if last.0 == dofs.unknown[dof] => last.1 += factor,
                (None, _) => row.terms.push((dofs.unknown[dof], factor)),
            }
        }
        let largest = row.terms.iter().fold(0.0_f64, |m, t| m.max(t.1.abs()));
        if largest == 0.0 {
            return None;
        }
        row.terms.retain(|t| t.1 != 0.0);
        row.terms.iter_mut().for_each(|t| t.1 /= largest);
        row.right /= largest;
        Some(row)
    }

    /// Its value less the wanted one.
    pub(crate) fn excess(&self, x: &[f64]) -> f64 {
        self.terms.iter().map(|&(i, factor)| factor * x[i]).sum::<f64>() - self.right
    }
}

/// The conditions that make the function C2: across every triangle between two tetrahedra, and along
/// straight edges, where the tetrahedra of both triangles meet in the edge only.
pub(crate) fn conditions(hull: &Hull, dofs: &Dofs) -> Vec<Row> {
    let mut rows = Vec::new();
    for [first, second] in neighbours(hull) {
        join(hull, dofs, first, second, &mut rows);
    }
    for [first, second] in across_straight_edges(hull) {
        join(hull, dofs, first, second, &mut rows);
    }
    rows
}

/// Pairs of cells with a common triangle.
pub(crate) fn neighbours(hull: &Hull) -> Vec<[usize; 2]> {
    let mut open: HashMap<[usize; 3], usize> = HashMap::new();
    let mut pairs = Vec::new();
    for (index, &cell) in hull.cells.iter().enumerate() {
        let corners = hull.corners(cell);
        for left_out in 0..4 {
            let mut key = [0, 1, 2].map(|i| corners[i + usize::from(i >= left_out)]);
            key.sort_unstable();
            match open.get(&key) {
                Some(&other) => pairs.push([other, index]),
                None => {
                    open.insert(key, index);
                }
            }
        }
    }
    pairs
}

/// Pairs of tetrahedra over the two triangles at a straight edge.
fn across_straight_edges(hull: &Hull) -> Vec<[usize; 2]> {
    let cell_of = |t: usize, side: Side| hull.cells.iter().position(|&c| c == Cell::Face(t, side));
    let mut pairs = Vec::new();
    for edge in hull.edges.iter().filter(|e| e.convexity == Convexity::Zero) {
        let cells = edge.triangles.map(|t| Side::BOTH.into_iter().find_map(|s| cell_of(t, s)));
        if let [Some(a), Some(b)] = cells {
            pairs.push([a, b]);
        }
    }
    pairs
}

/// `w(λ, x)` and `w(λ, x, y)` of the second cell, for its points `x`, `y` off the common ones, are the
/// blossom of the first cell at the same points \[BCX94 (2.8), (2.9), (2.11)\].
fn join(hull: &Hull, dofs: &Dofs, first: usize, second: usize, rows: &mut Vec<Row>) {
    let corners = [first, second].map(|c| hull.corners(hull.cells[c]));
    let tetrahedron = hull.tetrahedron(hull.cells[first]);
    let common = corners[1].map(|p| corners[0].iter().position(|&q| q == p));
    let coordinates = [0, 1, 2, 3].map(|c| match common[c] {
        Some(_) => None,
        None => Some(tetrahedron.barycentric(hull.points[corners[1][c]])),
    });
    for index in indices(DEGREE) {
        let off: Vec<[f64; 4]> =
            (0..4).flat_map(|c| std::iter::repeat_n(coordinates[c], index[c]).flatten()).collect();
        if !(1..=2).contains(&off.len()) {
            continue;
        }
        let mut base = [0; 4];
        for c in 0..4 {
            if let Some(at) = common[c] {
                base[at] = index[c];
            }
        }
        let mut terms = vec![(dof_at(&dofs.of_cell[second], index), -1.0)];
        let blossom = |raised: &[usize], factor: f64| {
            let mut own = base;
            raised.iter().for_each(|&c| own[c] += 1);
            (dof_at(&dofs.of_cell[first], own), factor)
        };
        match *off {
            [x] => terms.extend((0..4).map(|a| blossom(&[a], x[a]))),
            [x, y] => {
                let pairs = (0..16).map(|k| [k / 4, k % 4]);
                terms.extend(pairs.map(|[a, b]| blossom(&[a, b], x[a] * y[b])));
            }
            _ => {}
        }
        rows.extend(Row::new(dofs, terms, 0.0));
    }
}
