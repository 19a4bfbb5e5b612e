//! Small least-squares problems of fixed size, without allocation.

/// Running sums of a dot product: independent of each other, so that they become vector
/// instructions.
const SUMS: usize = 4;

/// The `x` that minimises `|A x - b|² + Σ (damping_c x_c)²`, `A` being given by columns; `None` if
/// it is not finite.
///
/// By Householder reflections of `A` with the damping on top, never by normal equations: rows and
/// damping may differ in size by many powers of ten. The diagonal on top does not fill up, so that
/// each reflection touches one row of it and all rows of `A`. Columns and right-hand side are
/// overwritten.
pub fn damped_least_squares<const ROWS: usize, const UNKNOWNS: usize>(
    columns: &mut [[f64; ROWS]; UNKNOWNS],
    rhs: &mut [f64; ROWS],
    damping: &[f64; UNKNOWNS],
) -> Option<[f64; UNKNOWNS]> {
    // the rows on top after the reflections: an upper triangle and its right-hand side
    let mut upper = [[0.0; UNKNOWNS]; UNKNOWNS];
    let mut x = [0.0; UNKNOWNS];
    for k in 0..UNKNOWNS {
        let (done, rest) = columns.split_at_mut(k + 1);
        let pivot = &done[k];
        let norm = (damping[k] * damping[k] + dot(pivot, pivot)).sqrt();
        upper[k][k] = -norm.copysign(damping[k]);
        let head = damping[k] - upper[k][k];
        // 2 / |v|² of the vector v = (head, pivot)
        let scale = 1.0 / (norm * head.abs());
        for (entry, column) in upper[k][k + 1..].iter_mut().zip(rest) {
            *entry = reflect(pivot, head, scale, column);
        }
        x[k] = reflect(pivot, head, scale, rhs);
    }
    for k in (0..UNKNOWNS).rev() {
        let known: f64 = (k + 1..UNKNOWNS).map(|c| upper[k][c] * x[c]).sum();
        x[k] = (x[k] - known) / upper[k][k];
    }
    x.iter().all(|v| v.is_finite()).then_some(x)
}

/// Reflects `(0, column)` by the vector `(head, pivot)`; returns the new entry on top.
#[inline]
fn reflect<const ROWS: usize>(
    pivot: &[f64; ROWS],
    head: f64,
    scale: f64,
    column: &mut [f64; ROWS],
) -> f64 {
    let share = scale * dot(pivot, column);
    for (entry, v) in column.iter_mut().zip(pivot) {
        *entry -= share * v;
    }
    -share * head
}

#[inline]
fn dot<const ROWS: usize>(a: &[f64; ROWS], b: &[f64; ROWS]) -> f64 {
    let mut sums = [0.0; SUMS];
    let (heads, tails) = (a.chunks_exact(SUMS), b.chunks_exact(SUMS));
    let rest: f64 = heads.remainder().iter().zip(tails.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in heads.zip(tails) {
        for lane in 0..SUMS {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: [[f64; 6]; 3] = [
        [1.0, 2.0, -1.0, 0.5, 3.0, 1.0],
        [0.0, 1.0, 4.0, -2.0, 1.0, 0.5],
        [2.0, -1.0, 0.0, 1.0, 1.0, -3.0],
    ];
    const RHS: [f64; 6] = [1.0, -2.0, 0.5, 3.0, 1.0, 2.0];

    fn solve<const ROWS: usize, const UNKNOWNS: usize>(
        mut columns: [[f64; ROWS]; UNKNOWNS],
        mut rhs: [f64; ROWS],
        damping: [f64; UNKNOWNS],
    ) -> Option<[f64; UNKNOWNS]> {
        damped_least_squares(&mut columns, &mut rhs, &damping)
    }

    fn residual(x: &[f64; 3]) -> [f64; 6] {
        std::array::from_fn(|row| (0..3).map(|c| COLUMNS[c][row] * x[c]).sum::<f64>() - RHS[row])
    }

    #[test]
    fn the_gradient_vanishes() {
        for damping in [[0.0; 3], [0.5, 1e-9, 2.0], [-3.0, 1e6, 0.1]] {
            let x = solve(COLUMNS, RHS, damping).unwrap();
            for c in 0..3 {
                let pull = damping[c] * damping[c] * x[c];
                let gradient = dot(&COLUMNS[c], &residual(&x)) + pull;
                assert!(gradient.abs() <= 1e-13, "damping {damping:?}: {gradient:e}");
            }
        }
    }

    #[test]
    fn weak_rows_decide_what_strong_rows_leave_open() {
        // x + y = 2 strongly, x - y = 1 weakly: squared, the weak row would drown in round-off
        let weak = 1e-10;
        let columns = [[1.0, weak], [1.0, -weak]];
        let x = solve(columns, [2.0, weak], [0.0; 2]).unwrap();
        assert!((x[0] - 1.5).abs() <= 1e-5 && (x[1] - 0.5).abs() <= 1e-5, "{x:?}");
    }

    #[test]
    fn undetermined_is_none_unless_damped() {
        let columns = [[1.0, 0.0], [0.0, 0.0]];
        assert_eq!(solve(columns, [3.0, 1.0], [0.0; 2]), None);
        let x = solve(columns, [3.0, 1.0], [0.0, 1e-8]).unwrap();
        assert!((x[0] - 3.0).abs() <= 1e-14 && x[1] == 0.0, "{x:?}");
    }
}
