//! Motions of three control points that bring a patch closer to the surface, along normals.

use bezier_core::glam::DVec3;

use crate::samples::{Columns, Feet, PAIRS, SAMPLES};

/// Along the surface's normals: damped least squares over nine unknowns, `damping` being a fraction
/// of the mean diagonal of the normal equations, which the damping keeps well conditioned.
pub(crate) fn point_to_plane(columns: &Columns, feet: &Feet, damping: f64) -> Option<[DVec3; 3]> {
    let Feet { normals, distances } = feet;
    // sums of c_a c_b n nᵀ for each pair of control points: entries xx, xy, xz and yy, yz, zz
    let x_rows: [DVec3; 6] = columns.pair_sums.to_array(&normals.map(|n| n * n.x));
    let other_rows: [DVec3; 6] =
        columns.pair_sums.to_array(&normals.map(|n| DVec3::new(n.y * n.y, n.y * n.z, n.z * n.z)));
    let mut matrix = [[0.0; 9]; 9];
    for (pair, [a, b]) in PAIRS.into_iter().enumerate() {
        let sums = x_rows[pair].to_array().into_iter().chain(other_rows[pair].to_array());
        for (sum, [x, y]) in sums.zip(PAIRS) {
            for (row, column) in [(3 * a + x, 3 * b + y), (3 * a + y, 3 * b + x)] {
                matrix[row][column] = sum;
                matrix[column][row] = sum;
            }
        }
    }
    let trace: f64 = (0..9).map(|d| matrix[d][d]).sum();
    for (d, row) in matrix.iter_mut().enumerate() {
        row[d] += damping * trace / 9.0;
    }
    let pulls: [DVec3; SAMPLES] = std::array::from_fn(|j| normals[j] * distances[j]);
    let pulls: [DVec3; 3] = columns.sums.to_array(&pulls);
    let x = solve_definite(matrix, std::array::from_fn(|i| pulls[i / 3][i % 3]))?;
    Some([0, 3, 6].map(|i| DVec3::new(x[i], x[i + 1], x[i + 2])))
}

/// Along the mean normal of the feet: three unknowns.
pub(crate) fn along_mean_normal(columns: &Columns, feet: &Feet) -> Option<[DVec3; 3]> {
    let direction = feet.normals.iter().sum::<DVec3>().try_normalize()?;
    let mut matrix = [[0.0; 3]; 3];
    let mut pulls = [0.0; 3];
    for (j, (normal, distance)) in feet.normals.iter().zip(feet.distances).enumerate() {
        let lean = normal.dot(direction);
        let row = [0, 1, 2].map(|c| columns.values[c][j] * lean);
        for [a, b] in PAIRS {
            matrix[a][b] += row[a] * row[b];
        }
        for (pull, entry) in pulls.iter_mut().zip(row) {
            *pull += entry * distance;
        }
    }
    for [a, b] in PAIRS {
        matrix[b][a] = matrix[a][b];
    }
    Some(solve_definite(matrix, pulls)?.map(|step| direction * step))
}

/// Solves a symmetric positive definite system by elimination, which needs no pivoting there;
/// `None` if it is not definite.
fn solve_definite<const N: usize>(mut matrix: [[f64; N]; N], mut x: [f64; N]) -> Option<[f64; N]> {
    for k in 0..N {
        let pivot_row = matrix[k];
        if pivot_row[k].is_nan() || pivot_row[k] <= 0.0 {
            return None;
        }
        for i in k + 1..N {
            let factor = matrix[i][k] / pivot_row[k];
            for (entry, above) in matrix[i][k..].iter_mut().zip(&pivot_row[k..]) {
                *entry -= factor * above;
            }
            x[i] -= factor * x[k];
        }
    }
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|j| matrix[k][j] * x[j]).sum();
        x[k] = (x[k] - known) / matrix[k][k];
    }
    x.iter().all(|v| v.is_finite()).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definite_systems() {
        let matrix = [[4.0, 1.0, -2.0], [1.0, 3.0, 0.5], [-2.0, 0.5, 5.0]];
        let expected = [1.0, -2.0, 0.25];
        let rhs = matrix.map(|row| row.iter().zip(expected).map(|(a, x)| a * x).sum());
        let x = solve_definite(matrix, rhs).unwrap();
        for (got, expected) in x.into_iter().zip(expected) {
            assert!((got - expected).abs() <= 1e-15, "{got} for {expected}");
        }
        for bad in [-1.0, 0.0, f64::NAN] {
            assert_eq!(solve_definite([[bad]], [1.0]), None, "pivot {bad}");
        }
        assert_eq!(solve_definite([[1.0, 2.0], [2.0, 1.0]], [1.0, 1.0]), None, "indefinite");
    }
}
