//! Conditions on signs that keep the surface a single sheet \[BCX94 Theorem 2.1\], and cuts for rays
//! that miss it.

use super::conditions::Row;
use super::dofs::{COUNT, DEGREE, Dofs, dof_at};
use super::hull::{Cell, Hull};
use super::surface::PolyhedralSurface;
use crate::bernstein::indices;
use crate::rational::Convexity;

/// Conditions `row >= right side` for the weights of all cells; `margin` is the least upper weight.
///
/// Along a ray the weights of the layers (the total index at the upper corners) have the signs
/// `- - * + + +`. Over triangles with tetrahedra on both sides only the upper three layers count.
pub(crate) fn sign_conditions(hull: &Hull, dofs: &Dofs, margin: f64) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut seen = vec![[false; 2]; dofs.fixed.len()];
    for (index, &cell) in hull.cells.iter().enumerate() {
        let sign = cell.side().sign();
        let two_sided = is_two_sided(hull, cell);
        let straight = straight_corners(hull, cell);
        for i in indices(DEGREE) {
            let layer: usize = i[cell.base()..].iter().sum();
            let over_straight = straight.iter().any(|&c| i[c] == 0);
            let (upper, right) = match layer {
                0 | 1 if !two_sided => (false, 0.0),
                2 if over_straight => (true, 0.0),
                3.. => (true, margin),
                _ => continue,
            };
            let dof = dof_at(&dofs.of_cell[index], i);
            let known = &mut seen[dof][usize::from(upper == (sign > 0.0))];
            if dofs.fixed[dof].is_some() || *known {
                continue;
            }
            *known = true;
            let factor = if upper { sign } else { -sign };
            rows.push(Row { terms: vec![(dofs.unknown[dof], factor)], right });
        }
    }
    rows
}

fn is_two_sided(hull: &Hull, cell: Cell) -> bool {
    matches!(cell, Cell::Face(t, _) if hull.triangles[t].apices.iter().all(Option::is_some))
}

/// Corners of a triangle's tetrahedron opposite to straight edges.
fn straight_corners(hull: &Hull, cell: Cell) -> Vec<usize> {
    let Cell::Face(t, _) = cell else { return Vec::new() };
    let straight = |k: &usize| hull.edges[hull.triangles[t].edges[*k]].convexity == Convexity::Zero;
    (0..3).filter(straight).map(|k| (k + 2) % 3).collect()
}

/// Conditions for rays of a grid that do not meet the surface once: their coefficients of the middle
/// layers must not be negative. Of each cell the worst ray for each layer.
pub(crate) fn ray_cuts(
    surface: &PolyhedralSurface,
    dofs: &Dofs,
    steps: usize,
    margin: f64,
) -> Vec<Row> {
    let hull = &surface.hull;
    let mut rows = Vec::new();
    for (index, &cell) in hull.cells.iter().enumerate() {
        let layers = if is_two_sided(hull, cell) { 1..=2 } else { 2..=2 };
        let bad: Vec<_> = surface
            .bad_rays(index, steps)
            .map(|[foot, top]| (foot, top, surface.ray(index, foot, top)))
            .collect();
        for layer in layers {
            let least = |a: &[f64; 6], b: &[f64; 6]| a[layer].total_cmp(&b[layer]);
            let worst = bad.iter().min_by(|a, b| least(&a.2, &b.2));
            rows.extend(worst.and_then(|&(foot, top, _)| {
                let terms = layer_terms(cell, &dofs.of_cell[index], layer, foot, top);
                Row::new(dofs, terms, margin)
            }));
        }
    }
    rows
}

/// The coefficient of a layer along a ray, times the sign of the side, in terms of the weights.
fn layer_terms(
    cell: Cell,
    dofs: &[usize; COUNT],
    layer: usize,
    foot: [f64; 4],
    top: [f64; 4],
) -> Vec<(usize, f64)> {
    let lower = cell.base();
    indices(DEGREE)
        .filter(|i| i[lower..].iter().sum::<usize>() == layer)
        .map(|i| {
            let weight =
                bernstein(&i[..lower], &foot[..lower]) * bernstein(&i[lower..], &top[lower..]);
            (dof_at(dofs, i), cell.side().sign() * weight)
        })
        .collect()
}

/// A Bernstein polynomial in some of the coordinates.
fn bernstein(index: &[usize], x: &[f64]) -> f64 {
    let mut left: usize = index.iter().sum();
    let mut value = 1.0;
    for (&i, &x) in index.iter().zip(x) {
        for k in 0..i {
            value *= x * (left - k) as f64 / (k + 1) as f64;
        }
        left -= i;
    }
    value
}
