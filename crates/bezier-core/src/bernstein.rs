//! Univariate Bernstein polynomials and binomial coefficients.

/// Largest degree for which [`binomial`] is tabulated.
pub const MAX_DEGREE: usize = 24;

const BINOMIALS: [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] = {
    let mut table = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut n = 0;
    while n <= MAX_DEGREE {
        table[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    table
};

/// Binomial coefficient `n` over `k`, exact; zero for `k > n`.
///
/// # Panics
///
/// If `n` or `k` exceeds [`MAX_DEGREE`].
#[inline]
#[must_use]
pub const fn binomial(n: usize, k: usize) -> f64 {
    BINOMIALS[n][k]
}

/// Values of the `P` Bernstein polynomials of degree `P - 1` at `t`.
///
/// They are positive inside (0, 1) and add up to one; `t` may lie outside.
#[inline]
#[must_use]
pub const fn bernstein<const P: usize>(t: f64) -> [f64; P] {
    let mut values = [0.0; P];
    values[0] = 1.0;
    let mut degree = 1;
    while degree < P {
        let mut k = degree;
        while k > 0 {
            values[k] = values[k] * (1.0 - t) + values[k - 1] * t;
            k -= 1;
        }
        values[0] *= 1.0 - t;
        degree += 1;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn binomials() {
        assert_eq!([binomial(7, 0), binomial(7, 3), binomial(7, 7)], [1.0, 35.0, 1.0]);
        assert_eq!(binomial(3, 5), 0.0);
        assert_eq!(binomial(24, 12), 2_704_156.0);
    }

    #[test]
    fn partition_of_unity_inside_and_outside() {
        for t in [-0.5, 0.0, 0.3, 1.0, 1.7] {
            let b = bernstein::<8>(t);
            let size: f64 = b.iter().map(|x| x.abs()).sum();
            assert!((b.iter().sum::<f64>() - 1.0).abs() <= 8.0 * f64::EPSILON * size, "t = {t}");
        }
    }

    #[test]
    fn agrees_with_the_definition() {
        let t: f64 = 0.37;
        for (k, value) in bernstein::<6>(t).into_iter().enumerate() {
            let power = i32::try_from(k).unwrap();
            let expected = binomial(5, k) * t.powi(power) * (1.0 - t).powi(5 - power);
            assert!((value - expected).abs() <= 8.0 * f64::EPSILON, "k = {k}");
        }
    }
}
