//! Middle weights of triangles whose neighbours lie in the same plane.

use nalgebra::{DMatrix, DVector};

use super::cubic::{Weights, is_coplanar, three_matrix};
use crate::rational::Side;

/// One linear equation for the middle weights of two triangles: triangles, factors, right-hand side.
pub(crate) struct Equation {
    pub(crate) triangles: [usize; 2],
    pub(crate) factors: [f64; 2],
    right: f64,
}

/// Singular values below this times the largest count as zero.
const RANK: f64 = 1e-9;

/// Changes the middle weights (number 2) as little as possible, so that the two conditions for number
/// 3 agree over every edge between coplanar triangles \[ours, instead of displaced guards\].
pub(crate) fn balance(weights: &mut Weights<'_>) {
    let equations = equations(weights);
    if equations.is_empty() {
        return;
    }
    // least change: a combination of the equations, A Aᵀ y = right side
    let n = equations.len();
    let mut gram = DMatrix::<f64>::zeros(n, n);
    for (i, p) in equations.iter().enumerate() {
        for (j, q) in equations.iter().enumerate() {
            for a in 0..2 {
                for b in 0..2 {
                    if p.triangles[a] == q.triangles[b] {
                        gram[(i, j)] += p.factors[a] * q.factors[b];
                    }
                }
            }
        }
    }
    let right = DVector::from_iterator(n, equations.iter().map(|e| e.right));
    let svd = gram.svd(true, true);
    let cut = RANK * svd.singular_values.max();
    let Ok(solution) = svd.solve(&right, cut) else { return };
    for (equation, y) in equations.iter().zip(solution.iter()) {
        for (t, factor) in equation.triangles.into_iter().zip(equation.factors) {
            weights.middle[t] += factor * y;
        }
    }
}

/// The equations for all edges between coplanar triangles.
pub(crate) fn equations(weights: &Weights<'_>) -> Vec<Equation> {
    let mut equations = Vec::new();
    for (e, edge) in weights.hull.edges.iter().enumerate() {
        for side in Side::BOTH {
            let split = edge.splits[side.index()].as_ref().filter(|s| is_coplanar(s));
            let Some(split) = split else { continue };
            // a combination of the conditions in which number 3 cancels
            let [first, second] = three_matrix(split);
            let norm = |r: [f64; 2]| r[0] * r[0] + r[1] * r[1];
            let along = if norm(first) > norm(second) { first } else { second };
            let dot = |r: [f64; 2]| r[0] * along[0] + r[1] * along[1];
            let null = [dot(second), -dot(first)];
            let right = weights.right_sides(e, split);
            equations.push(Equation {
                triangles: edge.triangles,
                factors: [0, 1].map(|i| null[i] * split.coordinates[i][0]),
                right: -(null[0] * right[0] + null[1] * right[1]),
            });
        }
    }
    equations
}
