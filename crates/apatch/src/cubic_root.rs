//! The cubic along a transversal: its first root, and when that root is simple.

/// A cubic on `[0, 1]` by its Bernstein coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayCubic(pub [f64; 4]);

/// Newton steps, each of which at least halves the bracket in the worst case.
const MAX_STEPS: usize = 100;

impl RayCubic {
    /// Power coefficients, constant first.
    #[inline]
    #[must_use]
    pub fn powers(&self) -> [f64; 4] {
        let [b0, b1, b2, b3] = self.0;
        let (d0, d1, d2) = (b1 - b0, b2 - b1, b3 - b2);
        [b0, 3.0 * d0, 3.0 * (d1 - d0), (d2 - d1) - (d1 - d0)]
    }

    /// Value at `t`.
    #[inline]
    #[must_use]
    pub fn eval(&self, t: f64) -> f64 {
        let [b0, b1, b2, b3] = self.0;
        let s = 1.0 - t;
        s * s * (s * b0 + 3.0 * t * b1) + t * t * (3.0 * s * b2 + t * b3)
    }

    /// The cubic with all signs reversed.
    #[inline]
    #[must_use]
    pub fn negated(self) -> Self {
        Self(self.0.map(|b| -b))
    }

    /// The first root in `[0, 1]` of a cubic that starts below zero; `None` if it stays negative or
    /// does not start there. A zero start is the root 0.
    ///
    /// The monotone piece that first changes sign is found from the critical points, then Newton's
    /// method stays inside a bracket.
    #[inline]
    #[must_use]
    pub fn first_root(&self) -> Option<f64> {
        let [c0, c1, c2, c3] = self.powers();
        if c0 >= 0.0 || c0.is_nan() {
            return (c0 == 0.0).then_some(0.0);
        }
        let (mut low, mut high) = (0.0, 1.0);
        if self.is_single_by_signs() {
            let [root] = quick_roots(&self.0.map(|b| [b]));
            // not a number: not found at once
            return Some(if root > 0.0 { root } else { self.newton(low, high, 0.5) });
        }
        // where the derivative c1 + 2 c2 t + 3 c3 t² vanishes
        let discriminant = c2 * c2 - 3.0 * c1 * c3;
        if discriminant > 0.0 {
            let q = -(c2 + discriminant.sqrt().copysign(c2));
            let (r0, r1) = (q / (3.0 * c3), c1 / q);
            let (r0, r1) = if r0 < r1 { (r0, r1) } else { (r1, r0) };
            let value = |t: f64| c0 + t * (c1 + t * (c2 + t * c3));
            for critical in [r0, r1] {
                if critical > low && critical < high {
                    if value(critical) > 0.0 {
                        high = critical;
                    } else {
                        low = critical;
                    }
                }
            }
        }
        if high == 1.0 && self.0[3] < 0.0 {
            return None;
        }
        let guess = if low == 0.0 && c1 > 0.0 { -c0 / c1 } else { 0.5 * (low + high) };
        Some(self.newton(low, high, guess))
    }

    /// The root between `low` (value not positive) and `high` (value not negative).
    #[inline]
    fn newton(&self, mut low: f64, mut high: f64, guess: f64) -> f64 {
        let [c0, c1, c2, c3] = self.powers();
        let mut t = if guess > low && guess < high { guess } else { 0.5 * (low + high) };
        for _ in 0..MAX_STEPS {
            let value = c0 + t * (c1 + t * (c2 + t * c3));
            if value > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let slope = c1 + t * (2.0 * c2 + t * (3.0 * c3));
            let step = value / slope;
            let newton = t - step;
            if newton >= low && newton <= high {
                // the value after this step, by which the next one would go on
                let rest = step * step * (c2 + c3 * (3.0 * t - step)).abs();
                t = newton;
                if rest <= f64::EPSILON * t * slope.abs() {
                    break;
                }
            } else {
                let middle = 0.5 * (low + high);
                let moved = (middle - t).abs();
                t = middle;
                if moved <= 2.0 * f64::EPSILON * t {
                    break;
                }
            }
        }
        t
    }

    /// The smallest `b*` for which, for every `b > b*`, the first root of `P(t) + b t²` is simple and
    /// inside `(0, 1)`; minus infinity if the cubic does not start below zero.
    ///
    /// With `G(t) = -P(t) / t²` it is the value of `G` at its first local minimum, or at 1: there
    /// `P + b* t²` has a double root. In `r = 1/t` that is the largest root above 1 of
    /// `2 c0 r³ + c1 r² - c3`. Replaces \[XHB01 Lemma 2.3\], which is valid but not sharp. \[ours\]
    #[inline]
    #[must_use]
    pub fn threshold(&self) -> f64 {
        self.threshold_and_place().0
    }

    /// The [`threshold`](Self::threshold), and the `t` of the minimum.
    #[inline]
    pub(crate) fn threshold_and_place(&self) -> (f64, f64) {
        let [c0, c1, c2, c3] = self.powers();
        if c0 >= 0.0 || c0.is_nan() {
            return (f64::NEG_INFINITY, 1.0);
        }
        let r = largest_root_above_one([2.0 * c0, c1, -c3]);
        (-(r * (c0 * r + c1) + c2 + c3 / r), 1.0 / r)
    }

    /// Whether the threshold of a cubic that starts below zero is at most `b` for certain, by a look at
    /// one `t` in `(0, 1]`: there `G` is at most `b`, and it falls all the way there.
    #[inline]
    pub(crate) fn is_threshold_at_most(&self, b: f64, t: f64) -> bool {
        let [c0, c1, c2, c3] = self.powers();
        // G' has the sign of 2 c0 + c1 t - c3 t³: negative at 0, so too before t if convex or rising
        // there, and otherwise below a line
        let bent = c3 * t * t;
        let rise = if bent > 0.0 && c1 < 3.0 * bent { c1.max(0.0) } else { c1 - bent };
        2.0 * c0 + t * rise < 0.0 && c0 + t * (c1 + t * (c2 + b + t * c3)) >= 0.0
    }

    /// Whether the first root is simple for certain: one change of sign of the coefficients.
    #[inline]
    #[must_use]
    pub fn is_single_by_signs(&self) -> bool {
        let [b0, b1, b2, b3] = self.0;
        b0 < 0.0 && b3 > 0.0 && (b1 <= 0.0 || b2 >= 0.0)
    }
}

/// The first roots of several cubics side by side, NaN for none: what [`RayCubic::first_root`] finds
/// for each, bit for bit. The arrays have the coefficients of one degree.
#[inline]
pub(crate) fn first_roots<const N: usize>(cubics: &[[f64; N]; 4]) -> [f64; N] {
    let mut roots = quick_roots(cubics);
    for (i, root) in roots.iter_mut().enumerate() {
        if root.is_nan() {
            *root = RayCubic(cubics.map(|b| b[i])).first_root().unwrap_or(f64::NAN);
        }
    }
    roots
}

/// Halley steps after the first one: on smooth meshes another one changes nothing.
const QUICK_STEPS: usize = 2;

/// The roots of cubics with one change of sign that Halley's method, of order 3, finds from 0 in three
/// steps; NaN for all others.
///
/// All cubics take a step before the next one: a processor that waits for one division can do the
/// others.
#[inline]
fn quick_roots<const N: usize>(cubics: &[[f64; N]; 4]) -> [f64; N] {
    let mut powers = [[0.0; N]; 4];
    let (mut roots, mut rest, mut slopes) = ([0.0; N], [0.0; N], [0.0; N]);
    for i in 0..N {
        let [c0, c1, c2, c3] = RayCubic(cubics.map(|b| b[i])).powers();
        (powers[0][i], powers[1][i], powers[2][i], powers[3][i]) = (c0, c1, c2, c3);
        roots[i] = c0 * c1 / (c0 * c2 - c1 * c1);
    }
    for _ in 0..QUICK_STEPS {
        for i in 0..N {
            let (c0, c1, c2, c3) = (powers[0][i], powers[1][i], powers[2][i], powers[3][i]);
            let t = roots[i];
            let value = c0 + t * (c1 + t * (c2 + t * c3));
            let slope = c1 + t * (2.0 * c2 + t * (3.0 * c3));
            let bend = c2 + 3.0 * c3 * t;
            let step = value * slope / (slope * slope - value * bend);
            // the value after this step
            rest[i] = (value - step * slope) + step * step * (bend - c3 * step);
            (roots[i], slopes[i]) = (t - step, slope);
        }
    }
    for i in 0..N {
        let [b0, b1, b2, b3] = cubics.map(|b| b[i]);
        let t = roots[i];
        // what another step would do
        let certain = rest[i].abs() <= f64::EPSILON * t * slopes[i].abs();
        let single = (b0 < 0.0) & (b3 > 0.0) & ((b1 <= 0.0) | (b2 >= 0.0));
        roots[i] = if single & certain & (t > 0.0) & (t < 1.0) { t } else { f64::NAN };
    }
    roots
}

/// The largest root of `a r³ + b r² + d` that is at least 1, or 1; `a` is negative.
///
/// Newton's method from the right of all roots falls monotonically onto the largest one.
#[inline]
fn largest_root_above_one([a, b, d]: [f64; 3]) -> f64 {
    let value = |r: f64| r * r * (a * r + b) + d;
    // the function falls beyond this point; its only other critical point is 0
    let top = -2.0 * b / (3.0 * a);
    let peak = top.max(1.0);
    if value(peak) <= 0.0 {
        return 1.0;
    }
    // to the right of the root: r² (r - start) is at least d / |a|
    let start = peak.max(b / -a);
    let mut r = start + (d / -a).max(0.0) / (start * start);
    for _ in 0..MAX_STEPS {
        let slope = r * (3.0 * a * r + 2.0 * b);
        let next = r - value(r) / slope;
        if next >= r || next <= peak || next.is_nan() {
            break;
        }
        let moved = r - next;
        r = next;
        if moved <= 4.0 * f64::EPSILON * r {
            break;
        }
    }
    r.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cubic_from_roots(roots: [f64; 3], lead: f64) -> RayCubic {
        let eval = |t: f64| lead * (t - roots[0]) * (t - roots[1]) * (t - roots[2]);
        // the blossom of (t - r0)(t - r1)(t - r2) at (0 or 1, ...)
        let blossom = |u: [f64; 3]| {
            const ORDERS: [[usize; 3]; 6] =
                [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
            let product = |o: [usize; 3]| (0..3).map(|i| u[i] - roots[o[i]]).product::<f64>();
            lead * ORDERS.map(product).iter().sum::<f64>() / 6.0
        };
        let c = RayCubic([
            blossom([0.0; 3]),
            blossom([0.0, 0.0, 1.0]),
            blossom([0.0, 1.0, 1.0]),
            blossom([1.0; 3]),
        ]);
        assert!((c.eval(0.3) - eval(0.3)).abs() < 1e-12, "the blossom is the polynomial");
        c
    }

    proptest! {
        #[test]
        fn planted_roots(first in 0.01..0.9_f64, gap in 0.05..2.0_f64, second in 0.05..2.0_f64) {
            let roots = [first, first + gap, first + gap + second];
            let t = cubic_from_roots(roots, 1.0).first_root().expect("a root");
            prop_assert!((t - first).abs() < 1e-12, "{t} is not {first}");
        }

        #[test]
        fn together_as_one_by_one(numbers in prop::array::uniform32(-2.0..2.0_f64)) {
            // of all sorts: no root, one, some; a start below zero in most
            let mut cubics: [RayCubic; 8] =
                std::array::from_fn(|i| std::array::from_fn(|k| numbers[4 * i + k])).map(RayCubic);
            cubics.iter_mut().skip(2).for_each(|c| c.0[0] = -c.0[0].abs());
            let columns = std::array::from_fn(|degree| cubics.map(|c| c.0[degree]));
            for (found, cubic) in first_roots(&columns).into_iter().zip(&cubics) {
                let alone = cubic.first_root().unwrap_or(f64::NAN);
                prop_assert_eq!(found.to_bits(), alone.to_bits(), "{:?}", cubic);
                prop_assert!(alone.is_nan() || cubic.eval(alone).abs() <= 2e-14, "{:?}", cubic);
            }
        }

        #[test]
        fn the_threshold_is_sharp(
            b0 in -2.0..-0.01_f64, b1 in -1.0..3.0_f64, b2 in -4.0..4.0_f64, b3 in -4.0..4.0_f64,
        ) {
            let plus = |b: f64| RayCubic([b0, b1, b2 + b / 3.0, b3 + b]);
            let b = plus(0.0).threshold();
            let step = 1e-6 * (1.0 + b.abs());
            let root = |b: f64| plus(b).first_root();
            // above it a root that moves little, below it none or one that jumped away
            let above = root(b + step);
            prop_assert!(above.is_some());
            let above = above.unwrap_or(2.0);
            prop_assert!((root(b + 2.0 * step).unwrap_or(2.0) - above).abs() < 0.05);
            if above < 0.98 {
                prop_assert!(root(b - step).is_none_or(|t| t > above + 1e-5));
            }
        }

        #[test]
        fn one_look_never_says_too_much(
            b0 in -2.0..-0.01_f64, b1 in -1.0..3.0_f64, b2 in -4.0..4.0_f64, b3 in -4.0..4.0_f64,
            other in -4.0..4.0_f64, near in 0.3..1.5_f64,
        ) {
            let cubic = RayCubic([b0, b1, b2, b3]);
            let (threshold, place) = cubic.threshold_and_place();
            for t in [(near * place).min(1.0), place] {
                for b in [other, threshold + other.abs()] {
                    if cubic.is_threshold_at_most(b, t) {
                        prop_assert!(threshold <= b + 1e-12 * (1.0 + b.abs()), "{threshold} {b}");
                    }
                }
            }
        }

        #[test]
        fn one_sign_change_needs_no_threshold(
            b0 in -2.0..-0.01_f64, b1 in -1.0..3.0_f64, b2 in -4.0..4.0_f64, b3 in -4.0..4.0_f64,
        ) {
            let cubic = RayCubic([b0, b1, b2, b3]);
            if cubic.is_single_by_signs() {
                prop_assert!(cubic.threshold() <= 1e-12);
            }
        }
    }

    #[test]
    fn starts_that_are_not_negative() {
        assert_eq!(RayCubic([0.0, 1.0, 1.0, 1.0]).first_root(), Some(0.0));
        assert_eq!(RayCubic([0.5, 1.0, 1.0, -1.0]).first_root(), None);
        assert_eq!(RayCubic([-1.0, -0.5, -0.2, -0.1]).first_root(), None);
        assert_eq!(RayCubic([1.0, 0.0, 0.0, 0.0]).threshold(), f64::NEG_INFINITY);
    }

    #[test]
    fn one_look_at_the_right_place_decides() {
        let cubic = RayCubic([-1.0, 0.5, 0.2, 0.0]);
        let (threshold, place) = cubic.threshold_and_place();
        assert!(place < 1.0, "the minimum is inside: {place}");
        assert!(cubic.is_threshold_at_most(threshold + 1e-6, 0.9999 * place), "just above");
        assert!(!cubic.is_threshold_at_most(threshold - 1e-6, 0.9999 * place), "just below");
        assert!(!cubic.is_threshold_at_most(threshold + 1e3, 1.0), "beyond the minimum");
    }

    #[test]
    fn a_line() {
        let t = RayCubic([-1.0, 0.0, 1.0, 2.0]).first_root();
        assert!((t.expect("a root") - 1.0 / 3.0).abs() <= f64::EPSILON, "{t:?}");
    }
}
