//! What the construction says about a surface.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

use crate::curvature_parameter::EdgeStatus;
use crate::groups::area_normal;
use crate::join::Join;
use crate::surface::{NagataSurface, Patch};
use crate::unit::angle;

/// One edge.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EdgeReport {
    /// How its curve was found.
    pub status: EdgeStatus,
    /// [`NagataSurface::edge_misfit`].
    pub misfit: f64,
    /// How the patches join.
    pub join: Join,
}

/// One patch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PatchReport {
    /// Largest angle between the patch's normal at a corner and the given one, in radians; a normal
    /// and its negative count as the same.
    pub misfit: f64,
    /// Whether the patch folds over: its normal points to the other side than that of the flat face. For
    /// C0 triangles, `false` is certain where a bound shows it; otherwise it is looked at in 15 points
    /// (25 for quadrilaterals, 45 for G1 patches), the corners and middles of the sides among them.
    pub folded: bool,
    /// Number of corners at which the patch has no normal.
    pub singular_corners: u8,
}

/// The whole surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Number of patches.
    pub patches: usize,
    /// Number of patches that fold over.
    pub folded: usize,
    /// Number of corners of patches without a normal.
    pub singular_corners: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of edges whose curvature parameter had to be lowered.
    pub lowered: usize,
    /// Number of edges with a cubic curve.
    pub cubic: usize,
    /// Number of edges of one patch only.
    pub boundary: usize,
    /// Number of creases, edges with more than two patches or with flipped ones included.
    pub creases: usize,
    /// Number of edges with common tangent planes.
    pub tangent_plane: usize,
    /// Number of edges where common tangent planes were asked for and are missing.
    pub failures: usize,
    /// Largest misfit of an edge; zero without edges.
    pub max_misfit: f64,
}

impl NagataSurface {
    /// The report of an edge.
    #[must_use]
    pub fn edge_report(&self, edge: EdgeId) -> EdgeReport {
        EdgeReport {
            status: self.edge_status(edge),
            misfit: self.edge_misfit(edge),
            join: self.join(edge),
        }
    }

    /// The report of a patch.
    #[must_use]
    pub fn patch_report(&self, face: FaceId) -> PatchReport {
        let patch = self.patch(face);
        let flat = area_normal(self.mesh(), face);
        let mut report =
            PatchReport { misfit: 0.0, folded: patch.is_folded(flat), singular_corners: 0 };
        for corner in 0..self.mesh().corners(face).len() {
            let Some(normal) = patch.corner_normal(corner) else {
                report.singular_corners += 1;
                continue;
            };
            if let Some(given) = self.normals().at(self.mesh(), face, corner) {
                let misfit = angle(normal, given);
                report.misfit = report.misfit.max(misfit.min(std::f64::consts::PI - misfit));
            }
        }
        report
    }

    /// The report of the whole surface; takes a few times as long as building it.
    #[must_use]
    pub fn report(&self) -> Report {
        let mut report = Report {
            patches: self.mesh().face_count(),
            edges: self.mesh().edge_count(),
            ..Report::default()
        };
        for edge in self.mesh().edges() {
            report.add_edge(&self.edge_report(edge));
        }
        for face in self.mesh().faces() {
            let patch = self.patch_report(face);
            report.folded += usize::from(patch.folded);
            report.singular_corners += usize::from(patch.singular_corners);
        }
        report
    }
}

impl Report {
    fn add_edge(&mut self, edge: &EdgeReport) {
        self.lowered += usize::from(edge.status.lowered.is_some());
        self.cubic += usize::from(edge.status.cubic);
        self.max_misfit = self.max_misfit.max(edge.misfit);
        match edge.join {
            Join::TangentPlane => self.tangent_plane += 1,
            Join::Position => {}
            Join::Boundary => self.boundary += 1,
            Join::Branching | Join::Crease | Join::Flipped => self.creases += 1,
            Join::Inflection | Join::Rejected | Join::Singular | Join::Misfit { .. } => {
                self.failures += 1;
            }
        }
    }
}

impl Patch {
    /// Unit normal at a corner, counted from 0; `None` where the patch is singular.
    ///
    /// # Panics
    ///
    /// If there is no such corner.
    #[must_use]
    pub fn corner_normal(&self, corner: usize) -> Option<DVec3> {
        match self {
            Self::Triangle(patch) => patch.corner_normal(bezier_core::Corner::ALL[corner]),
            Self::TangentPlane(patch) => patch.corner_normal(bezier_core::Corner::ALL[corner]),
            Self::Quad(patch) => patch.corner_normal(corner),
        }
    }
}
