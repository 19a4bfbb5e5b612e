//! The G1 patch of a triangle: a rational correction of the patch between three edge curves.

use bezier_core::{Barycentric, Corner, LocalEdge, ParametricPatch, PatchJet, SurfaceJet};
use glam::DVec3;

use crate::along::Along;
use crate::base_patch::{BarycentricJet, BasePatch};
use crate::blend::Blend;
use crate::correction::{Correction, CorrectionStatus, corner_normals};
use crate::edge_curve::EdgeCurve;
use crate::settings::{CorrectionSettings, TangentPlanes};
use crate::triangle::{area_normal, normal_at_corner, normal_of};

/// The patch over a triangle whose tangent planes along an edge depend on the edge's curve and the
/// normals at its ends only, and so are those of the neighbour \[Nagata10, section 3\]:
///
/// ```text
/// x(b) = x_0(b) + b_0 b_1 b_2 (Γ_0 b_1 b_2 + Γ_1 b_2 b_0 + Γ_2 b_0 b_1) / (b_0 b_1 + b_1 b_2 + b_2 b_0)
/// ```
///
/// `x_0` is the patch of the edge curves alone. `Γ_i` is a vector that makes the tangent planes
/// right along the edge opposite corner `i`: a constant ([`TangentPlanes::Published`]) or a function
/// of the parameter along the edge ([`TangentPlanes::Robust`]).
///
/// Two patches are G1 along their edge if they have the same curve there and the same
/// [`corner_normal`](Self::corner_normal) at both ends. The second derivatives have no limit at the
/// corners, as for all patches of this kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct G1Triangle {
    base: BasePatch,
    corner_normals: [Option<DVec3>; 3],
    corrections: [Correction; 3],
    status: [CorrectionStatus; 3],
}

impl G1Triangle {
    /// The patch over these corners, counter-clockwise seen from outside, between these curves; each
    /// curve is opposite the corner of the same index and runs counter-clockwise.
    ///
    /// `given` are the unit normals that the curves were made from, if there are. They are used only
    /// at corners where the tangents of both edges are parallel. Any finite input gives a finite patch.
    #[inline]
    #[must_use]
    pub fn new(
        corners: [DVec3; 3],
        edges: [EdgeCurve; 3],
        given: [Option<DVec3>; 3],
        planes: TangentPlanes,
        settings: &CorrectionSettings,
    ) -> Self {
        let base = BasePatch { corners, edges };
        let corner_normals = corner_normals(&base, &given, settings);
        let mut patch = Self {
            base,
            corner_normals,
            corrections: [Correction::NONE; 3],
            status: [CorrectionStatus::default(); 3],
        };
        for corner in Corner::ALL {
            let (correction, i) = (&mut patch.corrections[corner.index()], corner.index());
            patch.status[i] = correction.fill(&base, corner, &corner_normals, planes, settings);
        }
        patch
    }

    /// Corners, counter-clockwise seen from outside.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 3] {
        self.base.corners
    }

    /// The curve opposite each corner, running counter-clockwise.
    #[must_use]
    pub fn edges(&self) -> [EdgeCurve; 3] {
        self.base.edges
    }

    /// Unit normal at a corner, exact \[Nagata10 (2.36)\]. If the tangents of its two edges are parallel,
    /// the given normal; `None` if they vanish or do not meet it.
    #[inline]
    #[must_use]
    pub fn corner_normal(&self, corner: Corner) -> Option<DVec3> {
        self.corner_normals[corner.index()]
    }

    /// How the correction of an edge was found.
    #[inline]
    #[must_use]
    pub fn correction_status(&self, edge: LocalEdge) -> CorrectionStatus {
        self.status[edge.apex().index()]
    }

    /// The vector `Γ` of an edge at parameter `u` from its start; unit: length.
    #[must_use]
    pub fn correction(&self, edge: LocalEdge, u: f64) -> DVec3 {
        self.corrections[edge.apex().index()].at::<1>(u).0[0]
    }

    /// The point at these parameters; on an edge the values of [`EdgeCurve::point`] bit for bit.
    #[inline]
    #[must_use]
    pub fn point(&self, at: Barycentric) -> DVec3 {
        self.blends(at).fold(self.base.point(at), |point, (blend, correction)| {
            let Along([gamma]) = correction.at::<1>(blend.u);
            point + gamma * blend.weight()
        })
    }

    /// Derivatives `D_i` by `b_i`, as if these were independent; the derivative from corner `i` to
    /// corner `j` is `D_j - D_i`. Right at the corners as well.
    #[inline]
    #[must_use]
    pub fn partials(&self, at: Barycentric) -> [DVec3; 3] {
        let mut partials = self.base.partials(at);
        for (blend, correction) in self.blends(at) {
            blend.add_first(correction.at::<2>(blend.u), &mut partials);
        }
        partials
    }

    /// Twice the area times the unit normal of the parametrisation; zero where it is singular.
    #[must_use]
    pub fn area_normal(&self, at: Barycentric) -> DVec3 {
        area_normal(self.partials(at))
    }

    /// Unit normal, outward for counter-clockwise corners; `None` where the patch is singular. At a
    /// singular corner the direction half way between the normals of the other two.
    #[must_use]
    pub fn normal(&self, at: Barycentric) -> Option<DVec3> {
        normal_at_corner(at, &self.corner_normals).unwrap_or_else(|| normal_of(self.partials(at)))
    }

    /// Normal and curvature; `None` at the corners, where curvature depends on the direction of
    /// approach, and where the patch is singular.
    #[must_use]
    pub fn curvature(&self, at: Barycentric) -> Option<SurfaceJet> {
        Blend::at(at, Corner::First)?;
        self.jet(at).surface_jet()
    }

    /// The largest [`Correction::bounds`] of the edges.
    pub(crate) fn correction_bounds(&self) -> Option<[f64; 3]> {
        self.corrections.iter().try_fold([0.0_f64; 3], |[a, b, c], correction| {
            let [x, y, z] = correction.bounds()?;
            Some([a.max(x), b.max(y), c.max(z)])
        })
    }

    /// Point and derivatives by the three parameters.
    fn barycentric_jet(&self, at: Barycentric) -> BarycentricJet {
        let mut jet = self.base.jet(at);
        for (blend, correction) in self.blends(at) {
            let gamma = correction.at::<3>(blend.u);
            let Along([value, slope, _]) = gamma;
            jet.point += value * blend.weight();
            blend.add_first(Along([value, slope]), &mut jet.first);
            blend.add_second(gamma, &mut jet);
        }
        jet
    }

    /// The blending functions and the corrections that act at a point.
    #[inline]
    fn blends(&self, at: Barycentric) -> impl Iterator<Item = (Blend, &Correction)> {
        Corner::ALL.into_iter().filter_map(move |corner| {
            Some((Blend::at(at, corner)?, &self.corrections[corner.index()]))
        })
    }
}

impl ParametricPatch for G1Triangle {
    fn point(&self, at: Barycentric) -> DVec3 {
        self.point(at)
    }

    /// At the corners the second derivatives are those of the patch without corrections: there is
    /// no limit.
    fn jet(&self, at: Barycentric) -> PatchJet {
        self.barycentric_jet(at).patch_jet()
    }
}
