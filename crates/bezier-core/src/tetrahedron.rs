//! Trivariate Bernstein form over a tetrahedron.

use crate::bernstein::binomial;
use crate::coefficient::Coefficient;
use crate::multi_index::MultiIndex;

/// Exponents of the four barycentric coordinates; their sum is the degree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TetrahedralIndex(pub [usize; 4]);

impl TetrahedralIndex {
    /// Number of indices of this degree.
    #[must_use]
    pub const fn count(degree: usize) -> usize {
        (degree + 1) * (degree + 2) * (degree + 3) / 6
    }

    /// Position in the coefficient array: layers by `l = degree - first exponent`, each layer a
    /// triangle of degree `l` in the order of [`MultiIndex`]. Like there, the rank does not contain
    /// the degree.
    #[must_use]
    pub const fn rank(self) -> usize {
        let [_, j, k, l] = self.0;
        let layer = j + k + l;
        let before = layer * (layer + 1) * (layer + 2) / 6;
        before + MultiIndex::new(j, k, l).rank()
    }

    /// All indices of this degree, by rank.
    pub fn all(degree: usize) -> impl Iterator<Item = Self> {
        (0..=degree).flat_map(move |layer| {
            MultiIndex::all(layer).map(move |m| Self([degree - layer, m.i, m.j, m.k]))
        })
    }
}

/// A polynomial over a tetrahedron in Bernstein form, with `P` coefficients.
///
/// `P` must be a tetrahedral number; the degree follows from it. Parameters are the four
/// barycentric coordinates, which add up to one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct BezierTetrahedron<V, const P: usize> {
    net: [V; P],
}

/// Degree 3 with scalar coefficients.
pub type CubicTetrahedron<V = f64> = BezierTetrahedron<V, 20>;
/// Degree 5 with scalar coefficients.
pub type QuinticTetrahedron<V = f64> = BezierTetrahedron<V, 56>;

impl<V: Coefficient, const P: usize> BezierTetrahedron<V, P> {
    /// Polynomial degree.
    pub const DEGREE: usize = {
        let mut degree = 0;
        while TetrahedralIndex::count(degree) < P {
            degree += 1;
        }
        assert!(
            TetrahedralIndex::count(degree) == P,
            "the number of coefficients is not tetrahedral"
        );
        degree
    };

    /// From coefficients ordered by [`TetrahedralIndex::rank`].
    #[must_use]
    pub const fn new(net: [V; P]) -> Self {
        Self { net }
    }

    /// From a coefficient for each index.
    #[must_use]
    pub fn from_fn(mut f: impl FnMut(TetrahedralIndex) -> V) -> Self {
        let mut net = [V::ZERO; P];
        for index in TetrahedralIndex::all(Self::DEGREE) {
            net[index.rank()] = f(index);
        }
        Self { net }
    }

    /// Coefficients by rank.
    #[must_use]
    pub const fn net(&self) -> &[V; P] {
        &self.net
    }

    /// The coefficient of an index.
    #[must_use]
    pub fn coefficient(&self, index: TetrahedralIndex) -> V {
        self.net[index.rank()]
    }

    /// The four values left after all levels of de Casteljau's algorithm but one; the value at
    /// `at` is their combination with weights `at`, the derivative from corner `a` to corner `b` is
    /// `degree * (value_b - value_a)`.
    #[must_use]
    pub fn last_tetrahedron(&self, at: [f64; 4]) -> [V; 4] {
        const { assert!(Self::DEGREE >= 1, "constants have no last tetrahedron") };
        let low = Self::DEGREE - 1;
        let mut last = [V::ZERO; 4];
        for TetrahedralIndex(m) in TetrahedralIndex::all(low) {
            let weight = (0..4).fold(multinomial(m), |product, c| {
                (0..m[c]).fold(product, |product, _| product * at[c])
            });
            for (corner, value) in last.iter_mut().enumerate() {
                let mut raised = m;
                raised[corner] += 1;
                *value = *value + self.net[TetrahedralIndex(raised).rank()] * weight;
            }
        }
        last
    }

    /// Value at these barycentric coordinates; they may lie outside the tetrahedron.
    #[must_use]
    pub fn eval(&self, at: [f64; 4]) -> V {
        let last = self.last_tetrahedron(at);
        (0..4).fold(V::ZERO, |sum, c| sum + last[c] * at[c])
    }
}

fn multinomial([i, j, k, l]: [usize; 4]) -> f64 {
    binomial(i + j + k + l, i) * binomial(j + k + l, j) * binomial(k + l, k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rank_runs_through_all() {
        for degree in 0..6 {
            let ranks: Vec<_> = TetrahedralIndex::all(degree).map(TetrahedralIndex::rank).collect();
            assert_eq!(ranks, (0..TetrahedralIndex::count(degree)).collect::<Vec<_>>());
        }
    }

    #[test]
    fn linear_precision_and_quadratic_reproduction() {
        let at = [0.1, 0.45, -0.2, 0.65];
        let linear = CubicTetrahedron::from_fn(|TetrahedralIndex([i, j, k, l])| {
            (i as f64 - 2.0 * j as f64 + 3.0 * k as f64 + 0.5 * l as f64) / 3.0
        });
        let expected = at[0] - 2.0 * at[1] + 3.0 * at[2] + 0.5 * at[3];
        assert!((linear.eval(at) - expected).abs() <= 16.0 * f64::EPSILON);
        // the square of the first coordinate has the coefficients i (i - 1) / (n (n - 1))
        let square = QuinticTetrahedron::from_fn(|TetrahedralIndex([i, ..])| {
            (i * i.saturating_sub(1)) as f64 / 20.0
        });
        assert!((square.eval(at) - at[0] * at[0]).abs() <= 64.0 * f64::EPSILON);
        let [a, b, ..] = square.last_tetrahedron(at);
        assert!(
            (5.0 * (a - b) - 2.0 * at[0]).abs() <= 64.0 * f64::EPSILON,
            "directional derivative"
        );
    }
}
