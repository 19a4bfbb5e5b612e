//! Points of the surface by their parameters.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

use super::edge::{EdgePatch, EdgeSide};
use super::face::{FacePatch, FaceSide, dot};
use super::kinds::{Convexity, Side};
use super::surface::RationalSurface;
use crate::cubic_root::RayCubic;
use crate::tetrahedron::gradient;

/// A point of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub point: DVec3,
    /// Gradient of the function: normal to the surface, to the positive side, not of unit length.
    pub gradient: DVec3,
    /// How far along its transversal, from 0 on the mesh to 1 at the apices.
    pub t: f64,
    /// The side; `None` for a point on the mesh.
    pub side: Option<Side>,
}

impl SurfacePoint {
    /// Unit normal, to the positive side; zero at a singular point.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.gradient.normalize_or_zero()
    }
}

impl FacePatch {
    /// The point of the surface on the transversal from barycentric coordinates `x` of the triangle;
    /// `None` if the function has no root there, which the report of the surface tells.
    #[inline]
    #[must_use]
    pub fn point(&self, x: [f64; 3]) -> Option<SurfacePoint> {
        let foot = self.corners[0] * x[0] + self.corners[1] * x[1] + self.corners[2] * x[2];
        let (v0, s0) = self.base.jet(x);
        let Some((side, s)) = self.side_at(v0) else {
            return Some(self.on_mesh(foot, x));
        };
        let ((v1, s1), v2) = (s.layer1_jet(x), dot(x, s.l2v));
        let cubic = RayCubic([v0, v1, v2, s.free]);
        let t = (if side == Side::Negative { cubic.negated() } else { cubic }).first_root()?;
        // the layers are homogeneous: at (1 - t) x they are known from x
        let r = 1.0 - t;
        let slope = |a: usize| r * r * s0[a] + 3.0 * t * (r * s1[a] + t * s.l2v[a]);
        let up = 3.0 * (r * r * v1 + t * (2.0 * r * v2 + t * s.free));
        let slopes = [slope(0), slope(1), slope(2), up];
        let gradient = gradient(slopes, &s.tetrahedron(&self.corners).gradients());
        Some(SurfacePoint { point: foot * r + s.apex * t, gradient, t, side: Some(side) })
    }

    #[inline]
    fn gradient(&self, s: &FaceSide, at: [f64; 4]) -> DVec3 {
        let (_, slopes) = s.jet(&self.base, at);
        gradient(slopes, &s.tetrahedron(&self.corners).gradients())
    }

    /// A point of the triangle that is on the surface.
    #[inline]
    fn on_mesh(&self, foot: DVec3, x: [f64; 3]) -> SurfacePoint {
        let s = self.sides.iter().flatten().next();
        let gradient = match s {
            Some(s) => self.gradient(s, [x[0], x[1], x[2], 0.0]),
            None => {
                let [a, b, c] = self.corners;
                (b - a).cross(c - a)
            }
        };
        SurfacePoint { point: foot, gradient, t: 0.0, side: None }
    }

    /// The function along the transversal, as that of a point of the triangle, for the side where it
    /// goes; the sign is reversed on the negative side.
    #[must_use]
    pub fn transversal(&self, x: [f64; 3]) -> Option<RayCubic> {
        let base = self.base.value(x);
        let (side, s) = self.side_at(base)?;
        Some(if side == Side::Negative { s.ray(base, x).negated() } else { s.ray(base, x) })
    }
}

impl EdgePatch {
    /// The point of the surface on the transversal from `x p_i + (1 - x) p_j` to `y` times the left
    /// apex plus `1 - y` times the right one; `None` without a root, or without a tetrahedron.
    #[inline]
    #[must_use]
    pub fn point(&self, [x, y]: [f64; 2]) -> Option<SurfacePoint> {
        let foot = self.ends[0] * x + self.ends[1] * (1.0 - x);
        let base = self.base(x);
        let Some((side, s)) = self.side_at(base) else {
            return self.on_mesh(foot, x);
        };
        let cubic = s.ray(self.weights, [x, y]);
        let t = (if side == Side::Negative { cubic.negated() } else { cubic }).first_root()?;
        let (rest, left, right) = (1.0 - t, t * y, t * (1.0 - y));
        let at = [right, rest * x, rest * (1.0 - x), left];
        let point = foot * rest + s.left.apex * left + s.right.apex * right;
        let side = (t > 0.0).then_some(side);
        Some(SurfacePoint { point, gradient: self.gradient(s, at), t, side })
    }

    #[inline]
    fn gradient(&self, s: &EdgeSide, at: [f64; 4]) -> DVec3 {
        let (_, slopes) = s.jet(self.weights, at);
        gradient(slopes, &s.tetrahedron(&self.ends).gradients())
    }

    fn on_mesh(&self, foot: DVec3, x: f64) -> Option<SurfacePoint> {
        let s = self.sides.iter().flatten().next()?;
        let gradient = self.gradient(s, [0.0, x, 1.0 - x, 0.0]);
        Some(SurfacePoint { point: foot, gradient, t: 0.0, side: None })
    }

    /// The function along a transversal; the sign is reversed on the negative side.
    #[must_use]
    pub fn transversal(&self, [x, y]: [f64; 2]) -> Option<RayCubic> {
        let (side, s) = self.side_at(self.base(x))?;
        let cubic = s.ray(self.weights, [x, y]);
        Some(if side == Side::Negative { cubic.negated() } else { cubic })
    }
}

impl RationalSurface {
    /// The point of the surface over a point of a face, see [`FacePatch::point`].
    #[inline]
    #[must_use]
    pub fn face_point(&self, face: FaceId, x: [f64; 3]) -> Option<SurfacePoint> {
        self.faces[face].point(x)
    }

    /// The point of the surface over an edge, see [`EdgePatch::point`].
    #[inline]
    #[must_use]
    pub fn edge_point(&self, edge: EdgeId, at: [f64; 2]) -> Option<SurfacePoint> {
        self.edges[edge].point(at)
    }

    /// Whether every transversal of a grid with `n` steps crosses the surface exactly once, face by
    /// face and edge by edge; returns the number of those that do not, and of all.
    #[must_use]
    pub fn count_bad_transversals(&self, n: usize) -> (usize, usize) {
        let step = 1.0 / n as f64;
        let (mut bad, mut all) = (0, 0);
        let mut check = |missing: bool, cubic: Option<RayCubic>| {
            all += 1;
            bad += usize::from(missing || cubic.is_some_and(|c| c.threshold() > 0.0));
        };
        for (_, face) in self.faces.iter() {
            for i in 0..=n {
                for j in 0..=n - i {
                    let x = [i as f64 * step, j as f64 * step, (n - i - j) as f64 * step];
                    let wrong = face.side_at(face.base.value(x)).is_none()
                        && face.convexity != Convexity::Zero
                        && face.base.value(x).abs()
                            > 1e-12
                                * face
                                    .sides
                                    .iter()
                                    .flatten()
                                    .fold(0.0, |m: f64, s| m.max(s.scale()));
                    check(wrong, face.transversal(x));
                }
            }
        }
        for (_, edge) in self.edges.iter().filter(|(_, e)| e.sides.iter().any(Option::is_some)) {
            for i in 1..n {
                for j in 0..=n {
                    let at = [i as f64 * step, j as f64 * step];
                    check(edge.side_at(edge.base(at[0])).is_none(), edge.transversal(at));
                }
            }
        }
        (bad, all)
    }
}

/// Barycentric coordinates that add up to one, whatever the rounding.
#[inline]
pub(crate) fn foot_of(at: [f64; 4]) -> ([f64; 3], f64) {
    let x = [at[0], at[1], at[2]];
    let sum = dot(x, [1.0; 3]);
    (x.map(|v| v / sum), at[3] / (sum + at[3]))
}
