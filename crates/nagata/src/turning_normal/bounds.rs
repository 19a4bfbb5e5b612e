//! Bounds of a correction and its derivatives along the whole edge.

use bezier_core::{BezierCurve, binomial};
use glam::DVec3;

use super::TurningNormal;

/// How often the edge is halved at most.
const DEPTH: usize = 4;

/// `Γ = N q / (N·N)`, numerator and denominator as polynomials on a part of the edge.
struct Fraction {
    normal: BezierCurve<DVec3, 6>,
    q: BezierCurve<f64, 6>,
}

impl TurningNormal {
    /// Bounds of `|Γ|`, `|Γ'|` and `|Γ''|` on the edge; `None` if its normal (nearly) vanishes somewhere.
    pub(crate) fn bounds(&self) -> Option<[f64; 3]> {
        let (m, t, s) = (&self.normals, &self.tangent, &self.across);
        let tt: [f64; 5] = product(t, t, DVec3::dot);
        let mt: [f64; 4] = product(m, t, DVec3::dot);
        let ts: [f64; 5] = product(t, s, DVec3::dot);
        let scaled = |v: DVec3, factor: f64| v * factor;
        let (a, b): ([DVec3; 6], [DVec3; 6]) = (product(m, &tt, scaled), product(t, &mt, scaled));
        let times = |x: f64, y: f64| x * y;
        let (c, d): ([f64; 6], [f64; 6]) =
            (product(&tt, &self.twist, times), product(&self.tilt, &ts, times));
        let fraction = Fraction {
            normal: BezierCurve::new(std::array::from_fn(|k| a[k] - b[k])),
            q: BezierCurve::new(std::array::from_fn(|k| c[k] - d[k])),
        };
        fraction.bounds(DEPTH)
    }
}

impl Fraction {
    fn bounds(&self, depth: usize) -> Option<[f64; 3]> {
        self.direct().or_else(|| {
            let depth = depth.checked_sub(1)?;
            let [left, right] = self.halves().map(|half| half.bounds(depth));
            // a half of the parameters doubles derivatives
            let ([a0, a1, a2], [b0, b1, b2]) = (left?, right?);
            Some([a0.max(b0), 2.0 * a1.max(b1), 4.0 * a2.max(b2)])
        })
    }

    /// From the control points: with `ν` the length of `N`, at least, and `n₁, n₂, q₀, q₁, q₂` bounds of the
    /// derivatives, `α = n₁/ν`, `β = n₂/ν`,
    ///
    /// ```text
    /// |Γ| <= q₀/ν,   |Γ'| <= (q₁ + 3 α q₀)/ν,   |Γ''| <= (q₂ + 6 α q₁ + (14 α² + 3 β) q₀)/ν
    /// ```
    fn direct(&self) -> Option<[f64; 3]> {
        let axis = self.normal.points.iter().copied().sum::<DVec3>().try_normalize()?;
        let shortest = self.normal.points.iter().map(|n| n.dot(axis)).fold(f64::INFINITY, f64::min);
        let longest = self.normal.points.iter().map(|n| n.length()).fold(0.0, f64::max);
        // control points that lie this much to one side leave the bounds useful
        if shortest <= 0.25 * longest {
            return None;
        }
        let [_, n1, n2] = sizes(&self.normal.points, DVec3::length).map(|n| n / shortest);
        let [q0, q1, q2] = sizes(&self.q.points, f64::abs).map(|q| q / shortest);
        Some([q0, q1 + 3.0 * n1 * q0, q2 + 6.0 * n1 * q1 + (14.0 * n1 * n1 + 3.0 * n2) * q0])
    }

    fn halves(&self) -> [Self; 2] {
        let ([n0, n1], [q0, q1]) = (self.normal.split(0.5), self.q.split(0.5));
        [Self { normal: n0, q: q0 }, Self { normal: n1, q: q1 }]
    }
}

/// Bounds of a polynomial of degree five and its first two derivatives.
fn sizes<V>(points: &[V; 6], size: impl Fn(V) -> f64) -> [f64; 3]
where
    V: Copy + std::ops::Sub<Output = V>,
{
    let first: [V; 5] = std::array::from_fn(|k| points[k + 1] - points[k]);
    let second: [V; 4] = std::array::from_fn(|k| first[k + 1] - first[k]);
    let largest = |all: &[V]| all.iter().map(|v| size(*v)).fold(0.0, f64::max);
    [largest(points), 5.0 * largest(&first), 20.0 * largest(&second)]
}

/// Bernstein coefficients of a product; `N = A + B - 1`.
fn product<X: Copy, Y: Copy, Z, const A: usize, const B: usize, const N: usize>(
    x: &[X; A],
    y: &[Y; B],
    times: impl Fn(X, Y) -> Z,
) -> [Z; N]
where
    Z: Copy + Default + std::ops::Add<Output = Z> + std::ops::Mul<f64, Output = Z>,
{
    let mut sum = [Z::default(); N];
    for (i, &x) in x.iter().enumerate() {
        for (j, &y) in y.iter().enumerate() {
            let weight = binomial(A - 1, i) * binomial(B - 1, j) / binomial(N - 1, i + j);
            sum[i + j] = sum[i + j] + times(x, y) * weight;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bounds hold everywhere on edges of all shapes, and are not much larger than what is reached.
    #[test]
    fn bounds_hold_and_are_of_use() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let (mut bounded, mut tight) = (0, 0);
        for round in 0..300 {
            let bend = [0.1, 0.5, 2.0][round % 3];
            let mut near = |v: DVec3| v + DVec3::new(random(), random(), random()) * bend;
            let turning = TurningNormal {
                normals: [near(DVec3::Z).normalize(), near(DVec3::Z).normalize()],
                tangent: [near(DVec3::X), near(DVec3::X), near(DVec3::X)],
                across: [near(DVec3::Y), near(DVec3::Y), near(DVec3::Y)],
                tilt: [random(), random()],
                twist: [random(), random()],
            };
            let Some(bounds) = turning.bounds() else { continue };
            bounded += 1;
            let mut reached = [0.0_f64; 3];
            for k in 0..=64 {
                let [value, first, half_second] = turning.at::<3>(f64::from(k) / 64.0).0;
                for (most, v) in reached.iter_mut().zip([value, first, half_second * 2.0]) {
                    *most = most.max(v.length());
                }
            }
            for (bound, reached) in bounds.into_iter().zip(reached) {
                assert!(reached <= bound * (1.0 + 1e-12), "{turning:?}: {reached} > {bound}");
            }
            tight += usize::from(bounds[0] <= 4.0 * reached[0]);
        }
        assert!(bounded > 200 && tight > 150, "{bounded} bounded, {tight} of them well");
    }
}
