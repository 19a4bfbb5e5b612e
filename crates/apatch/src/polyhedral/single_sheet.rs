//! Rays of the cubic that meet the surface several times: the middle weights are changed.
//!
//! This happens over triangles with two apices only, at rays that start on or above the surface and
//! then fall: their second coefficient is negative. It depends linearly on the middle weights
//! (number 2), so "not negative" is a linear condition for each such ray.

use nalgebra::DMatrix;

use super::cubic::{Weights, default_middle, with_middle};
use super::hull::Hull;
use super::middle_weights::equations;
use super::multipliers::non_negative;
use super::settings::ShapeControl;
use super::surface::PolyhedralSurface;

const ROUNDS: usize = 12;
/// What second coefficients aim at, in sizes of the hull.
const SPARE: f64 = 1e-6;
/// Added to the unit diagonal of the dual problem.
const SHIFT: f64 = 1e-10;
/// Parts below this count as none.
const TOUCH: f64 = 1e-9;

/// A ray: its cell, foot and top.
type CellRay = (usize, [f64; 4], [f64; 4]);

/// The condition that the second coefficient of a ray is not negative.
struct Cut {
    /// Its unit gradient in the middle weights, as far as coplanar triangles leave them free.
    direction: Vec<f64>,
    /// How far to go along the gradient from the first middle weights.
    wanted: f64,
}

/// Changes the middle weights as little as possible, so that no ray of a grid with `steps` steps meets
/// the surface several times; returns for how many rays. Nothing is changed if it does not help.
pub(crate) fn repair(surface: &mut PolyhedralSurface, shape: &ShapeControl, steps: usize) -> usize {
    let hull = surface.hull.clone();
    let first = default_middle(&hull, shape);
    let fixed = fixed_directions(&hull, &first);
    let before = (surface.weights.clone(), surface.count_bad_rays(steps)[0]);
    let mut best = (before.0, before.1, 0);
    let (mut middle, mut cuts) = (first.clone(), Vec::new());
    for _ in 0..ROUNDS {
        let rays = falling_rays(surface, steps);
        if rays.is_empty() {
            break;
        }
        let now: Vec<f64> = rays.iter().map(|&r| second(surface, r)).collect();
        let gradients = gradients(surface, shape, &middle, &rays, &now);
        for (gradient, now) in gradients.into_iter().zip(now) {
            let moved: f64 = (0..first.len()).map(|t| gradient[t] * (middle[t] - first[t])).sum();
            cuts.extend(cut(gradient, SPARE * hull.size() - (now - moved), &fixed));
        }
        middle = least_change(&first, &cuts);
        surface.weights = with_middle(&hull, shape, middle.clone());
        let bad = surface.count_bad_rays(steps)[0];
        if bad < best.1 {
            best = (surface.weights.clone(), bad, cuts.len());
        }
    }
    surface.weights = best.0;
    best.2
}

/// The bad ray of each cell whose second coefficient is the least, if that is negative.
fn falling_rays(surface: &PolyhedralSurface, steps: usize) -> Vec<CellRay> {
    let worst = |cell: usize| {
        let rays = surface.bad_rays(cell, steps).map(|[foot, top]| (cell, foot, top));
        rays.min_by(|&a, &b| second(surface, a).total_cmp(&second(surface, b)))
    };
    let all = (0..surface.hull.cells.len()).filter_map(worst);
    all.filter(|&ray| second(surface, ray) < SPARE * surface.hull.size()).collect()
}

fn second(surface: &PolyhedralSurface, (cell, foot, top): CellRay) -> f64 {
    surface.ray(cell, foot, top)[1]
}

/// How the second coefficients of rays change with each middle weight: they are linear.
fn gradients(
    surface: &mut PolyhedralSurface,
    shape: &ShapeControl,
    middle: &[f64],
    rays: &[CellRay],
    now: &[f64],
) -> Vec<Vec<f64>> {
    let hull = surface.hull.clone();
    let step = hull.size();
    let mut gradients = vec![vec![0.0; middle.len()]; rays.len()];
    for t in 0..middle.len() {
        let mut moved = middle.to_vec();
        moved[t] += step;
        surface.weights = with_middle(&hull, shape, moved);
        for ((gradient, &ray), now) in gradients.iter_mut().zip(rays).zip(now) {
            gradient[t] = (second(surface, ray) - now) / step;
        }
    }
    gradients
}

/// Orthogonal unit directions in which the conditions of coplanar triangles forbid any change.
fn fixed_directions(hull: &Hull, middle: &[f64]) -> Vec<Vec<f64>> {
    let mut fixed: Vec<Vec<f64>> = Vec::new();
    for equation in equations(&Weights::with_middle(hull, middle.to_vec())) {
        let mut direction = vec![0.0; middle.len()];
        for (t, factor) in equation.triangles.into_iter().zip(equation.factors) {
            direction[t] += factor;
        }
        fixed.extend(free_part(direction, &fixed).map(|(direction, _)| direction));
    }
    fixed
}

/// The unit direction of a vector without some unit directions, and its length; `None` if hardly
/// anything is left.
fn free_part(mut vector: Vec<f64>, fixed: &[Vec<f64>]) -> Option<(Vec<f64>, f64)> {
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let whole = length(&vector);
    for other in fixed {
        let part: f64 = vector.iter().zip(other).map(|(a, b)| a * b).sum();
        vector.iter_mut().zip(other).for_each(|(v, o)| *v -= part * o);
    }
    let left = length(&vector);
    vector.iter_mut().for_each(|v| *v /= left);
    (left > TOUCH * whole).then_some((vector, left))
}

fn cut(gradient: Vec<f64>, missing: f64, fixed: &[Vec<f64>]) -> Option<Cut> {
    let (direction, length) = free_part(gradient, fixed)?;
    Some(Cut { direction, wanted: missing / length })
}

/// The nearest middle weights that satisfy all cuts, or nearly if they cannot be satisfied.
fn least_change(first: &[f64], cuts: &[Cut]) -> Vec<f64> {
    let dot = |i: usize, j: usize| -> f64 {
        cuts[i].direction.iter().zip(&cuts[j].direction).map(|(a, b)| a * b).sum()
    };
    let n = cuts.len();
    let gram = DMatrix::from_fn(n, n, |i, j| dot(i, j) + if i == j { SHIFT } else { 0.0 });
    let wanted: Vec<f64> = cuts.iter().map(|c| c.wanted).collect();
    let mut multipliers = vec![0.0; n];
    non_negative(&gram, &wanted, &mut multipliers);
    let mut middle = first.to_vec();
    for (cut, y) in cuts.iter().zip(multipliers) {
        middle.iter_mut().zip(&cut.direction).for_each(|(m, d)| *m += y * d);
    }
    middle
}
