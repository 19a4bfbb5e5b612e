//! Boxes, and pieces of patches.

use std::hint::black_box;

use basemesh::FaceId;
use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::ray::Ray;
use crate::quad::NagataQuad;
use crate::surface::Patch;
use crate::triangle::NagataTriangle;

/// A box with sides parallel to the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lowest coordinates.
    pub low: DVec3,
    /// Highest coordinates.
    pub high: DVec3,
}

impl Aabb {
    pub(super) const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The smallest box around points.
    pub(super) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |all, p| all.with(&Self { low: p, high: p }))
    }

    pub(super) fn with(&self, other: &Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(super) fn grown(&self, by: f64) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }

    pub(super) fn size(&self) -> f64 {
        self.low.distance(self.high)
    }

    /// Where a ray enters, at `from` at the earliest; `None` if it does not before `to`.
    #[inline]
    pub(super) fn entry(&self, ray: &Ray, from: f64, to: f64) -> Option<f64> {
        let (mut first, mut last) = (from, to);
        for axis in 0..3 {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            if d == 0.0 {
                if o < self.low[axis] || o > self.high[axis] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.low[axis] - o) / d, (self.high[axis] - o) / d);
            first = first.max(a.min(b));
            last = last.min(a.max(b));
        }
        // two roundings each
        let slack = 4.0 * f64::EPSILON * first.abs().max(last.abs());
        (first <= last + slack).then_some(first)
    }
}

/// The flat triangle of a patch, or one of the two of a quadrilateral.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flat {
    pub(super) corners: [DVec3; 3],
    /// Curvature parameters of the edges opposite the corners; zero in quadrilaterals.
    pub(super) curvature: [DVec3; 3],
    /// How far the patch may be from the quadratic patch of these, at the same parameters; in units of
    /// length.
    pub(super) off_quadratic: f64,
    /// Of the patch.
    pub(super) bounds: Bounds,
    pub(super) face: FaceId,
    /// Which one of them: 0 or 1.
    pub(super) half: u8,
}

impl Flat {
    /// Those of a patch.
    pub(super) fn all(patch: &Patch, bounds: Bounds, face: FaceId) -> impl Iterator<Item = Self> {
        let (first, second, edges) = match patch {
            Patch::Triangle(patch) => (patch.corners, None, Some(patch.curvature)),
            Patch::TangentPlane(patch) => {
                (patch.corners(), None, Some(patch.edges().map(|edge| edge.curvature)))
            }
            Patch::Quad(NagataQuad { corners: [a, b, c, d], .. }) => {
                ([*b, *d, *a], Some([*b, *c, *d]), None)
            }
        };
        let off_quadratic = if edges.is_some() { bounds.off_quadratic } else { bounds.bulge };
        // the first corner of the parameters is the last one of a triangle
        let [a, b, c] = first;
        let [c0, c1, c2] = edges.unwrap_or_default();
        let curvature = [c2, c0, c1];
        let all = [Some([c, a, b]), second].into_iter().flatten().zip(0..);
        all.map(move |(corners, half)| Self {
            corners,
            curvature,
            off_quadratic,
            bounds,
            face,
            half,
        })
    }

    /// The quadratic patch of a triangle.
    pub(super) fn quadratic(&self) -> NagataTriangle {
        let ([c, a, b], [c2, c0, c1]) = (self.corners, self.curvature);
        NagataTriangle { corners: [a, b, c], curvature: [c0, c1, c2] }
    }

    /// Reads a number of each cache line, so that several are waited for together.
    #[inline]
    pub(super) fn fetch(&self) {
        let Self { corners, curvature, bounds, .. } = self;
        black_box((corners[0].x, corners[2].z, curvature[2].x, bounds.bulge));
    }

    /// Faces in order.
    pub(super) fn order(&self) -> (FaceId, u8) {
        (self.face, self.half)
    }

    /// Twice the area times the unit normal.
    pub(super) fn area_normal(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    pub(super) fn centre(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (a + b + c) / 3.0
    }

    /// The longest side.
    pub(super) fn size(&self) -> f64 {
        let [a, b, c] = self.corners;
        a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt()
    }
}

/// A right triangle in parameter space, with legs `2^-level`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) corners: [DVec2; 3],
    pub(super) points: [DVec3; 3],
    /// Length of the legs.
    pub(super) leg: f64,
}

impl Piece {
    /// A whole triangle, or half of a quadrilateral.
    #[inline]
    pub(super) fn of(flat: &Flat) -> Self {
        let (x, y) = (DVec2::X, DVec2::Y);
        let corners = if flat.half == 0 { [DVec2::ZERO, x, y] } else { [x, DVec2::ONE, y] };
        Self { corners, points: flat.corners, leg: 1.0 }
    }

    /// Four pieces of half the size.
    pub(super) fn parts(&self, patch: &Patch) -> [Self; 4] {
        let [a, b, c] = self.corners;
        let middles = [(b + c) * 0.5, (c + a) * 0.5, (a + b) * 0.5];
        let [p, q, r] = self.points;
        let [pm, qm, rm] = middles.map(|at| patch.point(at.to_array()));
        let [am, bm, cm] = middles;
        let part = |corners, points| Self { corners, points, leg: self.leg * 0.5 };
        [
            part([a, cm, bm], [p, rm, qm]),
            part([cm, b, am], [rm, q, pm]),
            part([bm, am, c], [qm, pm, r]),
            part([am, bm, cm], [pm, qm, rm]),
        ]
    }

    /// How far the piece may be from the flat triangle of its corners.
    pub(super) fn bulge(&self, bounds: &Bounds) -> f64 {
        bounds.bulge * self.leg * self.leg
    }

    pub(super) fn centre(&self) -> DVec2 {
        (self.corners[0] + self.corners[1] + self.corners[2]) / 3.0
    }

    /// Greatest distance of the parameters from the centre: `√5/3` legs.
    pub(super) fn radius(&self) -> f64 {
        0.7454 * self.leg
    }

    /// The corner parameters' convex combination closest to a parameter.
    pub(super) fn nearest_parameter(&self, at: DVec2) -> DVec2 {
        let [a, b, c] = self.corners;
        let flat = [a, b, c].map(|q| q.extend(0.0));
        let weights = closest_weights(at.extend(0.0), flat);
        a * weights[0] + b * weights[1] + c * weights[2]
    }
}

/// Barycentric weights of the point of a flat triangle closest to `p`.
pub(super) fn closest_weights(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (g11, g12, g22) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
    let (r1, r2) = (ab.dot(ap), ac.dot(ap));
    let determinant = g11 * g22 - g12 * g12;
    let (s, t) = (g22 * r1 - g12 * r2, g11 * r2 - g12 * r1);
    let u = determinant - s - t;
    let regular = determinant > 0.0;
    if regular && s >= 0.0 && t >= 0.0 && u >= 0.0 {
        let (s, t) = (s / determinant, t / determinant);
        return [(1.0 - s - t).max(0.0), s, t];
    }
    // the closest point is on an edge that has the triangle behind it
    let on = |seen: bool, from: DVec3, to: DVec3| {
        if regular && !seen {
            return (0.0, f64::INFINITY);
        }
        let d = to - from;
        let square = d.length_squared();
        let t = if square > 0.0 { (d.dot(p - from) / square).clamp(0.0, 1.0) } else { 0.0 };
        (t, (from + d * t).distance_squared(p))
    };
    let ((t0, d0), (t1, d1), (t2, d2)) = (on(u < 0.0, b, c), on(s < 0.0, c, a), on(t < 0.0, a, b));
    if d0 <= d1 && d0 <= d2 {
        [0.0, 1.0 - t0, t0]
    } else if d1 <= d2 {
        [t1, 0.0, 1.0 - t1]
    } else {
        [1.0 - t2, t2, 0.0]
    }
}
