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

    /// The greatest length at the ends and in the middle; infinite if there is no normal in the
    /// middle.
    pub(crate) fn longest(&self) -> f64 {
        let at_end = |at: usize, end: usize| {
            let t = self.tangent[at];
            let tt = t.length_squared();
            // an end without a tangent, as at the apex of a cone, has no normal either
            let part = if tt > 0.0 { t.dot(self.across[at]) / tt } else { 0.0 };
            (self.twist[end] - self.tilt[end] * part).abs()
        };
        let [a, b] = self.normals;
        let [t0, t1, t2] = self.tangent;
        let normal_in_the_middle = (a + b).cross(t0 + t1 * 2.0 + t2);
        let needed = self.twist != [0.0; 2] || self.tilt != [0.0; 2];
        if normal_in_the_middle == DVec3::ZERO && needed {
            return f64::INFINITY;
        }
        let Along([middle]) = self.at::<1>(0.5);
        middle.length().max(at_end(0, 0)).max(at_end(2, 1))
    }
}
