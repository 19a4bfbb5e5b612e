//! What joins the patches at an edge.

use basemesh::EdgeId;
use bezier_core::{Barycentric, Corner, LocalEdge};
use glam::DVec3;

use crate::correction::CorrectionStatus;
use crate::ids::Side;
use crate::settings::{Continuity, TangentPlanes};
use crate::surface::{NagataSurface, Patch};
use crate::unit::angle;

/// How the patches at an edge join, as far as the construction tells. What it is in numbers:
/// [`NagataSurface::kink`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Join {
    /// Common tangent planes all along.
    TangentPlane,
    /// Only a common curve: continuity of position was asked for.
    Position,
    /// One patch: the edge of an open surface.
    Boundary,
    /// More than two patches.
    Branching,
    /// The faces do not share the normals at both ends, or there is none.
    Crease,
    /// Two faces that do not agree which side is outside.
    Flipped,
    /// The published construction fails: the edge has an inflection. The normal of at least one patch
    /// turns over within the edge.
    Inflection,
    /// A correction was too long to be used.
    Rejected,
    /// A patch has no normal at an end or in the middle: tangents are parallel there, as everywhere on a
    /// triangle with collinear corners and the same normals.
    Singular,
    /// The patches have different normals at an end, because an edge there does not meet the given
    /// normals.
    Misfit {
        /// Largest angle between them, in radians.
        angle: f64,
    },
}

impl Join {
    /// Whether common tangent planes were to be expected here, but are not there.
    #[must_use]
    pub fn is_failure(&self) -> bool {
        matches!(self, Self::Inflection | Self::Rejected | Self::Singular | Self::Misfit { .. })
    }
}

impl NagataSurface {
    /// How the patches at an edge join.
    #[must_use]
    pub fn join(&self, edge: EdgeId) -> Join {
        let mut sides = self.mesh().sides_at(edge);
        let (a, b) = match (sides.next(), sides.next(), sides.next()) {
            (Some(a), Some(b), None) => (a, b),
            (_, None, _) => return Join::Boundary,
            _ => return Join::Branching,
        };
        if self.mesh().runs_forward(a) == self.mesh().runs_forward(b) {
            return Join::Flipped;
        }
        let ids = self.normals().ids_at_edge(self.mesh(), edge);
        if ids.iter().any(|ids| ids.len() != 1) {
            return Join::Crease;
        }
        let Continuity::TangentPlane(planes) = self.settings().continuity else {
            return Join::Position;
        };
        match (self.at_side(a), self.at_side(b)) {
            (Some(a), Some(b)) => self.tangent_join(planes, a, b),
            _ => Join::Position,
        }
    }

    fn tangent_join(&self, planes: TangentPlanes, a: AtSide, b: AtSide) -> Join {
        if planes == TangentPlanes::Published && (a.status.inflection || b.status.inflection) {
            return Join::Inflection;
        }
        if a.status.rejected || b.status.rejected {
            return Join::Rejected;
        }
        if [&a, &b].iter().any(|side| side.status.singular_end || side.middle.is_none()) {
            return Join::Singular;
        }
        // the sides run in opposite directions; without a normal at an end there is nothing to share
        let ends = [(a.normals[0], b.normals[1]), (a.normals[1], b.normals[0])];
        let misfit = ends.into_iter().filter_map(|(a, b)| Some(angle(a?, b?))).fold(0.0, f64::max);
        if misfit > self.settings().correction.max_misfit {
            return Join::Misfit { angle: misfit };
        }
        Join::TangentPlane
    }

    fn at_side(&self, side: Side) -> Option<AtSide> {
        let Patch::TangentPlane(patch) = self.patch(side.face) else { return None };
        let edge = LocalEdge::starting_at(Corner::ALL[side.corner]);
        Some(AtSide {
            status: patch.correction_status(edge),
            normals: [edge.start(), edge.end()].map(|corner| patch.corner_normal(corner)),
            middle: patch.normal(Barycentric::on_edge(edge, 0.5)),
        })
    }

    /// The largest angle between normals of patches at an edge, in radians, at `samples + 1` evenly
    /// spaced parameters, the ends included; `None` if the edge has one patch only.
    ///
    /// Points where a patch is singular are left out.
    #[must_use]
    pub fn kink(&self, edge: EdgeId, samples: usize) -> Option<f64> {
        let patches: Vec<(Side, Patch)> =
            self.mesh().sides_at(edge).map(|side| (side, self.patch(side.face))).collect();
        if patches.len() < 2 {
            return None;
        }
        let mut largest: f64 = 0.0;
        for sample in 0..=samples {
            let u = sample as f64 / samples.max(1) as f64;
            let mut normals = patches.iter().filter_map(|(side, patch)| {
                // a point of the edge has the complementary parameter seen from the other side
                let t = if self.mesh().runs_forward(*side) { u } else { 1.0 - u };
                patch.normal_on_side(side.corner, t)
            });
            if let Some(first) = normals.next() {
                largest = normals.fold(largest, |largest, n| largest.max(angle(first, n)));
            }
        }
        Some(largest)
    }
}

/// What one patch says about an edge.
struct AtSide {
    status: CorrectionStatus,
    /// At the start and at the end of the side.
    normals: [Option<DVec3>; 2],
    /// In the middle.
    middle: Option<DVec3>,
}

impl Patch {
    /// Unit normal at parameter `t` of the side that starts at this corner, counted from 0; `None`
    /// where the patch is singular.
    ///
    /// # Panics
    ///
    /// If there is no such corner.
    #[must_use]
    pub fn normal_on_side(&self, corner: usize, t: f64) -> Option<DVec3> {
        let on_triangle = || Barycentric::on_edge(LocalEdge::starting_at(Corner::ALL[corner]), t);
        match self {
            Self::Triangle(patch) => patch.normal(on_triangle()),
            Self::TangentPlane(patch) => patch.normal(on_triangle()),
            Self::Quad(patch) => {
                let at = [[t, 0.0], [1.0, t], [1.0 - t, 1.0], [0.0, 1.0 - t]];
                patch.normal(at[corner])
            }
        }
    }
}
