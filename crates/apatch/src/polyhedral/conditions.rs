//! Linear conditions for second-order smoothness, by blossoms.

use std::collections::HashMap;

use super::dofs::{COUNT, DEGREE, Dofs, dof_at};
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
    pub(crate) fn new(dofs: &Dofs, terms: Vec<(usize, f64)>, right: f64) -> Option<Self> {
        let mut row = Self::plain(dofs, terms, right);
        let largest = row.terms.iter().fold(0.0_f64, |m, t| m.max(t.1.abs()));
        if largest == 0.0 {
            return None;
        }
        row.terms.iter_mut().for_each(|t| t.1 /= largest);
        row.right /= largest;
        Some(row)
    }

    /// The same with the factors as they are.
    pub(crate) fn plain(dofs: &Dofs, mut terms: Vec<(usize, f64)>, right: f64) -> Self {
        terms.sort_by_key(|t| t.0);
        let mut row = Self { terms: Vec::new(), right };
        for (dof, factor) in terms {
            match (dofs.fixed[dof], row.terms.last_mut()) {
                (Some(value), _) => row.right -= factor * value,
                (None, Some(last)) if last.0 == dofs.unknown[dof] => last.1 += factor,
                (None, _) => row.terms.push((dofs.unknown[dof], factor)),
            }
        }
        row.terms.retain(|t| t.1 != 0.0);
        row
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
    for pair in neighbours(hull).into_iter().chain(across_straight_edges(hull)) {
        let joint = Joint::new(hull, dofs, pair);
        for index in indices(DEGREE).filter(|&i| matches!(joint.points_off(i), 1 | 2)) {
            rows.extend(Row::new(dofs, joint.difference(index), 0.0));
        }
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

/// Two cells with common corners.
pub(crate) struct Joint<'a> {
    /// The weights of both.
    weights: [&'a [usize; COUNT]; 2],
    /// Places in the first cell of the corners of the second one.
    common: [Option<usize>; 4],
    /// Coordinates in the first cell of the corners of the second one.
    coordinates: [[f64; 4]; 4],
}

impl<'a> Joint<'a> {
    pub(crate) fn new(hull: &Hull, dofs: &'a Dofs, pair: [usize; 2]) -> Self {
        let corners = pair.map(|cell| hull.corners(hull.cells[cell]));
        let tetrahedron = hull.tetrahedron(hull.cells[pair[0]]);
        Self {
            weights: pair.map(|cell| &dofs.of_cell[cell]),
            common: corners[1].map(|p| corners[0].iter().position(|&q| q == p)),
            coordinates: corners[1].map(|p| tetrahedron.barycentric(hull.points[p])),
        }
    }

    /// The corner of the second cell that is not common, if it is only one.
    pub(crate) fn corner_off(&self) -> Option<usize> {
        let mut off = (0..4).filter(|&c| self.common[c].is_none());
        off.next().filter(|_| off.next().is_none())
    }

    /// How many points of an index of the second cell are not common.
    pub(crate) fn points_off(&self, index: [usize; 4]) -> usize {
        (0..4).filter(|&c| self.common[c].is_none()).map(|c| index[c]).sum()
    }

    /// The blossom of the first cell at the points of an index of the second one, less the weight
    /// there: zero for one and two points off if the function is C2 \[BCX94 (2.8), (2.9), (2.11)\].
    pub(crate) fn difference(&self, index: [usize; 4]) -> Vec<(usize, f64)> {
        let mut own = vec![([0; 4], 1.0)];
        for (c, &times) in index.iter().enumerate() {
            for _ in 0..times {
                own = match self.common[c] {
                    Some(at) => own.iter().map(|&(i, x)| (raised(i, at), x)).collect(),
                    None => {
                        let spread = |&(i, x): &([usize; 4], f64)| {
                            (0..4).map(move |a| (raised(i, a), x * self.coordinates[c][a]))
                        };
                        own.iter().flat_map(spread).collect()
                    }
                };
            }
        }
        let mut terms = vec![(dof_at(self.weights[1], index), -1.0)];
        terms.extend(own.into_iter().map(|(i, x)| (dof_at(self.weights[0], i), x)));
        terms
    }
}

fn raised(mut index: [usize; 4], corner: usize) -> [usize; 4] {
    index[corner] += 1;
    index
}
