//! The closest point of one patch.

use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::convex::{hessian, is_convex};
use super::piece::{Flat, Piece, closest_weights};
use crate::surface::Patch;

/// Relative to the size of a patch: pieces that might be closer by less are not looked at.
const RESOLUTION: f64 = 1e-10;
/// No piece is smaller than this; its distance to its flat triangle is below round-off.
const SMALLEST_LEG: f64 = 1.0 / (1 << 26) as f64;

/// Parameters and distance of the point of a patch, or of one half of it, that is closest to `p`, if it is not farther than `limit`. `open` is working space.
pub(super) fn closest(
    patch: &Patch,
    flat: &Flat,
    p: DVec3,
    limit: f64,
    open: &mut Vec<(f64, Piece)>,
) -> Option<([f64; 2], f64)> {
    // the size and the round-off of distances
    let far = flat.corners.iter().fold(p.abs(), |far, corner| far.max(corner.abs()));
    let slack = RESOLUTION * flat.size() + 8.0 * f64::EPSILON * far.max_element();
    let mut search = Search { patch, bounds: &flat.bounds, p, best: limit, at: None };
    open.clear();
    let mut next = Some((0.0, Piece::of(flat)));
    while let Some((lower, piece)) = next {
        let out_of_reach = search.at.is_some() && lower + slack >= search.best;
        if !out_of_reach && !search.settles(&piece) && piece.leg >= SMALLEST_LEG {
            let mut parts = piece.parts(patch).map(|part| (search.lower_bound(&part), part));
            // the most promising one last, to be taken first
            parts.sort_by(|a, b| b.0.total_cmp(&a.0));
            open.extend(parts.into_iter().filter(|(lower, _)| *lower <= search.best));
        }
        next = open.pop();
    }
    search.at.map(|at| (at.to_array(), search.best))
}

struct Search<'a> {
    patch: &'a Patch,
    bounds: &'a Bounds,
    p: DVec3,
    best: f64,
    at: Option<DVec2>,
}

impl Search<'_> {
    /// No point of the piece is closer.
    fn lower_bound(&self, piece: &Piece) -> f64 {
        let [a, b, c] = piece.points;
        let [s, t, u] = closest_weights(self.p, piece.points);
        (a * s + b * t + c * u).distance(self.p) - piece.bulge(self.bounds)
    }

    fn offer(&mut self, at: DVec2, distance: f64) {
        if distance < self.best || (self.at.is_none() && distance <= self.best) {
            (self.best, self.at) = (distance, Some(at));
        }
    }

    /// Looks for the minimum of `f = |x - p|²/2` in the piece; whether it is certainly found or not
    /// wanted: `f` is convex there, and `f(q) >= f(at) + ∇f(at)·(q - at)` leaves no room.
    fn settles(&mut self, piece: &Piece) -> bool {
        let [s, t, u] = closest_weights(self.p, piece.points);
        let [a, b, c] = piece.corners;
        let mut at = a * s + b * t + c * u;
        let centre = self.patch.jet(piece.centre().to_array());
        if !is_convex(piece, self.bounds, &centre, self.p) {
            let point = self.patch.point(at.to_array());
            self.offer(at, point.distance(self.p));
            return false;
        }
        for _ in 0..10 {
            let jet = self.patch.jet(at.to_array());
            let d = jet.point - self.p;
            let distance = d.length();
            self.offer(at, distance);
            let gradient = DVec2::new(d.dot(jet.du), d.dot(jet.dv));
            let decrease = piece.corners.map(|q| -gradient.dot(q - at));
            let gap = decrease.into_iter().fold(0.0, f64::max);
            // round-off of the gradient
            let size = jet.du.length().max(jet.dv.length()) * piece.leg;
            let rounded = 8.0 * f64::EPSILON * size * (distance + jet.point.length() + size);
            let too_far = distance * distance - 2.0 * (gap + rounded) > self.best * self.best;
            if gap <= rounded || too_far {
                return true;
            }
            at = newton_step(piece, at, gradient, hessian(&jet, d));
        }
        false
    }
}

/// The minimum in the piece of the quadratic function with this gradient and Hessian at `at`.
fn newton_step(piece: &Piece, at: DVec2, gradient: DVec2, [huu, huv, hvv]: [f64; 3]) -> DVec2 {
    let times = |v: DVec2| DVec2::new(huu * v.x + huv * v.y, huv * v.x + hvv * v.y);
    let determinant = huu * hvv - huv * huv;
    let inner = at
        - DVec2::new(hvv * gradient.x - huv * gradient.y, huu * gradient.y - huv * gradient.x)
            / determinant;
    let [a, b, c] = piece.corners;
    // all pieces have the same shape: inside if on the inner side of each edge
    let inside = |from: DVec2, to: DVec2| {
        (to - from).perp_dot(inner - from) * (b - a).perp_dot(c - a) >= 0.0
    };
    if determinant > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return inner;
    }
    let model = |q: DVec2| gradient.dot(q - at) + 0.5 * (q - at).dot(times(q - at));
    let on_edge = |from: DVec2, to: DVec2| {
        let e = to - from;
        let (slope, bend) = (e.dot(gradient + times(from - at)), e.dot(times(e)));
        let t = if bend > 0.0 { (-slope / bend).clamp(0.0, 1.0) } else { 0.0 };
        if t == 1.0 { to } else { from + e * t }
    };
    let best = [on_edge(a, b), on_edge(b, c), on_edge(c, a)];
    best.into_iter().min_by(|p, q| model(*p).total_cmp(&model(*q))).expect("invariant: three edges")
}
