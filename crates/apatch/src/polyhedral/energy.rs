//! The fairness of a function: the integral of its squared third derivatives, and of their squared
//! jumps.

use glam::DVec3;

use super::dofs::{COUNT, DEGREE};
use crate::bernstein::{indices, rank};
use crate::tetrahedron::Tetrahedron;

/// Indices of degree 2 and 3.
const SECOND: usize = 10;
const THIRD: usize = 20;
/// Weights of a tetrahedron with three points at one corner.
pub(crate) const JUMPS: usize = 6;

/// The quadratic form `wᵀ E w = ∫ |D³F|²` over one tetrahedron, row by row.
///
/// The third derivatives have degree 2: with `w_{i+k}` for indices `i` of degree 2 and `k` of degree 3,
/// `E = 60² ∫B_i B_j (∇_k · ∇_l)`. Zero exactly for quadrics.
pub(crate) fn energy(tetrahedron: &Tetrahedron) -> Vec<f64> {
    let products = third_products(tetrahedron.gradients());
    let volume = tetrahedron.determinant().abs() / 6.0;
    let lower: Vec<[usize; 4]> = indices(DEGREE - 3).collect();
    let upper: Vec<[usize; 4]> = indices(3).collect();
    let place = |i: usize, k: usize| {
        let [a, b] = [lower[i], upper[k]];
        rank([a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]])
    };
    let mut form = vec![0.0; COUNT * COUNT];
    for i in 0..SECOND {
        for j in 0..SECOND {
            let mass = 3600.0 * volume * mass(lower[i], lower[j]);
            for k in 0..THIRD {
                let row = place(i, k) * COUNT;
                for l in 0..THIRD {
                    form[row + place(j, l)] += mass * products[k * THIRD + l];
                }
            }
        }
    }
    form
}

/// The quadratic form `dᵀ J d = h ∫ |jump of D³F|²` over the side of a tetrahedron opposite to corner
/// `off`, for the differences `d` of the weights with three points there; `h` is the height.
///
/// The jump is that of the third derivative along the normal, `60 / h³ Σ d_i B_i` of degree 2. Rows and
/// columns in the order of the indices.
pub(crate) fn jump_energy(tetrahedron: &Tetrahedron, off: usize) -> [[f64; JUMPS]; JUMPS] {
    let height = 1.0 / tetrahedron.gradients()[off].length();
    let area = 0.5 * tetrahedron.determinant().abs() / height;
    let factor = 3600.0 * area / height.powi(5);
    let mut on = indices(DEGREE).filter(|i| i[off] == 3).map(|mut i| {
        i[off] = 0;
        i
    });
    let on: [[usize; 4]; JUMPS] = std::array::from_fn(|_| on.next().unwrap_or_default());
    on.map(|i| on.map(|j| factor * mass(i, j) * 35.0 / 15.0))
}

/// Integral of the product of two Bernstein polynomials of degree 2 over a unit volume.
fn mass(i: [usize; 4], j: [usize; 4]) -> f64 {
    let factorial = |n: usize| (1..=n).product::<usize>() as f64;
    let number = |index: [usize; 4]| {
        let n: usize = index.iter().sum();
        factorial(n) / index.map(factorial).iter().product::<f64>()
    };
    let sum = [0, 1, 2, 3].map(|c| i[c] + j[c]);
    number(i) * number(j) / number(sum) / 35.0
}

/// For each pair of indices of degree 3 the sum of `(g_a·g_d)(g_b·g_e)(g_c·g_f)` over all orders of
/// both.
fn third_products(gradients: [DVec3; 4]) -> Vec<f64> {
    let dot = gradients.map(|a| gradients.map(|b| a.dot(b)));
    let orders: Vec<([usize; 3], usize)> = (0..64)
        .map(|n| [n / 16, n / 4 % 4, n % 4])
        .map(|order| {
            let mut index = [0; 4];
            order.iter().for_each(|&c| index[c] += 1);
            (order, rank(index))
        })
        .collect();
    let mut products = vec![0.0; THIRD * THIRD];
    for ([a, b, c], k) in &orders {
        for ([d, e, f], l) in &orders {
            products[k * THIRD + l] += dot[*a][*d] * dot[*b][*e] * dot[*c][*f];
        }
    }
    products
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Tetrahedron {
        Tetrahedron::new([
            DVec3::new(0.1, 0.0, 0.2),
            DVec3::new(1.0, 0.2, 0.1),
            DVec3::new(0.3, 1.1, 0.0),
            DVec3::new(0.2, 0.3, 0.9),
        ])
    }

    /// Weights of `f` by its blossom at the corners, for a product of five linear functions.
    fn weights(factors: [fn(DVec3) -> f64; DEGREE]) -> Vec<f64> {
        let corners = tetrahedron().corners;
        let mut orders: Vec<Vec<usize>> = vec![Vec::new()];
        for n in 0..DEGREE {
            let longer = |o: &Vec<usize>| {
                (0..=n)
                    .map(|at| {
                        let mut o = o.clone();
                        o.insert(at, n);
                        o
                    })
                    .collect::<Vec<_>>()
            };
            orders = orders.iter().flat_map(longer).collect();
        }
        let blossom = |index: [usize; 4]| {
            let points: Vec<DVec3> =
                (0..4).flat_map(|c| std::iter::repeat_n(corners[c], index[c])).collect();
            let product =
                |o: &Vec<usize>| (0..DEGREE).map(|i| factors[o[i]](points[i])).product::<f64>();
            orders.iter().map(product).sum::<f64>() / orders.len() as f64
        };
        indices(DEGREE).map(blossom).collect()
    }

    fn value(weights: &[f64]) -> f64 {
        let form = energy(&tetrahedron());
        let row = |i: usize| (0..COUNT).map(|j| form[i * COUNT + j] * weights[j]).sum::<f64>();
        (0..COUNT).map(|i| weights[i] * row(i)).sum()
    }

    #[test]
    fn of_a_cubic_and_of_a_quadric() {
        let one: fn(DVec3) -> f64 = |_| 1.0;
        // x y z: all six third derivatives with three different letters are 1
        let cubic = weights([|p| p.x, |p| p.y, |p| p.z, one, one]);
        let volume = tetrahedron().determinant().abs() / 6.0;
        assert!((value(&cubic) - 6.0 * volume).abs() < 1e-9, "{}", value(&cubic));
        let quadric = weights([|p| p.x, |p| p.x + 2.0 * p.y, one, one, one]);
        assert!(value(&quadric).abs() < 1e-9, "{}", value(&quadric));
    }

    #[test]
    fn the_jump_of_a_cube_of_the_height() {
        for off in 0..4 {
            let corners = tetrahedron().corners;
            let height = 1.0 / tetrahedron().gradients()[off].length();
            let [a, b, c] = [1, 2, 3].map(|k| corners[(off + k) % 4]);
            let area = 0.5 * (b - a).cross(c - a).length();
            // the weights of ξ³ with three points at its corner are 1/10
            let difference = height.powi(3) / 10.0;
            let form = jump_energy(&tetrahedron(), off);
            let value = form.iter().flatten().sum::<f64>() * difference * difference;
            assert!((value / (36.0 * area * height) - 1.0).abs() < 1e-12, "{off}: {value}");
        }
    }
}
