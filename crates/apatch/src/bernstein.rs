//! Polynomials over a tetrahedron in Bernstein form, of degree at most 5.
//!
//! Weights are ordered by their indices `(i, j, k, l)`, the largest `i` first, then the largest `j`,
//! then the largest `k`. The place of an index does not depend on the degree:
//! with `m = j + k + l` and `s = k + l` it is `m (m + 1) (m + 2) / 6 + s (s + 1) / 2 + l`.

/// Largest degree.
pub(crate) const MAX_DEGREE: usize = 5;
/// Weights of the largest degree.
const MAX_COUNT: usize = count(MAX_DEGREE);

/// Number of weights of a degree.
pub(crate) const fn count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) * (degree + 3) / 6
}

/// Place of an index.
pub(crate) const fn rank([_, j, k, l]: [usize; 4]) -> usize {
    let (m, s) = (j + k + l, k + l);
    m * (m + 1) * (m + 2) / 6 + s * (s + 1) / 2 + l
}

/// All indices of a degree, in order.
pub(crate) fn indices(degree: usize) -> impl Iterator<Item = [usize; 4]> {
    (0..=degree).flat_map(move |m| {
        (0..=m).flat_map(move |s| (0..=s).map(move |l| [degree - m, m - s, s - l, l]))
    })
}

/// For each place below the largest degree, the places with one of the four indices raised.
const RAISED: [[u8; 4]; count(MAX_DEGREE - 1)] = raised();

#[expect(clippy::cast_possible_truncation, reason = "places are below 56")]
const fn raised() -> [[u8; 4]; count(MAX_DEGREE - 1)] {
    let mut table = [[0; 4]; count(MAX_DEGREE - 1)];
    let mut m = 0;
    while m < MAX_DEGREE {
        let mut s = 0;
        while s <= m {
            let mut l = 0;
            while l <= s {
                let i = [0, m - s, s - l, l];
                let at = rank(i);
                table[at][0] = at as u8;
                table[at][1] = rank([0, i[1] + 1, i[2], i[3]]) as u8;
                table[at][2] = rank([0, i[1], i[2] + 1, i[3]]) as u8;
                table[at][3] = rank([0, i[1], i[2], i[3] + 1]) as u8;
                l += 1;
            }
            s += 1;
        }
        m += 1;
    }
    table
}

/// The weights after some steps of de Casteljau's scheme.
#[derive(Clone, Copy)]
pub(crate) struct Net {
    degree: usize,
    weights: [f64; MAX_COUNT],
}

impl Net {
    /// Of the degree that fits the number of weights.
    #[inline]
    pub(crate) fn new(degree: usize, weights: &[f64]) -> Self {
        let mut all = [0.0; MAX_COUNT];
        all[..weights.len()].copy_from_slice(weights);
        Self { degree, weights: all }
    }

    /// One argument of the blossom.
    #[inline]
    pub(crate) fn at(&self, x: [f64; 4]) -> Self {
        let degree = self.degree - 1;
        let mut weights = [0.0; MAX_COUNT];
        for (w, raised) in weights[..count(degree)].iter_mut().zip(&RAISED) {
            let from = |c: usize| x[c] * self.weights[usize::from(raised[c])];
            *w = (from(0) + from(1)) + (from(2) + from(3));
        }
        Self { degree, weights }
    }

    /// The only weight of degree 0.
    #[inline]
    pub(crate) fn value(mut self, x: [f64; 4]) -> f64 {
        while self.degree > 0 {
            self = self.at(x);
        }
        self.weights[0]
    }
}

/// Value and derivatives in barycentric coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Jet {
    pub(crate) value: f64,
    pub(crate) first: [f64; 4],
    pub(crate) second: [[f64; 4]; 4],
}

/// Value, first and second derivatives of a polynomial of degree 2 or more.
#[inline]
pub(crate) fn jet(degree: usize, weights: &[f64], x: [f64; 4]) -> Jet {
    let mut net = Net::new(degree, weights);
    while net.degree > 2 {
        net = net.at(x);
    }
    let n = degree as f64;
    let unit = |a: usize, b: usize| {
        let mut index = [0; 4];
        index[a] += 1;
        index[b] += 1;
        rank(index)
    };
    let second =
        [0, 1, 2, 3].map(|a| [0, 1, 2, 3].map(|b| n * (n - 1.0) * net.weights[unit(a, b)]));
    let linear = net.at(x);
    let first = [0, 1, 2, 3].map(|a| n * linear.weights[a]);
    Jet { value: linear.at(x).weights[0], first, second }
}

/// Bernstein coefficients along the line from `x` to `u`.
#[inline]
pub(crate) fn along(
    degree: usize,
    weights: &[f64],
    x: [f64; 4],
    u: [f64; 4],
) -> [f64; MAX_DEGREE + 1] {
    let mut coefficients = [0.0; MAX_DEGREE + 1];
    let mut net = Net::new(degree, weights);
    for (l, b) in coefficients.iter_mut().enumerate().take(degree + 1) {
        if l > 0 {
            net = net.at(u);
        }
        *b = net.value(x);
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_in_order() {
        for degree in 0..=MAX_DEGREE {
            let ranks: Vec<usize> = indices(degree).map(rank).collect();
            assert_eq!(ranks, (0..count(degree)).collect::<Vec<_>>(), "degree {degree}");
            assert!(indices(degree).all(|i| i.iter().sum::<usize>() == degree), "sums");
        }
    }

    #[test]
    fn a_power_of_a_linear_function() {
        // (1 x + 2 y - z + 3 w)^n has the weights 1^i 2^j (-1)^k 3^l
        let (c, x) = ([1.0_f64, 2.0, -1.0, 3.0], [0.1_f64, 0.4, -0.3, 0.8]);
        let int = |n: usize| i32::try_from(n).expect("a small number");
        let at = |x: [f64; 4]| (0..4).map(|i| c[i] * x[i]).sum::<f64>();
        for degree in 2..=MAX_DEGREE {
            let power = |i: [usize; 4]| (0..4).map(|a| c[a].powi(int(i[a]))).product::<f64>();
            let weights: Vec<f64> = indices(degree).map(power).collect();
            let (n, f) = (int(degree), at(x));
            let jet = jet(degree, &weights, x);
            let near = |a: f64, b: f64| (a - b).abs() < 1e-12 * 3_f64.powi(n);
            assert!(near(jet.value, f.powi(n)), "degree {degree}: value {}", jet.value);
            for a in 0..4 {
                assert!(near(jet.first[a], f64::from(n) * c[a] * f.powi(n - 1)), "slope {a}");
                for b in 0..4 {
                    let second = f64::from(n * (n - 1)) * c[a] * c[b] * f.powi(n - 2);
                    assert!(near(jet.second[a][b], second), "second {a} {b}");
                }
            }
            let u = [0.0, 0.5, 0.5, 0.0];
            let line = along(degree, &weights, x, u);
            for (l, b) in line.iter().enumerate().take(degree + 1) {
                let expected = f.powi(n - int(l)) * at(u).powi(int(l));
                assert!(near(*b, expected), "degree {degree}, coefficient {l}");
            }
        }
    }
}
