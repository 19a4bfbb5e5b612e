//! Closest points and ray intersections, on one patch and on a surface. \[ours\]
//!
//! Both are found by branch and bound. A patch is cut in parameter space into right triangles with
//! legs `2^-level`; a bound of the second derivatives tells how far a piece is from the flat triangle of
//! its corners. Newton iterations start only where the same bound shows that there is one solution at
//! most, so none is missed.

mod bounds;
mod closest;
mod convex;
mod leaf;
mod piece;
mod ray;
mod side;
mod surface;
mod tree;

use basemesh::FaceId;
use bezier_core::{Barycentric, Corner, LocalEdge, ParametricPatch, PatchJet};
use glam::DVec3;

use crate::ids::Side;
use crate::surface::{NagataSurface, Patch};

pub use bounds::Bounds;
pub use piece::Aabb;
pub use ray::Ray;
pub use surface::SurfaceQueries;

/// A point of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// `[b_0, b_1]` of a triangle, `[η, ζ]` of a quadrilateral.
    pub parameters: [f64; 2],
    /// The point.
    pub point: DVec3,
    /// Unit normal; `None` where the patch is singular.
    pub normal: Option<DVec3>,
}

/// The point of a patch or a surface closest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The face it is on; one of them if there are several.
    pub face: FaceId,
    /// Where.
    pub at: PatchPoint,
    /// Distance, negative on the side the normal points away from; positive without a normal.
    pub signed_distance: f64,
}

/// Where a ray meets a patch or a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The face it is on; one of them if there are several.
    pub face: FaceId,
    /// Where.
    pub at: PatchPoint,
    /// Ray parameter: the point is `origin + direction * t`.
    pub t: f64,
}

impl Patch {
    /// The point with these parameters, `[b_0, b_1]` or `[η, ζ]`.
    #[inline]
    #[must_use]
    pub fn point(&self, parameters: [f64; 2]) -> DVec3 {
        match self {
            Self::Triangle(patch) => patch.point(barycentric(parameters)),
            Self::TangentPlane(patch) => patch.point(barycentric(parameters)),
            Self::Quad(patch) => patch.point(parameters),
        }
    }

    /// Unit normal; `None` where the patch is singular.
    #[must_use]
    pub fn normal(&self, parameters: [f64; 2]) -> Option<DVec3> {
        match self {
            Self::Triangle(patch) => patch.normal(barycentric(parameters)),
            Self::TangentPlane(patch) => patch.normal(barycentric(parameters)),
            Self::Quad(patch) => patch.normal(parameters),
        }
    }

    /// Point and derivatives by the parameters.
    #[inline]
    #[must_use]
    pub fn jet(&self, parameters: [f64; 2]) -> PatchJet {
        match self {
            Self::Triangle(patch) => ParametricPatch::jet(patch, barycentric(parameters)),
            Self::TangentPlane(patch) => ParametricPatch::jet(patch, barycentric(parameters)),
            Self::Quad(patch) => patch.jet(parameters),
        }
    }

    fn at(&self, parameters: [f64; 2]) -> PatchPoint {
        let (point, normal) = (self.point(parameters), self.normal(parameters));
        PatchPoint { parameters, point, normal }
    }
}

fn barycentric([u, v]: [f64; 2]) -> Barycentric {
    Barycentric::from_array([u, v, (1.0 - u - v).max(0.0)])
}

impl NagataSurface {
    /// Parameters of the point at `t` in [0, 1] of a side.
    ///
    /// # Panics
    ///
    /// If the face has no such side.
    #[must_use]
    pub fn side_parameters(&self, side: Side, t: f64) -> [f64; 2] {
        if self.mesh().corners(side.face).len() == 4 {
            return [[t, 0.0], [1.0, t], [1.0 - t, 1.0], [0.0, 1.0 - t]][side.corner];
        }
        let at = Barycentric::on_edge(LocalEdge::starting_at(Corner::ALL[side.corner]), t);
        [at.u, at.v]
    }

    /// Walks across a side at its parameter `t`: the same point on each of the other faces there, as a
    /// side, its parameter, and the parameters of the patch. Nothing on a boundary.
    pub fn walk_across(
        &self,
        side: Side,
        t: f64,
    ) -> impl Iterator<Item = (Side, f64, [f64; 2])> + '_ {
        let forward = self.mesh().runs_forward(side);
        self.mesh().across(side).map(move |other| {
            let same = self.mesh().runs_forward(other) == forward;
            let t = if same { t } else { 1.0 - t };
            (other, t, self.side_parameters(other, t))
        })
    }
}
