//! The free weight of a face tetrahedron.

use glam::DVec3;

use super::apex::FaceFrame;
use super::base::{BaseLayer, others};
use super::face::{FaceSide, dot};
use super::settings::FreeWeightRule;
use crate::tetrahedron::gradient;

/// Weight of the pull towards the published value, relative to the square of the height: decides
/// only what the neighbours leave open.
const PULL: f64 = 1e-10;

/// A vertex with its gradient.
pub(crate) type Datum = (DVec3, DVec3);

/// The quadric that fits layers 0 and 1 best, but for the weight at the apex.
struct FittedQuadric {
    /// `V_a V_a`, `V_a V_b` (by opposite corner), `V_a apex`.
    squares: [f64; 3],
    mixed: [f64; 3],
    up: [f64; 3],
}

impl FittedQuadric {
    /// Closed form of the least-squares fit with equal weights \[XHB01 (4.13)\]*.
    fn new(base: &BaseLayer, side: &FaceSide) -> Self {
        let e = |a: usize, b: usize| base.edge_weight(a, b);
        let (v, l) = (&side.l1v, &side.l1e);
        let g = base.middle_weights().iter().sum::<f64>() / 3.0;
        let square = |a: usize| {
            let [b, c] = others(a);
            (15.0 * (e(a, b) + e(a, c)) + 9.0 * v[a]
                - 7.0 * (e(b, a) + e(c, a) + g)
                - 9.0 * (l[b] + l[c])
                + 3.0 * l[a]
                + (e(b, c) + e(c, b))
                + 3.0 * (v[b] + v[c]))
                / 80.0
        };
        let mixed = |c: usize| {
            let [a, b] = others(c);
            (49.0 * (e(a, b) + e(b, a)) + 21.0 * l[c] - 9.0 * (v[a] + v[b]) + 23.0 * g
                - 7.0 * (e(a, c) + e(b, c))
                - 3.0 * (e(c, a) + e(c, b))
                - 3.0 * (l[a] + l[b])
                + 3.0 * v[c])
                / 80.0
        };
        Self {
            squares: std::array::from_fn(square),
            mixed: std::array::from_fn(mixed),
            up: side.fitted,
        }
    }

    /// Value and derivatives at barycentric coordinates.
    fn jet(&self, at: [f64; 4]) -> (f64, [f64; 4]) {
        let [x0, x1, x2, w] = at;
        let (s, m, u) = (&self.squares, &self.mixed, &self.up);
        let half = [
            x0 * s[0] + x1 * m[2] + x2 * m[1] + w * u[0],
            x1 * s[1] + x2 * m[0] + x0 * m[2] + w * u[1],
            x2 * s[2] + x0 * m[1] + x1 * m[0] + w * u[2],
            dot([x0, x1, x2], *u),
        ];
        let value = x0 * half[0] + x1 * half[1] + x2 * half[2] + w * half[3];
        (value, half.map(|h| 2.0 * h))
    }
}

/// The weight at the apex for which the fitted quadric comes closest to the values (zero) and
/// gradients at the vertices opposite to the edges; the published value without any. \[ours\]
pub(crate) fn neighbour_fit(
    base: &BaseLayer,
    side: &FaceSide,
    frame: &FaceFrame,
    opposite: &[Option<Datum>],
) -> f64 {
    let quadric = FittedQuadric::new(base, side);
    let tetrahedron = side.tetrahedron(&frame.corners);
    let gradients = tetrahedron.gradients();
    let height = (side.apex - frame.centroid).dot(frame.normal);
    let pull = PULL / (height * height);
    let published = side.published(base);
    let (mut products, mut squares) = (0.0, 0.0);
    for &(point, normal) in opposite.iter().flatten() {
        let at = tetrahedron.barycentric_by(&gradients, point);
        let (value, slopes) = quadric.jet(at);
        // residual and its derivative with respect to the weight, which multiplies w²
        let (r, c) = (value / frame.size, at[3] * at[3] / frame.size);
        let (rest, turn) = (gradient(slopes, &gradients) - normal, gradients[3] * (2.0 * at[3]));
        products += r * c + rest.dot(turn);
        squares += c * c + turn.length_squared();
    }
    if squares == 0.0 {
        return published;
    }
    (pull * published - products) / (pull + squares)
}

/// The free weight times the sign of the side, before any bound.
pub(crate) fn wanted(base: &BaseLayer, side: &FaceSide, sign: f64, rule: FreeWeightRule) -> f64 {
    let published = sign * side.published(base);
    match rule {
        FreeWeightRule::Published => published,
        FreeWeightRule::Clamped => (sign * side.neighbours).max(0.5 * published),
    }
}

/// The least free weight that a bound allows; `margin` is the distance kept from it.
#[inline]
pub(crate) fn least(bound: f64, margin: f64, scale: f64) -> f64 {
    bound + margin * scale
}

/// Applies a tension and the bound.
pub(crate) fn bounded(wanted: f64, bound: f64, margin: f64, scale: f64, tension: f64) -> f64 {
    let least = least(bound, margin, scale);
    let tensed = if tension > 0.0 {
        wanted + tension * scale
    } else if wanted > least && least.is_finite() {
        wanted + tension * (wanted - least)
    } else {
        wanted
    };
    tensed.max(least)
}
