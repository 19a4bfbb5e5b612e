//! Interpolation nodes of high degree on a triangle: recursive Lobatto nodes.
//!
//! T. Isaac, "Recursive, parameter-free, explicitly defined interpolation nodes for simplices",
//! SIAM J. Sci. Comput. 42 (2020). A node is a mean of the three nodes of one dimension less that
//! are got by leaving out one coordinate; the weights are Lobatto nodes themselves.

use smoothpatch::bezier_core::{Barycentric, MultiIndex};

/// The Gauss-Lobatto-Legendre nodes of a degree on [0, 1], ascending: ends and extrema of the
/// Legendre polynomial. One node, the middle, for degree 0.
fn lobatto(degree: usize) -> Vec<f64> {
    if degree == 0 {
        return vec![0.5];
    }
    let n = degree as f64;
    let node = |index: usize| {
        let mut x = -(std::f64::consts::PI * index as f64 / n).cos();
        for _ in 0..50 {
            // P(n-1) and P(n) at x
            let (mut before, mut last) = (1.0, x);
            for k in 1..degree {
                let k = k as f64;
                (before, last) = (last, ((2.0 * k + 1.0) * x * last - k * before) / (k + 1.0));
            }
            x -= (x * last - before) / ((n + 1.0) * last);
        }
        0.5 * (x + 1.0)
    };
    (0..=degree).map(node).collect()
}

/// Nodes of a degree in the order of [`MultiIndex`].
pub(super) fn nodes(degree: usize) -> Vec<Barycentric> {
    let lines: Vec<Vec<f64>> = (0..=degree).map(lobatto).collect();
    MultiIndex::all(degree).map(|m| node(&lines, [m.i, m.j, m.k])).collect()
}

fn node(lines: &[Vec<f64>], exponents: [usize; 3]) -> Barycentric {
    let degree: usize = exponents.iter().sum();
    let mut sum = [0.0; 3];
    let mut weights = 0.0;
    for left_out in 0..3 {
        let rest = degree - exponents[left_out];
        let weight = lines[degree][rest];
        for other in (0..3).filter(|&other| other != left_out) {
            sum[other] += weight * lines[rest][exponents[other]];
        }
        weights += weight;
    }
    Barycentric::from_array(sum.map(|x| x / weights))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_nodes_on_a_line() {
        let a = 0.5 * (1.0 - (3.0_f64 / 7.0).sqrt());
        for (x, expected) in lobatto(4).into_iter().zip([0.0, a, 0.5, 1.0 - a, 1.0]) {
            assert!((x - expected).abs() < 1e-15, "{x} {expected}");
        }
    }

    #[test]
    fn edges_carry_the_nodes_of_the_line_and_corners_agree() {
        let line = lobatto(7);
        for (m, at) in MultiIndex::all(7).zip(nodes(7)) {
            assert!((at.u + at.v + at.w - 1.0).abs() < 1e-15, "{m:?}");
            if m.k == 0 {
                assert!(at.w == 0.0 && (at.v - line[m.j]).abs() < 1e-15, "{m:?}");
            }
            // the same when two coordinates change places
            let mirrored = nodes(7)[MultiIndex::new(m.i, m.k, m.j).rank()];
            assert!((at.v - mirrored.w).abs() < 1e-15, "{m:?}");
        }
    }
}
