//! Polynomials of two variables without a constant term.

use implicit::Number;

/// Largest degree.
pub(crate) const MAX_DEGREE: usize = 4;

/// Number of coefficients up to this degree, without the constant one.
pub(crate) const fn coefficient_count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2 - 1
}

/// Sum of `c_ab x^a y^b` with `1 <= a + b <= degree`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Polynomial {
    degree: usize,
    /// By total degree, then by the power of `y`; the first one is that of `x`.
    coefficients: [f64; coefficient_count(MAX_DEGREE)],
}

impl Polynomial {
    /// From as many coefficients as the degree has.
    pub(crate) fn new(degree: usize, given: &[f64]) -> Self {
        let mut coefficients = [0.0; coefficient_count(MAX_DEGREE)];
        coefficients[..given.len()].copy_from_slice(given);
        Self { degree, coefficients }
    }

    /// Coefficient of `x^a y^b`.
    pub(crate) fn coefficient(&self, a: usize, b: usize) -> f64 {
        let total = a + b;
        self.coefficients[total * (total + 1) / 2 + b - 1]
    }

    /// The powers `x^a y^b` in the order of the coefficients.
    pub(crate) fn monomials(degree: usize, x: f64, y: f64) -> impl Iterator<Item = f64> {
        let power = |base: f64, n: usize| (0..n).fold(1.0, |product, _| product * base);
        (1..=degree)
            .flat_map(move |total| (0..=total).map(move |b| power(x, total - b) * power(y, b)))
    }

    /// The value, with derivatives if the number has them.
    #[inline]
    pub(crate) fn eval<T: Number>(&self, x: T, y: T) -> T {
        let mut sum = T::constant(0.0);
        for a in (0..=self.degree).rev() {
            let lowest = usize::from(a == 0);
            let mut inner = T::constant(0.0);
            for b in (lowest..=self.degree - a).rev() {
                inner = inner * y + self.coefficient(a, b);
            }
            // the constant term is missing
            sum = sum * x + if a == 0 { inner * y } else { inner };
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn horner_agrees_with_monomials() {
        for degree in 1..=MAX_DEGREE {
            let coefficients: Vec<f64> =
                (0..coefficient_count(degree)).map(|k| 1.0 / (k as f64 - 3.5)).collect();
            let polynomial = Polynomial::new(degree, &coefficients);
            let (x, y) = (0.75, -0.625);
            let sum: f64 = Polynomial::monomials(degree, x, y)
                .zip(&coefficients)
                .map(|(power, c)| power * c)
                .sum();
            assert!((polynomial.eval(x, y) - sum).abs() < 1e-14, "degree {degree}");
        }
    }
}
