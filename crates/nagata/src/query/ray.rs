//! Where a ray meets one patch.

use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::piece::{Aabb, Flat, Piece};
use crate::surface::Patch;

/// Pieces are not made smaller: what is left there is a tangent ray.
const SMALLEST_LEG: f64 = 1.0 / (1 << 20) as f64;
/// Round-off of points, relative to their coordinates.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

/// The points `origin + direction * t` with `t >= 0`; the direction need not have length one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; not zero.
    pub direction: DVec3,
}

impl Ray {
    /// The point at parameter `t`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// Whether all numbers are finite and the direction is not zero.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.origin.is_finite()
            && self.direction.is_finite()
            && self.direction.length_squared() > 0.0
            && self.direction.length_squared().is_finite()
    }

    /// Round-off of positions as large as this point and the origin.
    pub(super) fn round_off(&self, point: DVec3) -> f64 {
        ROUND_OFF * point.abs().max(self.origin.abs()).max_element()
    }

    fn parameter(&self, point: DVec3) -> f64 {
        (point - self.origin).dot(self.direction) / self.direction.length_squared()
    }
}

/// Hands over parameters on the patch and on the ray of all hits of a patch, or of one half of it,
/// with `t` in `[0, to]`, in no order; one that lies on the border of pieces may appear more than once.
pub(super) fn hits(
    patch: &Patch,
    flat: &Flat,
    ray: &Ray,
    to: f64,
    mut take: impl FnMut([f64; 2], f64),
) {
    let x =
        (ray.direction / ray.direction.abs().max_element()).normalize().any_orthonormal_vector();
    let y = ray.direction.cross(x).normalize_or_zero();
    let bounds = &flat.bounds;
    let cast = Cast { patch, bounds, ray, plane: [x, y] };
    let mut open: Vec<Piece> = Vec::new();
    let mut next = Some(Piece::of(flat));
    while let Some(piece) = next.take().or_else(|| open.pop()) {
        let bulge = piece.bulge(bounds) + ray.round_off(piece.points[0]);
        if Aabb::around(piece.points).grown(bulge).entry(ray, 0.0, to).is_none() {
            continue;
        }
        let last = piece.leg < SMALLEST_LEG;
        let certain = cast.at_most_one(&piece);
        if last || certain {
            let hit = cast.hit(&piece, certain).filter(|(_, t)| (0.0..=to).contains(t));
            hit.into_iter().for_each(|(at, t)| take(at, t));
        } else if !cast.runs_inside(&piece) {
            open.extend(piece.parts(patch));
        }
    }
}

struct Cast<'a> {
    patch: &'a Patch,
    bounds: &'a Bounds,
    ray: &'a Ray,
    /// Unit vectors orthogonal to the ray and to each other.
    plane: [DVec3; 2],
}

impl Cast<'_> {
    /// Seen along the ray.
    fn seen(&self, v: DVec3) -> DVec2 {
        DVec2::new(v.dot(self.plane[0]), v.dot(self.plane[1]))
    }

    /// Whether the piece seen along the ray cannot cover a point twice, with a margin that lets Newton's
    /// iteration converge from anywhere in it.
    fn at_most_one(&self, piece: &Piece) -> bool {
        let jet = self.patch.jet(piece.centre().to_array());
        let (a, b) = (self.seen(jet.du), self.seen(jet.dv));
        let (sum, determinant) = (a.length_squared() + b.length_squared(), a.perp_dot(b).abs());
        // product and squared sum of the singular values
        let largest =
            (0.5 * (sum + (sum * sum - 4.0 * determinant * determinant).max(0.0).sqrt())).sqrt();
        largest > 0.0 && determinant / largest > 4.0 * self.bounds.second * piece.radius()
    }

    /// Whether the piece is flat and the ray runs in its plane.
    fn runs_inside(&self, piece: &Piece) -> bool {
        let [a, b, c] = piece.points;
        let (e, f) = (self.seen(b - a), self.seen(c - a));
        let size = a.distance(b).max(a.distance(c));
        piece.bulge(self.bounds) <= self.ray.round_off(a)
            && e.perp_dot(f).abs() <= ROUND_OFF * size * size
    }

    /// Newton's iteration, kept in the piece; `None` if the ray passes it.
    ///
    /// If `certain`, the distance to a hit in the piece becomes 2/3 at most in each step, and no step is
    /// longer than 5/3 of it: longer steps show that there is none.
    fn hit(&self, piece: &Piece, certain: bool) -> Option<([f64; 2], f64)> {
        let mut at = piece.centre();
        let mut longest = if certain { piece.radius() * (5.0 / 3.0) } else { f64::INFINITY };
        for _ in 0..60 {
            let jet = self.patch.jet(at.to_array());
            let miss = self.seen(jet.point - self.ray.origin);
            if miss.length() <= self.ray.round_off(jet.point) {
                return Some((at.to_array(), self.ray.parameter(jet.point)));
            }
            let (a, b) = (self.seen(jet.du), self.seen(jet.dv));
            let determinant = a.perp_dot(b);
            let step = DVec2::new(miss.perp_dot(b), a.perp_dot(miss)) / determinant;
            let next = piece.nearest_parameter(at - step);
            // round-off of the points moves the parameters
            let noise =
                self.ray.round_off(jet.point) * a.length().max(b.length()) / determinant.abs();
            let too_long = step.length() > longest + noise;
            longest *= 2.0 / 3.0;
            if !next.is_finite() || next == at || too_long {
                return None;
            }
            at = next;
        }
        None
    }
}
