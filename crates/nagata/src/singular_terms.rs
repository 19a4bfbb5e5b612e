//! Shortest least-squares solutions of systems with three unknowns, term by term.

use glam::DVec3;

use crate::curvature_parameter::Terms;

/// Most sweeps; two or three are enough for three columns.
const MAX_SWEEPS: usize = 30;

/// The terms of the shortest least-squares solution of `n·x = r` for all rows `(n, r)`, by descending
/// singular values; directions with `s² <= rank · s_max²` are left out.
///
/// The columns of the matrix are made orthogonal by plane rotations (one-sided Jacobi), so singular
/// values and directions come from the matrix itself and not from its square, as they would with
/// the invariants of \[Nagata10 (2.5)\].
pub(crate) fn singular_terms(rows: &[(DVec3, f64)], rank: f64) -> Terms {
    let mut columns: Vec<DVec3> = rows.iter().map(|(n, _)| *n).collect();
    let mut directions = [DVec3::X, DVec3::Y, DVec3::Z];
    for _ in 0..MAX_SWEEPS {
        // no short circuit: all three pairs are wanted
        let rotated =
            [(0, 1), (0, 2), (1, 2)].map(|pair| rotate(&mut columns, &mut directions, pair));
        if rotated == [false; 3] {
            break;
        }
    }
    let squares = columns.iter().fold(DVec3::ZERO, |sum, row| sum + *row * *row);
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| squares[b].total_cmp(&squares[a]));
    let mut terms = Terms { values: [DVec3::ZERO; 3], count: 0, shear: None };
    for k in order {
        if squares[k] > rank * squares[order[0]] {
            let projection: f64 = columns.iter().zip(rows).map(|(row, (_, r))| row[k] * r).sum();
            terms.values[terms.count] = directions[k] * (projection / squares[k]);
            terms.count += 1;
        }
    }
    terms
}

/// Makes two columns orthogonal; whether they were not.
fn rotate(columns: &mut [DVec3], directions: &mut [DVec3; 3], (p, q): (usize, usize)) -> bool {
    let (mut pp, mut qq, mut pq) = (0.0, 0.0, 0.0);
    for row in columns.iter() {
        pp += row[p] * row[p];
        qq += row[q] * row[q];
        pq += row[p] * row[q];
    }
    if pq.abs() <= f64::EPSILON * (pp * qq).sqrt() {
        return false;
    }
    let zeta = (qq - pp) / (2.0 * pq);
    let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
    let c = 1.0 / t.hypot(1.0);
    let s = c * t;
    for row in columns.iter_mut() {
        (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
    }
    let (a, b) = (directions[p], directions[q]);
    directions[p] = a * c - b * s;
    directions[q] = a * s + b * c;
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solution(rows: &[(DVec3, f64)], rank: f64) -> (DVec3, usize) {
        let terms = singular_terms(rows, rank);
        (terms.values[..terms.count].iter().copied().sum(), terms.count)
    }

    #[test]
    fn a_regular_system_is_solved() {
        let x = DVec3::new(0.3, -2.0, 0.7);
        let normals = [
            DVec3::new(0.6, 0.8, 0.0),
            DVec3::new(0.0, 0.6, 0.8),
            DVec3::new(0.8, 0.0, -0.6),
            DVec3::new(1.0, 0.0, 0.0),
        ];
        let rows: Vec<_> = normals.iter().map(|n| (*n, n.dot(x))).collect();
        let (found, count) = solution(&rows, 1e-14);
        assert_eq!(count, 3);
        assert!(found.distance(x) <= 8.0 * f64::EPSILON * x.length(), "{found}");
    }

    #[test]
    fn a_deficient_system_has_the_shortest_solution() {
        let n = DVec3::new(0.36, 0.48, 0.8);
        let (found, count) = solution(&[(n, 2.0), (n, 4.0), (-n, -3.0)], 1e-14);
        assert_eq!(count, 1);
        assert!(found.distance(n * 3.0) <= 16.0 * f64::EPSILON, "{found}");
        assert_eq!(solution(&[], 1e-14), (DVec3::ZERO, 0));
    }

    #[test]
    fn small_singular_values_keep_their_digits() {
        // the square of this matrix would have lost the small one
        let tilt = 1e-9;
        let rows = [
            (DVec3::Z, 0.0),
            (DVec3::new(tilt, 0.0, 1.0), tilt),
            (DVec3::new(0.0, tilt, 1.0), -tilt),
        ];
        let (found, count) = solution(&rows, 1e-30);
        assert_eq!(count, 3);
        let expected = DVec3::new(1.0, -1.0, 0.0);
        // condition 1e9
        assert!(found.distance(expected) <= 16.0 * f64::EPSILON / tilt, "{found}");
    }
}
