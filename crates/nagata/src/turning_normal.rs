//! The correction that works for edges of any shape.

mod bounds;

use glam::DVec3;

use crate::along::Along;
use crate::correction::EdgeData;

/// The correction along `N = |t|² m - (m·t) t`, `m` the linearly interpolated normal: orthogonal to
/// the edge whatever the signs of the slopes. \[ours\]
///
/// With `m·t = u(1-u) κ` and `m·s = u(1-u) M`, the derivative across the edge becomes orthogonal to
/// `N` for `Γ = N q / (N·N)`, `q = |t|² M - κ (t·s)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TurningNormal {
    normals: [DVec3; 2],
    /// Bézier coefficients of `t` and `s`.
    tangent: [DVec3; 3],
    across: [DVec3; 3],
    /// `κ` at both ends.
    tilt: [f64; 2],
    /// `M` at both ends.
    twist: [f64; 2],
}

impl TurningNormal {
    #[inline]
    pub(crate) fn new(data: &EdgeData) -> Self {
        let [n_j, n_k] = data.normals;
        // m·x for quadratic x is a cubic; if it vanishes at both ends, the rest is linear
        let inner =
            |[a, b, c]: [DVec3; 3]| [n_j.dot(b) * 2.0 + n_k.dot(a), n_j.dot(c) + n_k.dot(b) * 2.0];
        Self {
            normals: data.normals,
            tangent: data.tangent,
            across: data.across,
            tilt: inner(data.tangent),
            twist: inner(data.across),
        }
    }

    /// `Γ` and its derivatives at `u`; zero where there is no normal.
    #[inline]
    pub(crate) fn at<const K: usize>(&self, u: f64) -> Along<DVec3, K> {
        let m = Along::<DVec3, K>::line(self.normals, u);
        let t = Along::<DVec3, K>::bezier(self.tangent, u);
        let s = Along::<DVec3, K>::bezier(self.across, u);
        let tilt = Along::<f64, K>::line(self.tilt, u);
        let twist = Along::<f64, K>::line(self.twist, u);
        let tt = t.dot(&t);
        let normal = m.times(&tt) - t.times(&m.dot(&t));
        let q = tt.times(&twist) - tilt.times(&t.dot(&s));
        let square = normal.dot(&normal);
        if square.0[0] > 0.0 && square.0[0].is_finite() {
            normal.times(&q.over(&square))
        } else {
            Along::zero()
        }
    }

    /// Whether `|Γ|²` is at most `limit` at the ends and in the middle; no if there is no normal in the middle.
    ///
    /// It is `(M - κ (t·s)/|t|²)² / (|m|² - (m·t)²/|t|²)`; at the ends the divisor is one.
    #[inline]
    pub(crate) fn is_within(&self, limit: f64) -> bool {
        let ([t0, t1, t2], [s0, s1, s2]) = (self.tangent, self.across);
        let ([k0, k1], [m0, m1]) = (self.tilt, self.twist);
        let at_end = |t: DVec3, s: DVec3, tilt: f64, twist: f64| {
            let tt = t.length_squared();
            // an end without a tangent, as at the apex of a cone, has no normal either
            let part = if tt > 0.0 { t.dot(s) / tt } else { 0.0 };
            let length = twist - tilt * part;
            length * length <= limit
        };
        if !(at_end(t0, s0, k0, m0) && at_end(t2, s2, k1, m1)) {
            return false;
        }
        // twice and four times what they are in the middle
        let n = self.normals[0] + self.normals[1];
        let (t, s) = (t0 + t1 * 2.0 + t2, s0 + s1 * 2.0 + s2);
        let tt = t.length_squared();
        let (part, nt) = (t.dot(s) / tt, n.dot(t));
        let length = (m0 + m1) - (k0 + k1) * part;
        let square = n.length_squared() - nt * (nt / tt);
        (tt > 0.0 && square > 0.0 && length * length <= limit * square)
            || (self.twist == [0.0; 2] && self.tilt == [0.0; 2])
    }
}
