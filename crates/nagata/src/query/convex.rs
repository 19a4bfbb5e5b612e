//! Where the squared distance from a point is convex, seen on a piece of a patch.

use bezier_core::PatchJet;
use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::piece::Piece;

/// Relative to its terms: round-off of a second derivative of the squared distance.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

/// Derivatives of `f = |x - p|²/2` at one point of a patch, as if `x` were quadratic there; then `f` has
/// degree four and these are all. Index: how often by the second parameter.
struct Derivatives {
    second: [f64; 3],
    third: [f64; 4],
    fourth: [f64; 5],
}

impl Derivatives {
    fn new(jet: &PatchJet, d: DVec3) -> Self {
        let PatchJet { du, dv, duu, duv, dvv, .. } = *jet;
        Self {
            second: hessian(jet, d),
            third: [
                3.0 * du.dot(duu),
                2.0 * du.dot(duv) + dv.dot(duu),
                2.0 * dv.dot(duv) + du.dot(dvv),
                3.0 * dv.dot(dvv),
            ],
            fourth: [
                3.0 * duu.length_squared(),
                3.0 * duu.dot(duv),
                2.0 * duv.length_squared() + duu.dot(dvv),
                3.0 * duv.dot(dvv),
                3.0 * dvv.length_squared(),
            ],
        }
    }

    /// Bézier coefficient of the Hessian `[uu, uv, vv]`, which is quadratic, for the side from `a` to `b`;
    /// its value at `a` if both are the same.
    fn hessian_coefficient(&self, a: DVec2, b: DVec2) -> [f64; 3] {
        let mean = (a + b) * 0.5;
        let (xx, xy, yy) = (0.5 * a.x * b.x, 0.5 * (a.x * b.y + a.y * b.x), 0.5 * a.y * b.y);
        [0, 1, 2].map(|n| {
            let (t, f) = (&self.third[n..], &self.fourth[n..]);
            self.second[n] + (t[0] * mean.x + t[1] * mean.y) + (f[0] * xx + f[1] * xy + f[2] * yy)
        })
    }
}

/// Second derivatives `[uu, uv, vv]` of `|x - p|²/2`, `d = x - p`.
pub(super) fn hessian(jet: &PatchJet, d: DVec3) -> [f64; 3] {
    [
        jet.du.length_squared() + d.dot(jet.duu),
        jet.du.dot(jet.dv) + d.dot(jet.duv),
        jet.dv.length_squared() + d.dot(jet.dvv),
    ]
}

/// Whether `|x - p|²/2` is convex on a piece for certain; `jet` is that at its centre.
///
/// For the quadratic Taylor polynomial of the patch the Hessian is quadratic: it is positive definite
/// if its six Bézier coefficients are, which no change of the parameters alters. The rest of the patch
/// changes it by what the [`Bounds`] allow.
pub(super) fn is_convex(piece: &Piece, bounds: &Bounds, jet: &PatchJet, p: DVec3) -> bool {
    let d = jet.point - p;
    let derivatives = Derivatives::new(jet, d);
    let [huu, _, hvv] = derivatives.second;
    let squares = jet.du.length_squared() + jet.dv.length_squared();
    let bend = jet.duu.length() + jet.dvv.length() + jet.duv.length();
    let rounded = ROUND_OFF * (squares + (d.length() + jet.point.length()) * bend);
    let margin = rounded + rest(piece, bounds, squares.sqrt(), d.length());
    let definite = |[uu, uv, vv]: [f64; 3]| {
        let (uu, vv) = (uu - margin, vv - margin);
        uu > 0.0 && uu * vv > uv * uv
    };
    if !(huu > margin && hvv > margin) {
        return false;
    }
    let [a, b, c] = piece.corners.map(|q| q - piece.centre());
    [(a, a), (b, b), (c, c), (a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(a, b)| definite(derivatives.hessian_coefficient(a, b)))
}

/// How much the part of the patch beyond its Taylor polynomial changes the Hessian; zero for C0
/// triangles, which have no such part.
fn rest(piece: &Piece, bounds: &Bounds, slope: f64, distance: f64) -> f64 {
    let Bounds { second, third, jump, .. } = *bounds;
    let radius = piece.radius();
    // of the second derivatives, the first ones, and the points
    let r2 = third * radius + jump;
    if r2 == 0.0 {
        return 0.0;
    }
    let (r1, r0) = (r2 * radius, 0.5 * r2 * radius * radius);
    let steepest = slope + second * radius;
    let farthest = distance + (slope + 0.5 * second * radius) * radius;
    r1 * (2.0 * steepest + r1) + r2 * (farthest + r0) + r0 * second
}
