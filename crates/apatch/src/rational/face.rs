//! A face: its triangle and the one or two tetrahedra over it.

use glam::DVec3;

use super::base::{BaseLayer, others};
use super::block::EdgeBlock;
use super::kinds::{Convexity, Side};
use crate::cubic_root::RayCubic;
use crate::tetrahedron::Tetrahedron;

/// The function over one face: layer 0 on the triangle, and a tetrahedron on each side where the
/// surface goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacePatch {
    /// Corners, counter-clockwise seen from the positive side.
    pub corners: [DVec3; 3],
    /// By its edges.
    pub convexity: Convexity,
    /// Whether a convex face had to be given both tetrahedra, because the function has the other
    /// sign somewhere inside.
    pub promoted: bool,
    /// Layer 0.
    pub base: BaseLayer,
    /// The tetrahedra, by [`Side::index`].
    pub sides: [Option<FaceSide>; 2],
}

/// The weights of one tetrahedron above layer 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceSide {
    /// The fourth corner.
    pub apex: DVec3,
    /// Layer 1: `V_a V_a apex`.
    pub l1v: [f64; 3],
    /// Layer 1: `V_a V_b apex`, by opposite corner.
    pub l1e: [f64; 3],
    /// The weights `V_a apex` of the quadric that fits layers 0 and 1 best.
    pub fitted: [f64; 3],
    /// Layer 2: `V_a apex apex`.
    pub l2v: [f64; 3],
    /// Layer 3, the free weight: `apex apex apex`.
    pub free: f64,
    /// The free weight that fits the neighbours best.
    pub neighbours: f64,
    /// Single-sheet bound of the face: sign times free weight must be above it. Minus infinity if
    /// no transversal of the face goes to this side.
    pub bound: f64,
}

/// What is stored of a face: all that does not follow from the rest. Half of a [`FacePatch`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FaceRecord {
    /// `e_ab` and `e_ac` for each corner `a`, `b` and `c` following it.
    pub(crate) e: [[f64; 2]; 3],
    /// The middle weight as each edge wants it, by opposite corner.
    pub(crate) g: [f64; 3],
    pub(crate) convexity: Convexity,
    pub(crate) promoted: bool,
    pub(crate) split: bool,
    pub(crate) sides: [Option<SideRecord>; 2],
}

/// What is stored of a [`FaceSide`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SideRecord {
    pub(crate) apex: DVec3,
    pub(crate) l1v: [f64; 3],
    pub(crate) l1e: [f64; 3],
    pub(crate) free: f64,
    pub(crate) neighbours: f64,
    pub(crate) bound: f64,
}

impl FaceRecord {
    /// With everything that follows from it.
    #[inline]
    pub(crate) fn patch(&self, corners: [DVec3; 3]) -> FacePatch {
        FacePatch {
            corners,
            convexity: self.convexity,
            promoted: self.promoted,
            base: self.base(),
            sides: self.sides.each_ref().map(|s| s.as_ref().map(|s| self.side(s))),
        }
    }

    #[inline]
    pub(crate) fn base(&self) -> BaseLayer {
        BaseLayer::new(self.e, self.g, self.split)
    }

    /// One of its tetrahedra with everything that follows.
    #[inline]
    pub(crate) fn side(&self, s: &SideRecord) -> FaceSide {
        let fitted = fitted(&s.l1v, &s.l1e, &self.e, &self.g);
        FaceSide {
            apex: s.apex,
            l1v: s.l1v,
            l1e: s.l1e,
            fitted,
            l2v: layer2(fitted, s.free),
            free: s.free,
            neighbours: s.neighbours,
            bound: s.bound,
        }
    }
}

impl SideRecord {
    /// As [`FaceSide::scale`].
    #[inline]
    pub(crate) fn scale(&self) -> f64 {
        scale(&self.l1v)
    }
}

/// The weights `V_a apex` of the quadric that fits layers 0 and 1 best, by the closed form of the
/// least-squares fit \[XHB01 (4.15)\]*.
#[inline]
fn fitted(l1v: &[f64; 3], l1e: &[f64; 3], e: &[[f64; 2]; 3], g: &[f64; 3]) -> [f64; 3] {
    let mean = (g[0] + g[1] + g[2]) / 3.0;
    std::array::from_fn(|a| {
        let [b, c] = others(a);
        (21.0 * l1v[a] - 3.0 * (l1v[b] + l1v[c]) + 9.0 * (l1e[b] + l1e[c])
            - 3.0 * l1e[a]
            - mean
            - 3.0 * (e[a][0] + e[a][1])
            - (e[b][1] + e[c][0])
            + (e[b][0] + e[c][1]))
            / 20.0
    })
}

/// Layer 2 for a free weight: `(2 q_au + f) / 3` \[XHB01 (4.15)\].
#[inline]
fn layer2(fitted: [f64; 3], free: f64) -> [f64; 3] {
    fitted.map(|q| (2.0 * q + free) / 3.0)
}

#[inline]
fn scale(l1v: &[f64; 3]) -> f64 {
    3.0 * l1v.iter().fold(0.0, |m: f64, w| m.max(w.abs()))
}

impl FaceSide {
    /// Layer 1 from the normals and blocks; the free weight is the published one.
    #[inline]
    pub(crate) fn new(
        apex: DVec3,
        corners: &[DVec3; 3],
        normals: [DVec3; 3],
        blocks: [&EdgeBlock; 3],
        base: &BaseLayer,
    ) -> Self {
        let l1v: [f64; 3] = std::array::from_fn(|a| (apex - corners[a]).dot(normals[a]) / 3.0);
        let l1e = blocks.map(|b| b.at(apex));
        let fitted = fitted(&l1v, &l1e, base.edge_weights(), &base.middle_weights());
        let mut side = Self {
            apex,
            l1v,
            l1e,
            fitted,
            l2v: [0.0; 3],
            free: 0.0,
            neighbours: 0.0,
            bound: f64::NEG_INFINITY,
        };
        let published = side.published(base);
        side.neighbours = published;
        side.set_free(published);
        side
    }

    /// The published default of the free weight \[XHB01 (4.13), (4.16)\].
    #[inline]
    #[must_use]
    pub fn published(&self, base: &BaseLayer) -> f64 {
        let sum = |v: &[f64; 3]| v[0] + v[1] + v[2];
        let edges: f64 = base.edge_weights().iter().map(|e| e[0] + e[1]).sum();
        let mean = sum(&base.middle_weights()) / 3.0;
        0.5 * (sum(&self.l1v) + sum(&self.l1e)) - 0.2 * (edges + mean)
    }

    /// Sets the free weight and layer 2 with it.
    #[inline]
    pub(crate) fn set_free(&mut self, free: f64) {
        self.free = free;
        self.l2v = layer2(self.fitted, free);
    }

    /// What is stored of it.
    #[inline]
    pub(crate) const fn record(&self) -> SideRecord {
        let &Self { apex, l1v, l1e, free, neighbours, bound, .. } = self;
        SideRecord { apex, l1v, l1e, free, neighbours, bound }
    }

    /// Three times the largest weight next to the face: the size of values of the function here.
    #[inline]
    #[must_use]
    pub fn scale(&self) -> f64 {
        scale(&self.l1v)
    }

    /// Layer 1 at barycentric coordinates of the triangle.
    #[inline]
    #[must_use]
    pub fn layer1(&self, x: [f64; 3]) -> f64 {
        self.layer1_jet(x).0
    }

    #[inline]
    pub(crate) fn layer1_jet(&self, x: [f64; 3]) -> (f64, [f64; 3]) {
        let (v, e) = (&self.l1v, &self.l1e);
        // half the derivatives; a quadratic form is the sum of coordinates times those
        let half = [
            x[0] * v[0] + x[1] * e[2] + x[2] * e[1],
            x[1] * v[1] + x[2] * e[0] + x[0] * e[2],
            x[2] * v[2] + x[0] * e[1] + x[1] * e[0],
        ];
        (dot(x, half), half.map(|h| 2.0 * h))
    }

    /// Value and derivatives at barycentric coordinates of the tetrahedron, apex last
    /// \[XHB01 (4.1)\].
    #[inline]
    #[must_use]
    pub fn jet(&self, base: &BaseLayer, at: [f64; 4]) -> (f64, [f64; 4]) {
        let [x0, x1, x2, w] = at;
        let x = [x0, x1, x2];
        let (v0, s0) = base.jet(x);
        let (v1, s1) = self.layer1_jet(x);
        let v2 = dot(x, self.l2v);
        let value = v0 + w * (3.0 * v1 + w * (3.0 * v2 + w * self.free));
        let slope = |a: usize| s0[a] + 3.0 * w * (s1[a] + w * self.l2v[a]);
        let up = 3.0 * (v1 + w * (2.0 * v2 + w * self.free));
        (value, [slope(0), slope(1), slope(2), up])
    }

    /// The function along the ray from a point of the triangle to the apex, `base` its value there.
    #[inline]
    #[must_use]
    pub fn ray(&self, base: f64, x: [f64; 3]) -> RayCubic {
        RayCubic([base, self.layer1(x), dot(x, self.l2v), self.free])
    }

    /// The tetrahedron.
    #[inline]
    #[must_use]
    pub fn tetrahedron(&self, corners: &[DVec3; 3]) -> Tetrahedron {
        Tetrahedron::new([corners[0], corners[1], corners[2], self.apex])
    }
}

impl FacePatch {
    /// The side whose tetrahedron the transversal of a point takes, by the value of the function
    /// there; `None` if the point is on the surface (or its side has no tetrahedron).
    #[inline]
    pub(crate) fn side_at(&self, base: f64) -> Option<(Side, &FaceSide)> {
        let side = side_of(base);
        let found = self.sides[side.index()].as_ref();
        found.map(|f| (side, f)).filter(|(_, f)| base.abs() > ON_SURFACE * f.scale())
    }
}

/// The side to which the transversal of a point with this value goes.
#[inline]
pub(crate) fn side_of(base: f64) -> Side {
    if base <= 0.0 { Side::Positive } else { Side::Negative }
}

/// Values of the function below this times its size next to the face count as zero.
pub(crate) const ON_SURFACE: f64 = 1e-15;

#[inline]
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
