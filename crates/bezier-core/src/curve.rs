//! Bézier curves with a fixed number of control points.

use crate::bernstein::{bernstein, binomial};
use crate::coefficient::Coefficient;

/// A polynomial curve (or function) of degree `P - 1` over [0, 1] in Bernstein form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BezierCurve<V, const P: usize> {
    /// Control points, in the direction of the parameter.
    pub points: [V; P],
}

/// The curves of this workspace's networks: degree 4.
pub type QuarticCurve<V = glam::DVec3> = BezierCurve<V, 5>;
/// Degree 7: a quartic seen as the boundary of a septic patch.
pub type SepticCurve<V = glam::DVec3> = BezierCurve<V, 8>;

/// Value and first two derivatives of a curve at one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveJet<V> {
    /// Value.
    pub value: V,
    /// First derivative.
    pub first: V,
    /// Second derivative.
    pub second: V,
}

impl<V: Coefficient, const P: usize> BezierCurve<V, P> {
    /// Polynomial degree.
    pub const DEGREE: usize = {
        assert!(P > 0, "a curve has at least one control point");
        P - 1
    };

    /// A curve from its control points.
    #[must_use]
    pub const fn new(points: [V; P]) -> Self {
        Self { points }
    }

    /// Value at `t` by de Casteljau's algorithm; `t` may lie outside [0, 1].
    #[inline]
    #[must_use]
    pub fn eval(&self, t: f64) -> V {
        let mut level = self.points;
        for last in (1..P).rev() {
            for i in 0..last {
                level[i] = V::between(level[i], level[i + 1], t);
            }
        }
        level[0]
    }

    /// Value and first two derivatives at `t`, from the last levels of de Casteljau's algorithm.
    #[must_use]
    pub fn jet(&self, t: f64) -> CurveJet<V> {
        let mut level = self.points;
        let mut jet = CurveJet { value: level[0], first: V::ZERO, second: V::ZERO };
        let degree = Self::DEGREE as f64;
        for last in (0..P).rev() {
            if last == 2 {
                let bend = level[0] - level[1] * 2.0 + level[2];
                jet.second = bend * (degree * (degree - 1.0));
            }
            if last == 1 {
                jet.first = (level[1] - level[0]) * degree;
            }
            for i in 0..last {
                level[i] = V::between(level[i], level[i + 1], t);
            }
        }
        jet.value = level[0];
        jet
    }

    /// Value at `t` as a sum over the Bernstein basis; agrees with [`eval`](Self::eval) to
    /// round-off.
    #[must_use]
    pub fn eval_sum(&self, t: f64) -> V {
        bernstein::<P>(t)
            .into_iter()
            .zip(self.points)
            .fold(V::ZERO, |sum, (weight, point)| sum + point * weight)
    }

    /// The same curve run through backwards. Exact: control points are permuted.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut points = self.points;
        points.reverse();
        Self { points }
    }

    /// The parts before and after `t`, each over [0, 1] again.
    #[must_use]
    pub fn split(&self, t: f64) -> [Self; 2] {
        let mut level = self.points;
        let (mut before, mut after) = (self.points, self.points);
        for last in (0..P).rev() {
            before[P - 1 - last] = level[0];
            after[last] = level[last];
            for i in 0..last {
                level[i] = V::between(level[i], level[i + 1], t);
            }
        }
        [Self { points: before }, Self { points: after }]
    }

    /// The same curve written with degree `Q - 1`, in one step with the weights
    /// `C(d, j) C(e, i - j) / C(d + e, i)`.
    ///
    /// Elevate once and then reverse or copy: elevating the reversed curve sums in another order
    /// and may differ in the last bits.
    #[must_use]
    pub fn elevate_to<const Q: usize>(&self) -> BezierCurve<V, Q> {
        const { assert!(Q >= P, "elevation cannot lower the degree") };
        let (low, high) = (P - 1, Q - 1);
        let points = std::array::from_fn(|i| {
            let first = i.saturating_sub(high - low);
            (first..=i.min(low)).fold(V::ZERO, |sum, j| {
                let weight = binomial(low, j) * binomial(high - low, i - j) / binomial(high, i);
                sum + self.points[j] * weight
            })
        });
        BezierCurve { points }
    }

    /// The forward difference of order `P - 1` of the control points: the leading coefficient.
    #[must_use]
    pub fn top_difference(&self) -> V {
        let mut level = self.points;
        for last in (1..P).rev() {
            for i in 0..last {
                level[i] = level[i + 1] - level[i];
            }
        }
        level[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    const CURVE: QuarticCurve = BezierCurve::new([
        DVec3::new(0.0, 0.0, 0.0),
        DVec3::new(1.0, 2.0, 0.5),
        DVec3::new(2.0, -1.0, 1.0),
        DVec3::new(3.0, 0.5, -2.0),
        DVec3::new(4.0, 1.0, 0.0),
    ]);
    const PARAMETERS: [f64; 6] = [-0.3, 0.0, 0.25, 0.6, 1.0, 1.2];
    const ROUND_OFF: f64 = 64.0 * f64::EPSILON * 8.0;

    #[test]
    fn two_roads_to_a_point() {
        for t in PARAMETERS {
            assert!(CURVE.eval(t).distance(CURVE.eval_sum(t)) <= ROUND_OFF, "t = {t}");
            assert_eq!(CURVE.eval(t), CURVE.jet(t).value, "t = {t}");
        }
        assert_eq!([CURVE.eval(0.0), CURVE.eval(1.0)], [CURVE.points[0], CURVE.points[4]]);
    }

    #[test]
    fn elevation_reversal_and_splitting_keep_the_curve() {
        let elevated: SepticCurve = CURVE.elevate_to();
        let [before, after] = CURVE.split(0.4);
        for t in PARAMETERS {
            let p = CURVE.eval(t);
            assert!(p.distance(elevated.eval(t)) <= ROUND_OFF, "elevated at {t}");
            assert!(p.distance(CURVE.reversed().eval(1.0 - t)) <= ROUND_OFF, "reversed at {t}");
            assert!(CURVE.eval(0.4 * t).distance(before.eval(t)) <= ROUND_OFF, "before at {t}");
            assert!(CURVE.eval(0.4 + 0.6 * t).distance(after.eval(t)) <= ROUND_OFF, "after at {t}");
        }
        assert_eq!(elevated.points[0], CURVE.points[0]);
        assert_eq!(elevated.points[7], CURVE.points[4]);
    }

    #[test]
    fn derivatives_have_observed_order_two() {
        let t = 0.35;
        let jet = CURVE.jet(t);
        let error = |h: f64| {
            let [l, r] = [CURVE.jet(t - h), CURVE.jet(t + h)];
            let first = (r.value - l.value) / (2.0 * h);
            let second = (r.first - l.first) / (2.0 * h);
            [first.distance(jet.first), second.distance(jet.second)]
        };
        let (coarse, fine) = (error(0.02), error(0.01));
        for (c, f) in coarse.into_iter().zip(fine) {
            assert!((c / f).log2() > 1.9, "order {}", (c / f).log2());
        }
    }

    #[test]
    fn top_difference_is_the_leading_coefficient() {
        // t^4 in Bernstein form
        let quartic = BezierCurve::new([0.0, 0.0, 0.0, 0.0, 1.0]);
        assert_eq!(quartic.top_difference(), 1.0);
        let cubic: BezierCurve<f64, 4> = BezierCurve::new([0.0, 0.0, 0.0, 1.0]);
        assert_eq!(cubic.elevate_to::<5>().top_difference(), 0.0);
    }
}
