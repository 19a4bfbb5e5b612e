//! A polynomial along a stretch of a ray, and its roots in order.

/// A polynomial of degree at most 5 on `[0, 1]` by its Bernstein coefficients: what every function
/// of this crate becomes along a straight line, once it is multiplied by its denominator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentPolynomial([f64; 6]);

/// Coefficients from values at `0, 1/5, …, 1`.
const FROM_VALUES: [[f64; 6]; 6] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-77.0 / 60.0, 5.0, -5.0, 10.0 / 3.0, -5.0 / 4.0, 1.0 / 5.0],
    [269.0 / 240.0, -145.0 / 24.0, 295.0 / 24.0, -115.0 / 12.0, 185.0 / 48.0, -77.0 / 120.0],
    [-77.0 / 120.0, 185.0 / 48.0, -115.0 / 12.0, 295.0 / 24.0, -145.0 / 24.0, 269.0 / 240.0],
    [1.0 / 5.0, -5.0 / 4.0, 10.0 / 3.0, -5.0, 5.0, -77.0 / 60.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
];

/// Halvings after which two roots count as one: their distance is then below round-off.
const MAX_DEPTH: usize = 50;

impl SegmentPolynomial {
    /// The polynomial with the values of `f` at `0, 1/5, …, 1`.
    #[must_use]
    pub fn interpolating(f: impl Fn(f64) -> f64) -> Self {
        let values: [f64; 6] = std::array::from_fn(|i| f(i as f64 / 5.0));
        Self(FROM_VALUES.map(|row| row.iter().zip(values).map(|(w, v)| w * v).sum()))
    }

    /// From its Bernstein coefficients, those of degree 3 or 5.
    #[must_use]
    pub(crate) fn from_bernstein(degree: usize, b: &[f64; 6]) -> Self {
        let mut all = *b;
        // each step of raising the degree averages neighbours
        for n in degree..5 {
            for i in (0..=n + 1).rev() {
                let t = i as f64 / (n + 1) as f64;
                let (left, right) = (if i > 0 { all[i - 1] } else { 0.0 }, all[i]);
                all[i] = t * left + (1.0 - t) * if i <= n { right } else { 0.0 };
            }
        }
        Self(all)
    }

    /// Value at `s`.
    #[must_use]
    pub fn eval(&self, s: f64) -> f64 {
        let mut b = self.0;
        for level in (1..6).rev() {
            for i in 0..level {
                b[i] = b[i] * (1.0 - s) + b[i + 1] * s;
            }
        }
        b[0]
    }

    /// The first root in `[0, 1]` that `accept` takes, trying them in order.
    ///
    /// Roots are isolated by the changes of sign of the coefficients, halving where there are
    /// several; a double root is found as one.
    pub fn first_root(&self, mut accept: impl FnMut(f64) -> bool) -> Option<f64> {
        let found = self.search(0.0, 1.0, 0, &mut accept);
        found.or_else(|| (self.0[5] == 0.0 && accept(1.0)).then_some(1.0))
    }

    /// Roots in `[low, high)`; the coefficients are those of that part.
    fn search(
        &self,
        low: f64,
        high: f64,
        depth: usize,
        accept: &mut impl FnMut(f64) -> bool,
    ) -> Option<f64> {
        if self.0[0] == 0.0 && accept(low) {
            return Some(low);
        }
        match self.sign_changes() {
            0 => None,
            1 => {
                let s = low + (high - low) * self.single_root();
                accept(s).then_some(s)
            }
            _ if depth == MAX_DEPTH => accept(low).then_some(low),
            _ => {
                let middle = 0.5 * (low + high);
                let [left, right] = self.halves();
                let found = left.search(low, middle, depth + 1, accept);
                found.or_else(|| right.search(middle, high, depth + 1, accept))
            }
        }
    }

    fn sign_changes(&self) -> usize {
        let mut signs = self.0.iter().filter(|&&b| b != 0.0).map(|b| *b > 0.0);
        let Some(mut last) = signs.next() else { return 0 };
        let mut changes = 0;
        for sign in signs {
            changes += usize::from(sign != last);
            last = sign;
        }
        changes
    }

    fn halves(&self) -> [Self; 2] {
        let mut b = self.0;
        let (mut left, mut right) = ([b[0]; 6], [b[5]; 6]);
        for level in 1..6 {
            for i in 0..6 - level {
                b[i] = 0.5 * (b[i] + b[i + 1]);
            }
            left[level] = b[0];
            right[5 - level] = b[5 - level];
        }
        [Self(left), Self(right)]
    }

    /// The root of a polynomial whose coefficients change sign once, by bisection and secants.
    fn single_root(&self) -> f64 {
        let first = self.0.iter().find(|&&b| b != 0.0).copied().unwrap_or(0.0);
        let (mut low, mut high) = (0.0, 1.0);
        let (mut at_low, mut at_high) = (self.0[0], self.0[5]);
        for step in 0..200 {
            let secant = low + (high - low) * at_low / (at_low - at_high);
            let middle = 0.5 * (low + high);
            let inside = secant > low && secant < high;
            // every third step halves the bracket, whatever the secants do
            let s = if inside && step % 3 != 2 { secant } else { middle };
            if s <= low || s >= high || high - low <= 2.0 * f64::EPSILON * high {
                break;
            }
            let value = self.eval(s);
            if value == 0.0 {
                return s;
            }
            if (value > 0.0) == (first > 0.0) {
                (low, at_low) = (s, value);
            } else {
                (high, at_high) = (s, value);
            }
        }
        if at_low.abs() < at_high.abs() { low } else { high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all_roots(p: &SegmentPolynomial) -> Vec<f64> {
        let mut roots = Vec::new();
        p.first_root(|s| {
            roots.push(s);
            false
        });
        roots
    }

    proptest! {
        #[test]
        fn planted_roots_in_order(
            start in 0.02..0.2_f64, gaps in proptest::collection::vec(0.05..0.3_f64, 4), lead in 0.1..3.0_f64,
        ) {
            let mut planted = vec![start];
            for gap in gaps {
                planted.push(planted[planted.len() - 1] + gap);
            }
            let f = |s: f64| lead * planted.iter().map(|r| s - r).product::<f64>();
            let found = all_roots(&SegmentPolynomial::interpolating(f));
            let expected: Vec<_> = planted.iter().copied().filter(|r| *r < 1.0).collect();
            prop_assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(&expected) {
                prop_assert!((found - expected).abs() < 1e-9, "{} is not {}", found, expected);
            }
        }
    }

    #[test]
    fn ends_and_double_roots() {
        let ends = SegmentPolynomial::interpolating(|s| s * (1.0 - s));
        assert_eq!(all_roots(&ends), [0.0, 1.0]);
        let double = SegmentPolynomial::interpolating(|s| (s - 0.4) * (s - 0.4));
        assert!(all_roots(&double).iter().all(|s| (s - 0.4).abs() < 1e-6), "{double:?}");
        assert!(all_roots(&SegmentPolynomial::interpolating(|s| 1.0 + s)).is_empty());
    }

    #[test]
    fn interpolation_is_exact_for_degree_five() {
        let f = |s: f64| 1.0 - 2.0 * s + s.powi(3) - 0.5 * s.powi(5);
        let p = SegmentPolynomial::interpolating(f);
        for s in [0.0, 0.13, 0.5, 0.77, 1.0] {
            assert!((p.eval(s) - f(s)).abs() < 1e-14, "at {s}");
        }
    }
}
