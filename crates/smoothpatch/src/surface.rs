//! The result of the pipeline.

use basemesh::{
    EdgeId, EdgeMap, FaceMap, Polygonization, SimplifyReport, SurfaceTarget, TopologyCount,
    TriMesh, VertexMap,
};
use bezier_core::{SepticTriangle, SurfaceJet};
use g1_triangular::{CurveNetwork, Plan, SmoothPatches, fill};
use hermite_sqp::{EdgeOutcome, EdgeStatus};

use crate::adapt::Adaptation;
use crate::objectives::Retreat;
use crate::progress::StageTimes;
use crate::settings::Settings;

/// A G1 spline surface with everything that it was made from.
#[derive(Clone, Debug)]
pub struct G1Surface {
    /// The base mesh: one patch per face, one curve per edge.
    pub mesh: TriMesh,
    /// Second-order data at the vertices.
    pub jets: VertexMap<SurfaceJet>,
    /// The curve of each edge and how it was found.
    pub curves: EdgeMap<EdgeOutcome>,
    /// The same curves, ready to be looked up by half-edge.
    pub network: CurveNetwork,
    /// Samples per face that could not be projected; normally zero.
    pub failed_feet: FaceMap<usize>,
    /// The patches and their weight functions.
    pub patches: SmoothPatches,
    /// Patches that were taken back to the published objectives because they folded over.
    pub retreats: FaceMap<Option<Retreat>>,
    /// Where the base mesh came from.
    pub origin: BaseMeshOrigin,
    /// Seconds per stage.
    pub times: StageTimes,
    /// Where the surface is not smooth; `None` for a closed smooth one.
    pub rim: Option<Rim>,
}

/// The edges of a surface along which it is not smooth. The base mesh is cut open along them.
#[derive(Clone, Debug)]
pub struct Rim {
    /// The base mesh before it was cut; the same faces.
    pub whole: TriMesh,
    /// Edges of the whole mesh where two patches meet without a common tangent plane.
    pub creases: Vec<EdgeId>,
    /// Edges with one patch.
    pub boundary: Vec<EdgeId>,
    /// Sharp edges of the mesh that were made smooth: single ones, among smooth ones only.
    pub smoothed: Vec<EdgeId>,
}

/// Where the base mesh of a surface came from; empty for a mesh that was given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BaseMeshOrigin {
    /// The topology found by polygonization.
    pub polygonized: Option<Polygonized>,
    /// What decimation and improvement did.
    pub simplified: Option<SimplifyReport>,
    /// Faces added where the decimated mesh did not resolve the surface.
    pub added_faces: usize,
    /// How an accuracy was reached, if one was asked for.
    pub adaptation: Option<Adaptation>,
}

/// The topology of a surface as polygonization saw it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Polygonized {
    /// Triangles of the dense mesh.
    pub triangles: usize,
    /// Its topology.
    pub found: TopologyCount,
    /// The topology at a coarser resolution.
    pub compared: TopologyCount,
    /// Whether the two agree.
    pub confirmed: bool,
}

impl From<&Polygonization> for Polygonized {
    fn from(dense: &Polygonization) -> Self {
        Self {
            triangles: dense.mesh.topology().face_count(),
            found: dense.found,
            compared: dense.compared,
            confirmed: dense.confirmed,
        }
    }
}

/// How the curves of a surface were found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveSummary {
    /// Edges with a fallback curve.
    pub fallbacks: usize,
    /// Mean number of steps of the others to the tolerance of \[TK09\].
    pub mean_iterations: f64,
}

impl G1Surface {
    /// The base mesh with its creases closed: how the patches hang together.
    #[must_use]
    pub fn whole(&self) -> &TriMesh {
        self.rim.as_ref().map_or(&self.mesh, |rim| &rim.whole)
    }

    /// How the curves were found.
    #[must_use]
    pub fn curve_summary(&self) -> CurveSummary {
        let (mut converged, mut steps, mut fallbacks) = (0_usize, 0_usize, 0_usize);
        for (_, outcome) in self.curves.iter() {
            match outcome.status {
                EdgeStatus::Converged { published_iterations, .. } => {
                    converged += 1;
                    steps += published_iterations;
                }
                EdgeStatus::Fallback(_) => fallbacks += 1,
            }
        }
        let mean_iterations = steps as f64 / converged.max(1) as f64;
        CurveSummary { fallbacks, mean_iterations }
    }

    /// The patches before they were joined, with the same curves: without gaps, but with kinks along the
    /// edges. They are filled anew, with the objectives of the settings everywhere.
    #[must_use]
    pub fn before_join(
        &self,
        target: &dyn SurfaceTarget,
        settings: &Settings,
    ) -> FaceMap<SepticTriangle> {
        let plan = Plan::uniform(self.mesh.topology(), settings.patches);
        fill(&self.mesh, &self.network, target, &plan).nets
    }

    /// Largest coefficient of the smoothness condition over all edges with two faces, in chord lengths.
    #[must_use]
    pub fn max_row_residual(&self) -> f64 {
        let residuals = EdgeMap::from_fn(self.mesh.topology().edge_count(), |edge| {
            self.patches.edge_residual(&self.mesh, &self.network, edge).unwrap_or(0.0)
        });
        residuals.as_slice().iter().copied().fold(0.0, f64::max)
    }
}
