//! The C0 patch of a triangle: a quadratic polynomial.

use bezier_core::{Barycentric, Corner, LocalEdge, ParametricPatch, PatchJet, QuadraticTriangle};
use glam::DVec3;

use crate::curvature_parameter::one_each;
use crate::sample::{fill_rows, lattice_size};
use crate::settings::EdgeSettings;
use crate::unit::{cross_direction, unit};

/// The quadratic patch over a triangle \[Nagata10 (2.13)\], with barycentric parameters `b`:
///
/// ```text
/// x(b) = P_0 b_0 + P_1 b_1 + P_2 b_2 - C_0 b_1 b_2 - C_1 b_2 b_0 - C_2 b_0 b_1
/// ```
///
/// It is determined by its edge curves: `C_i` is the curvature parameter of the edge that does not
/// touch corner `i`. On an edge it takes the values of [`EdgeCurve::point`](crate::EdgeCurve::point)
/// bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NagataTriangle {
    /// Corners, counter-clockwise seen from outside.
    pub corners: [DVec3; 3],
    /// Curvature parameter of the edge opposite each corner.
    pub curvature: [DVec3; 3],
}

impl NagataTriangle {
    /// A patch from one unit normal at each corner.
    #[must_use]
    pub fn from_normals(corners: [DVec3; 3], normals: [DVec3; 3], settings: &EdgeSettings) -> Self {
        let curvature = Corner::ALL.map(|corner| {
            let [j, k] = ends_opposite(corner);
            one_each(corners[k] - corners[j], [normals[j], normals[k]], settings).value
        });
        Self { corners, curvature }
    }

    /// The point at these parameters.
    #[inline]
    #[must_use]
    pub fn point(&self, at: Barycentric) -> DVec3 {
        let [p0, p1, p2] = self.corners;
        let [c0, c1, c2] = self.curvature;
        let Barycentric { u, v, w } = at;
        p0 * u + p1 * v + p2 * w - (c0 * (v * w) + c1 * (w * u) + c2 * (u * v))
    }

    /// Derivatives `D_i` of the formula above by `b_i`, as if these were independent; the derivative
    /// from corner `i` to corner `j` is `D_j - D_i`.
    #[inline]
    #[must_use]
    pub fn partials(&self, at: Barycentric) -> [DVec3; 3] {
        let [p0, p1, p2] = self.corners;
        let [c0, c1, c2] = self.curvature;
        let Barycentric { u, v, w } = at;
        [p0 - c1 * w - c2 * v, p1 - c2 * u - c0 * w, p2 - c0 * v - c1 * u]
    }

    /// Twice the area times the unit normal of the parametrisation; zero where it is singular.
    #[inline]
    #[must_use]
    pub fn area_normal(&self, at: Barycentric) -> DVec3 {
        area_normal(self.partials(at))
    }

    /// Unit normal, outward for counter-clockwise corners; `None` where the patch is singular. At a
    /// singular corner, the apex of a cone for example, the direction half way between the normals of
    /// the other two.
    #[inline]
    #[must_use]
    pub fn normal(&self, at: Barycentric) -> Option<DVec3> {
        if at.u.max(at.v).max(at.w) == 1.0 {
            let normals = Corner::ALL.map(|corner| self.corner_normal(corner));
            if let Some(normal) = normal_at_corner(at, &normals) {
                return normal;
            }
        }
        normal_of(self.partials(at))
    }

    /// Unit normal at a corner \[Nagata10 (2.36)\]; `None` if the tangents of its two edges are parallel
    /// or vanish.
    #[must_use]
    pub fn corner_normal(&self, corner: Corner) -> Option<DVec3> {
        let leaving = LocalEdge::starting_at(corner);
        let arriving = leaving.previous();
        let chord =
            |edge: LocalEdge| self.corners[edge.end().index()] - self.corners[edge.start().index()];
        let normal = self.end_tangents(leaving)[0].cross(self.end_tangents(arriving)[1]);
        corner_direction(normal, [chord(leaving), chord(arriving)])
    }

    /// Tangents at both ends of an edge, each pointing into the edge: `T_ij` at its start and `T_ik`
    /// at its end.
    #[inline]
    #[must_use]
    pub fn end_tangents(&self, edge: LocalEdge) -> [DVec3; 2] {
        let d = self.corners[edge.end().index()] - self.corners[edge.start().index()];
        let c = self.curvature[edge.apex().index()];
        [d - c, -d - c]
    }

    /// Coefficients `[c00, c10, c01, c11, c20, c02]` of the polynomial in `η = b_1 + b_2` and
    /// `ζ = b_2` \[Nagata10 (2.10)\].
    #[inline]
    #[must_use]
    pub fn monomials(&self) -> [DVec3; 6] {
        let [p0, p1, p2] = self.corners;
        let [c0, c1, c2] = self.curvature;
        [p0, p1 - p0 - c2, p2 - p1 + c2 - c1, c1 - c2 - c0, c2, c0]
    }

    /// The same patch as a Bézier triangle.
    #[must_use]
    pub fn bezier(&self) -> QuadraticTriangle {
        let [p0, p1, p2] = self.corners;
        let [m0, m1, m2] = Corner::ALL.map(|corner| {
            let [j, k] = ends_opposite(corner);
            (self.corners[j] + self.corners[k] - self.curvature[corner.index()]) * 0.5
        });
        QuadraticTriangle::new([p0, m2, m1, p1, m0, p2])
    }

    /// Mid-side nodes opposite each corner: with the corners, the nodes of the six-node quadratic
    /// triangle of finite elements, which is this patch exactly.
    #[must_use]
    pub fn mid_side_nodes(&self) -> [DVec3; 3] {
        Corner::ALL.map(|corner| {
            let [j, k] = ends_opposite(corner);
            (self.corners[j] + self.corners[k]) * 0.5 - self.curvature[corner.index()] * 0.25
        })
    }

    /// Points at the regular lattice with this many divisions, in the order of
    /// [`Barycentric::lattice`]: the fast road, equal to [`point`](Self::point) to round-off.
    ///
    /// # Panics
    ///
    /// If `divisions` is zero or `points` has not the length `(divisions + 1) (divisions + 2) / 2`.
    pub fn sample(&self, divisions: usize, points: &mut [DVec3]) {
        assert_eq!(points.len(), lattice_size(divisions), "one point for each lattice point");
        fill_rows([points], divisions, |row| row + 1, |eta| [self.row(eta)]);
    }
}

/// The corners of the edge that does not touch `corner`, in counter-clockwise order.
#[inline]
pub(crate) const fn ends_opposite(corner: Corner) -> [usize; 2] {
    let edge = LocalEdge::opposite(corner);
    [edge.start().index(), edge.end().index()]
}

/// The direction of the cross product of two tangents at a corner; `None` if it is too short against
/// the chords.
#[inline]
pub(crate) fn corner_direction(normal: DVec3, [a, b]: [DVec3; 2]) -> Option<DVec3> {
    /// The square of what round-off of the tangents leaves, relative to the chords.
    const SINGULAR: f64 = 1e-24;
    let scale = a.length_squared() * b.length_squared();
    if normal.length_squared() > SINGULAR * scale { unit(normal) } else { None }
}

/// At a corner, its normal or, if it is singular, the direction between the other two; `None` for all
/// other parameters.
#[inline]
pub(crate) fn normal_at_corner(
    at: Barycentric,
    corner_normals: &[Option<DVec3>; 3],
) -> Option<Option<DVec3>> {
    let i = at.to_array().iter().position(|&weight| weight == 1.0)?;
    let between = || {
        let others = [corner_normals[(i + 1) % 3], corner_normals[(i + 2) % 3]];
        unit(others.into_iter().flatten().sum())
    };
    Some(corner_normals[i].or_else(between))
}

/// `(D_0 - D_2) × (D_1 - D_2)`.
#[inline]
pub(crate) fn area_normal([d0, d1, d2]: [DVec3; 3]) -> DVec3 {
    (d0 - d2).cross(d1 - d2)
}

/// The direction of the same; `None` where it is lost in round-off.
#[inline]
pub(crate) fn normal_of([d0, d1, d2]: [DVec3; 3]) -> Option<DVec3> {
    let size = d0.abs().max(d1.abs()).max(d2.abs()).max_element();
    cross_direction(d0 - d2, d1 - d2, size)
}

impl ParametricPatch for NagataTriangle {
    #[inline]
    fn point(&self, at: Barycentric) -> DVec3 {
        self.point(at)
    }

    fn jet(&self, at: Barycentric) -> PatchJet {
        let [d0, d1, d2] = self.partials(at);
        let [c0, c1, c2] = self.curvature;
        PatchJet {
            point: self.point(at),
            du: d0 - d2,
            dv: d1 - d2,
            duu: c1 * 2.0,
            duv: c0 + c1 - c2,
            dvv: c0 * 2.0,
        }
    }
}
