//! The unknown weights of a continuous function of degree 5: one for each set of five points.

use std::collections::HashMap;

use super::hull::Hull;
use crate::bernstein::{self, indices, rank};
use crate::rational::Convexity;

/// Degree of the function.
pub(crate) const DEGREE: usize = 5;
/// Weights of a cell.
pub(crate) const COUNT: usize = bernstein::count(DEGREE);

/// All weights of the function, by cell, and which of them are known.
#[derive(Debug)]
pub(crate) struct Dofs {
    /// For each cell the numbers of its weights, in order.
    pub(crate) of_cell: Vec<[usize; COUNT]>,
    /// Known values: at the points of the triangulation, value and gradient; along straight edges,
    /// nothing but the plane.
    pub(crate) fixed: Vec<Option<f64>>,
    /// Number among the unknowns, for weights that are not known.
    pub(crate) unknown: Vec<usize>,
    pub(crate) unknowns: usize,
}

impl Dofs {
    pub(crate) fn new(hull: &Hull) -> Self {
        let straight: Vec<[usize; 2]> =
            hull.edges.iter().filter(|e| e.convexity == Convexity::Zero).map(|e| e.ends).collect();
        let mut by_points: HashMap<[usize; DEGREE], usize> = HashMap::new();
        let (mut of_cell, mut fixed) = (Vec::new(), Vec::new());
        for &cell in &hull.cells {
            let corners = hull.corners(cell);
            let mut dofs = [0; COUNT];
            for (dof, index) in dofs.iter_mut().zip(indices(DEGREE)) {
                let key = points(corners, index);
                *dof = *by_points.entry(key).or_insert_with(|| {
                    fixed.push(known(hull, &straight, corners, index));
                    fixed.len() - 1
                });
            }
            of_cell.push(dofs);
        }
        let mut unknowns = 0;
        let mut number = |value: &Option<f64>| {
            unknowns += usize::from(value.is_none());
            unknowns.wrapping_sub(1)
        };
        let unknown = fixed.iter().map(&mut number).collect();
        Self { of_cell, fixed, unknown, unknowns }
    }

    /// The weights of all cells from the unknowns.
    pub(crate) fn weights(&self, x: &[f64]) -> Vec<f64> {
        let value = |&dof: &usize| self.fixed[dof].unwrap_or_else(|| x[self.unknown[dof]]);
        self.of_cell.iter().flatten().map(value).collect()
    }
}

/// The points of a weight, in ascending order.
fn points(corners: [usize; 4], index: [usize; 4]) -> [usize; DEGREE] {
    let mut key = [0; DEGREE];
    let all = (0..4).flat_map(|c| std::iter::repeat_n(corners[c], index[c]));
    key.iter_mut().zip(all).for_each(|(k, p)| *k = p);
    key.sort_unstable();
    key
}

/// The value of a weight that the data fix.
fn known(
    hull: &Hull,
    straight: &[[usize; 2]],
    corners: [usize; 4],
    index: [usize; 4],
) -> Option<f64> {
    let n = DEGREE as f64;
    for c in 0..4 {
        let p = corners[c];
        if p < hull.base_count() && index[c] >= DEGREE - 1 {
            let other = (0..4).find(|&d| d != c && index[d] > 0);
            let slope = |d: usize| (hull.points[corners[d]] - hull.points[p]).dot(hull.normals[p]);
            return Some(other.map_or(0.0, |d| slope(d) / n));
        }
    }
    // on a straight edge, and next to it in the plane of its face
    let on = |ends: &[usize; 2]| -> usize {
        (0..4).filter(|&c| ends.contains(&corners[c])).map(|c| index[c]).sum()
    };
    let has_edge = |ends: &&[usize; 2]| ends.iter().all(|p| corners.contains(p));
    straight.iter().filter(has_edge).find_map(|ends| {
        let apex = index[3];
        let in_plane = on(ends) + apex == DEGREE && apex <= 1;
        in_plane.then_some(0.0)
    })
}

/// The weight of a cell at an index.
pub(crate) fn dof_at(dofs: &[usize; COUNT], index: [usize; 4]) -> usize {
    dofs[rank(index)]
}
