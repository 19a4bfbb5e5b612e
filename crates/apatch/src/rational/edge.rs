//! An edge: the one or two tetrahedra that fill the gap between those of its faces.

use basemesh::{FaceId, FaceMap, HalfedgeId, Topology};
use glam::DVec3;

use super::face::{FaceRecord, FaceSide, side_of};
use super::kinds::{Convexity, Side};
use crate::cubic_root::RayCubic;
use crate::tetrahedron::Tetrahedron;

/// The function over one edge `p_i p_j`, directed as its canonical half-edge: face `k` on its left,
/// face `l` on its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePatch {
    /// The ends.
    pub ends: [DVec3; 2],
    /// By the normals at the ends.
    pub convexity: Convexity,
    /// Weights on the edge: `e_ij`, `e_ji`.
    pub weights: [f64; 2],
    /// The tetrahedra, by [`Side::index`]; none on boundary edges and straight ones.
    pub sides: [Option<EdgeSide>; 2],
}

/// What one face gives to a tetrahedron at its edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceShare {
    /// Apex of the face.
    pub apex: DVec3,
    /// Layer 1 at the two ends.
    pub l1v: [f64; 2],
    /// Layer 1 between them.
    pub l1e: f64,
    /// Layer 2 at the two ends.
    pub l2v: [f64; 2],
    /// The free weight.
    pub free: f64,
    /// The other apex in barycentric coordinates of this face's tetrahedron: third corner, first
    /// end, second end, apex.
    pub other_apex: [f64; 4],
    /// Middle weights `end, apex, other apex`, as this face wants them, for each end.
    pub middle: [f64; 2],
    /// The weight `apex apex (other apex)`.
    pub inner: f64,
}

/// The weights of one tetrahedron; its corners are the right apex, the ends, the left apex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeSide {
    /// From the left face, `k`.
    pub left: FaceShare,
    /// From the right face, `l`.
    pub right: FaceShare,
}

/// What is stored of an edge: the rest follows from its faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeRecord {
    pub(crate) convexity: Convexity,
    /// Whether all transversals on a side are known to cross the surface once.
    pub(crate) single: [bool; 2],
    /// Of each tetrahedron, [`FaceShare::other_apex`] of the left and the right face.
    pub(crate) apices: [Option<[[f64; 4]; 2]>; 2],
}

/// Where an edge lies in one of its faces, as corners of that face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) face: FaceId,
    /// The ends of the edge, in the edge's direction.
    pub(crate) ends: [usize; 2],
    /// The third corner.
    pub(crate) third: usize,
}

/// The places of an edge in its left and its right face; `None` on a boundary.
#[inline]
pub(crate) fn places(topology: &Topology, canonical: HalfedgeId) -> Option<[Place; 2]> {
    let twin = topology.twin(canonical)?;
    let place = |h: HalfedgeId, ends| Place { face: h.face(), ends, third: h.previous().corner() };
    let along = |h: HalfedgeId| [h.corner(), h.next().corner()];
    let [j, i] = along(twin);
    Some([place(canonical, along(canonical)), place(twin, [i, j])])
}

/// The apex of each face in barycentric coordinates of the other's tetrahedron:
/// [`FaceShare::other_apex`] of the left and the right face.
#[inline]
pub(crate) fn other_apices(
    places: [Place; 2],
    corners: [[DVec3; 3]; 2],
    apices: [DVec3; 2],
) -> [[f64; 4]; 2] {
    [0, 1].map(|f| {
        let ([i, j], k) = (places[f].ends, places[f].third);
        let c = &corners[f];
        Tetrahedron::new([c[k], c[i], c[j], apices[f]]).barycentric(apices[1 - f])
    })
}

impl FaceShare {
    /// All weights, `x` the other apex \[XHB01 4.3, Step 4\]*.
    #[inline]
    fn new(side: &FaceSide, place: Place, x: [f64; 4]) -> Self {
        let ([i, j], k) = (place.ends, place.third);
        let (v, e, two) = (&side.l1v, &side.l1e, &side.l2v);
        Self {
            apex: side.apex,
            l1v: [v[i], v[j]],
            l1e: e[k],
            l2v: [two[i], two[j]],
            free: side.free,
            other_apex: x,
            middle: [
                x[0] * e[j] + x[1] * v[i] + x[2] * e[k] + x[3] * two[i],
                x[0] * e[i] + x[1] * e[k] + x[2] * v[j] + x[3] * two[j],
            ],
            inner: x[0] * two[k] + x[1] * two[i] + x[2] * two[j] + x[3] * side.free,
        }
    }
}

/// The weights on an edge, `e_ij` and `e_ji`, as its left face has them.
#[inline]
pub(crate) fn left_weights(places: [Place; 2], faces: &FaceMap<FaceRecord>) -> [f64; 2] {
    let (e, [i, j]) = (&faces[places[0].face].e, places[0].ends);
    [e[i][0], e[j][1]]
}

impl EdgeSide {
    /// From the records of its faces; `None` if one of them has no tetrahedron on this side.
    #[inline]
    pub(crate) fn of_faces(
        places: [Place; 2],
        faces: &FaceMap<FaceRecord>,
        side: Side,
        apices: [[f64; 4]; 2],
    ) -> Option<Self> {
        let [left, right] = places.map(|p| {
            let face = &faces[p.face];
            face.sides[side.index()].as_ref().map(|s| face.side(s))
        });
        Some(Self::new(places, [&left?, &right?], apices))
    }

    /// The tetrahedron between those of the two faces on one side, `places` in the left and right
    /// face, `apices` as [`other_apices`] makes them.
    #[inline]
    pub(crate) fn new(
        places: [Place; 2],
        sides: [&FaceSide; 2],
        [left, right]: [[f64; 4]; 2],
    ) -> Self {
        Self {
            left: FaceShare::new(sides[0], places[0], left),
            right: FaceShare::new(sides[1], places[1], right),
        }
    }

    /// The tetrahedron: right apex, ends, left apex.
    #[inline]
    #[must_use]
    pub fn tetrahedron(&self, ends: &[DVec3; 2]) -> Tetrahedron {
        Tetrahedron::new([self.right.apex, ends[0], ends[1], self.left.apex])
    }

    /// Value and derivatives at barycentric coordinates of the tetrahedron; `weights` are those on
    /// the edge \[XHB01 4.3\].
    #[inline]
    #[must_use]
    pub fn jet(&self, weights: [f64; 2], at: [f64; 4]) -> (f64, [f64; 4]) {
        let [l, i, j, k] = at;
        let (kk, ll) = (&self.left, &self.right);
        let [e_ij, e_ji] = weights;
        // layer 1 at the ends and between them, linear in the apices
        let one = |at: usize| k * kk.l1v[at] + l * ll.l1v[at];
        let (u_i, u_j, u_ij) = (one(0), one(1), k * kk.l1e + l * ll.l1e);
        // the rational middle: k l / (k + l) times m
        let sum = k + l;
        let (r, r_k, r_l) = if sum == 0.0 {
            (0.0, 0.0, 0.0)
        } else {
            let (ks, ls) = (k / sum, l / sum);
            (k * ls, ls * ls, ks * ks)
        };
        let m_i = ll.middle[0] * l + kk.middle[0] * k;
        let m_j = ll.middle[1] * l + kk.middle[1] * k;
        let m = i * m_i + j * m_j;
        let quad = |at: usize| k * k * kk.l2v[at] + l * l * ll.l2v[at];
        let (w_i, w_j) = (quad(0), quad(1));
        let value = 3.0 * i * j * (i * e_ij + j * e_ji)
            + 3.0 * (i * i * u_i + j * j * u_j + 2.0 * i * j * u_ij)
            + 3.0 * (i * w_i + j * w_j)
            + 6.0 * r * m
            + k * k * (k * kk.free + 3.0 * l * kk.inner)
            + l * l * (l * ll.free + 3.0 * k * ll.inner);
        let d_i = 3.0 * j * (2.0 * i * e_ij + j * e_ji)
            + 6.0 * (i * u_i + j * u_ij)
            + 3.0 * w_i
            + 6.0 * r * m_i;
        let d_j = 3.0 * i * (i * e_ij + 2.0 * j * e_ji)
            + 6.0 * (j * u_j + i * u_ij)
            + 3.0 * w_j
            + 6.0 * r * m_j;
        let up = |own: &FaceShare, other: &FaceShare, own_k: f64, other_l: f64, r_own: f64| {
            3.0 * (i * i * own.l1v[0] + j * j * own.l1v[1] + 2.0 * i * j * own.l1e)
                + 6.0 * own_k * (i * own.l2v[0] + j * own.l2v[1])
                + 6.0 * (r_own * m + r * (i * own.middle[0] + j * own.middle[1]))
                + 3.0 * own_k * (own_k * own.free + 2.0 * other_l * own.inner)
                + 3.0 * other_l * other_l * other.inner
        };
        let d_k = up(kk, ll, k, l, r_k);
        let d_l = up(ll, kk, l, k, r_l);
        (value, [d_l, d_i, d_j, d_k])
    }

    /// The function along the ray from `x p_i + (1 - x) p_j` to `y` times the left plus `1 - y`
    /// times the right apex.
    #[inline]
    #[must_use]
    pub fn ray(&self, weights: [f64; 2], [x, y]: [f64; 2]) -> RayCubic {
        let (i, j, k, l) = (x, 1.0 - x, y, 1.0 - y);
        let (kk, ll) = (&self.left, &self.right);
        let one = |s: &FaceShare| i * (i * s.l1v[0] + 2.0 * j * s.l1e) + j * j * s.l1v[1];
        let two = |s: &FaceShare| i * s.l2v[0] + j * s.l2v[1];
        let middle = |s: &FaceShare| i * s.middle[0] + j * s.middle[1];
        let base = 3.0 * i * j * (i * weights[0] + j * weights[1]);
        RayCubic([
            base,
            k * one(kk) + l * one(ll),
            k * k * two(kk) + l * l * two(ll) + 2.0 * k * l * (l * middle(ll) + k * middle(kk)),
            k * k * (k * kk.free + 3.0 * l * kk.inner) + l * l * (l * ll.free + 3.0 * k * ll.inner),
        ])
    }

    /// Whether every transversal of the point `x p_i + (1 - x) p_j` crosses the surface once for
    /// certain, by the signs of Bernstein coefficients in `y`; `sign` is that of the side.
    #[inline]
    pub(crate) fn is_single_along(&self, weights: [f64; 2], x: f64, sign: f64) -> bool {
        let (i, j) = (x, 1.0 - x);
        let shares = [&self.right, &self.left];
        let base = i * weights[0] + j * weights[1];
        if sign * base >= 0.0
            || shares.iter().any(|s| sign * s.free <= 0.0 || sign * s.inner <= 0.0)
        {
            return sign * base >= 0.0;
        }
        let one = |s: &FaceShare| i * (i * s.l1v[0] + 2.0 * j * s.l1e) + j * j * s.l1v[1];
        let two = |s: &FaceShare| i * s.l2v[0] + j * s.l2v[1];
        let middle = |s: &FaceShare| i * s.middle[0] + j * s.middle[1];
        shares.iter().all(|s| sign * one(s) <= 0.0)
            || shares.iter().all(|s| {
                let end = sign * two(s);
                end >= 0.0 && end + 2.0 * sign * middle(s) >= 0.0
            })
    }

    /// What raising the two free weights by `b` adds to the cubic of a transversal, as a multiple of
    /// `b t²` \[XHB01 Step 6\].
    #[inline]
    #[must_use]
    pub fn raise_factor(&self, y: f64) -> f64 {
        let l = 1.0 - y;
        l * l * (1.0 + 2.0 * y * self.right.other_apex[3])
            + y * y * (1.0 + 2.0 * l * self.left.other_apex[3])
    }
}

impl EdgePatch {
    /// Value of the function on the edge, at `x p_i + (1 - x) p_j`.
    #[inline]
    #[must_use]
    pub fn base(&self, x: f64) -> f64 {
        let y = 1.0 - x;
        3.0 * x * y * (x * self.weights[0] + y * self.weights[1])
    }

    /// Where the surface crosses a nonconvex edge: the `x` with `x p_i + (1 - x) p_j` on it.
    #[must_use]
    pub fn crossing(&self) -> Option<f64> {
        let [e_ij, e_ji] = self.weights;
        (self.convexity == Convexity::Nonconvex).then(|| e_ji / (e_ji - e_ij))
    }

    /// The side on which the transversals of a point of the edge run, if they do.
    #[inline]
    pub(crate) fn side_at(&self, base: f64) -> Option<(Side, &EdgeSide)> {
        let side = side_of(base);
        self.sides[side.index()].as_ref().map(|s| (side, s))
    }
}
