//! The dual of a quadratic program with inequalities: non-negative multipliers.

use nalgebra::{DMatrix, DVector};

/// Multipliers `y >= 0` with the least `½ yᵀ M y - gᵀ y` for a positive definite matrix with a unit
/// diagonal, from a first guess.
///
/// The method of \[Lawson, Hanson: Solving least squares problems, chapter 23\]; several multipliers are
/// let loose at a time as long as that makes progress.
pub(crate) fn non_negative(matrix: &DMatrix<f64>, g: &[f64], y: &mut [f64]) {
    let touch = 1e-12 * g.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let mut loose: Vec<usize> = (0..g.len()).filter(|&i| y[i] > 0.0).collect();
    let mut value = f64::INFINITY;
    let mut single = false;
    for _ in 0..3 * g.len() + 10 {
        settle(matrix, g, y, &mut loose);
        let slopes = slopes(matrix, g, y);
        let now = -0.5 * (0..g.len()).map(|i| y[i] * (g[i] + slopes[i])).sum::<f64>();
        let progress = now < value - 1e-14 * value.abs().min(1e300);
        if !progress && single {
            break;
        }
        single = !progress;
        value = value.min(now);
        let rising = (0..g.len()).filter(|i| slopes[*i] > touch && !loose.contains(i));
        if single {
            loose.extend(rising.max_by(|&a, &b| slopes[a].total_cmp(&slopes[b])));
        } else {
            let before = loose.len();
            let rising: Vec<usize> = rising.collect();
            loose.extend(rising);
            if loose.len() == before {
                break;
            }
        }
        loose.sort_unstable();
    }
}

/// `g - M y`.
fn slopes(matrix: &DMatrix<f64>, g: &[f64], y: &[f64]) -> Vec<f64> {
    let product = matrix * DVector::from_column_slice(y);
    g.iter().zip(product.iter()).map(|(g, p)| g - p).collect()
}

/// Moves the loose multipliers to the best values with the others at zero; those that would fall below
/// zero stop there.
fn settle(matrix: &DMatrix<f64>, g: &[f64], y: &mut [f64], loose: &mut Vec<usize>) {
    while !loose.is_empty() {
        let part = DMatrix::from_fn(loose.len(), loose.len(), |i, j| matrix[(loose[i], loose[j])]);
        let right = DVector::from_iterator(loose.len(), loose.iter().map(|&i| g[i]));
        let Some(factors) = part.cholesky() else { return };
        let best = factors.solve(&right);
        let steps = loose.iter().zip(best.iter()).filter(|(_, b)| **b <= 0.0);
        let step = steps.map(|(&i, b)| y[i] / (y[i] - b)).fold(1.0, f64::min);
        for (&i, b) in loose.iter().zip(best.iter()) {
            y[i] += step * (b - y[i]);
        }
        if step >= 1.0 && best.iter().all(|b| *b > 0.0) {
            return;
        }
        let stopped: Vec<bool> =
            best.iter().zip(&*loose).map(|(b, &i)| *b <= 0.0 && y[i] <= 1e-14 * b.abs()).collect();
        let mut stopped = stopped.into_iter();
        loose.retain(|&i| {
            let stops = stopped.next().unwrap_or(false);
            if stops {
                y[i] = 0.0;
            }
            !stops
        });
    }
}

#[cfg(test)]
mod tests {
    use testkit::Numbers;

    use super::*;

    #[test]
    fn multipliers_or_slopes_vanish() {
        let mut numbers = Numbers::new(11);
        for n in [1, 2, 7, 30] {
            for _ in 0..20 {
                let rows = DMatrix::from_fn(n, n + 2, |_, _| numbers.signed());
                let product = &rows * rows.transpose();
                let size = |i: usize| f64::sqrt(product[(i, i)]);
                let matrix = DMatrix::from_fn(n, n, |i, j| {
                    product[(i, j)] / (size(i) * size(j)) + if i == j { 1e-8 } else { 0.0 }
                });
                let g: Vec<f64> = (0..n).map(|_| numbers.signed()).collect();
                // from nothing, and from a guess
                for first in [0.0, 1.0] {
                    let mut y = vec![first; n];
                    non_negative(&matrix, &g, &mut y);
                    for (y, slope) in y.iter().zip(slopes(&matrix, &g, &y)) {
                        assert!(*y >= 0.0 && slope <= 1e-9, "{n}: {y} and {slope}");
                        assert!(*y == 0.0 || slope.abs() <= 1e-9, "{n}: {y} and {slope}");
                    }
                }
            }
        }
    }
}
