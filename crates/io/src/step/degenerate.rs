//! A triangle as one surface whose side at the first corner has no length.
//!
//! With `u = 1 - s`, `v = s (1 - t)`, `w = s t` the control points of row `a` are those of the triangle
//! with `i = n - a`, a curve of degree `a`, raised to degree `n`.

use bezier_core::MultiIndex;
use bezier_core::binomial;
use glam::DVec3;

/// The control point of row `a`, column `b`.
pub(super) fn point(degree: usize, net: &[DVec3], a: usize, b: usize) -> DVec3 {
    let added = degree - a;
    let weight = |k: usize| binomial(a, k) * binomial(added, b - k) / binomial(degree, b);
    (b.saturating_sub(added)..=a.min(b))
        .map(|k| net[MultiIndex::new(added, a - k, k).rank()] * weight(k))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use bezier_core::bernstein;
    use bezier_core::{Barycentric, QuinticTriangle};

    #[test]
    fn it_is_the_patch() {
        let patch = QuinticTriangle::from_fn(|m| {
            let (x, y) = (m.j as f64, m.k as f64);
            DVec3::new(x + 0.1 * y * y, y - 0.2 * x * y, (x - 2.0 * y).sin())
        });
        for (s, t) in [(0.0, 0.3), (1.0, 0.0), (1.0, 1.0), (0.4, 0.7), (0.8, 0.25)] {
            let (bs, bt): ([f64; 6], [f64; 6]) = (bernstein(s), bernstein(t));
            let terms = (0..6).flat_map(|a| (0..6).map(move |b| (a, b)));
            let found: DVec3 =
                terms.map(|(a, b)| point(5, patch.net(), a, b) * (bs[a] * bt[b])).sum();
            let at = Barycentric::from_array([1.0 - s, s * (1.0 - t), s * t]);
            let distance = found.distance(patch.eval_de_casteljau(at));
            assert!(distance < 16.0 * f64::EPSILON * 8.0, "{s} {t}: {distance}");
        }
    }
}
