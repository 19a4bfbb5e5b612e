//! Everything measured about one result, for people and for programs.

use std::collections::{BTreeMap, HashSet};

use basemesh::{EdgeId, FaceId, MeshQuality, SurfaceTarget};
use serde::{Deserialize, Serialize};

use crate::adapt::Adaptation;
use crate::measure::{
    Continuity, Deviation, FaceDeviation, Interpolation, continuity_beside, deviation_by,
    interpolation,
};
use crate::mesh_surface::SharpMesh;
use crate::objectives::Retreat;
use crate::progress::{Clock, Progress, Stage};
use crate::settings::Settings;
use crate::surface::G1Surface;

/// The measured qualities of a surface and how it came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Topology and how patches meet.
    pub continuity: Continuity,
    /// Largest coefficient of the smoothness condition, in chord lengths.
    pub row_residual: f64,
    /// Distance from the surface that was to be approximated.
    pub deviation: Deviation,
    /// Defects at the vertices.
    pub interpolation: Interpolation,
    /// Edges whose curve is a fallback: their two vertices.
    pub fallback_edges: Vec<[usize; 2]>,
    /// Patches that were taken back to the published objectives because they folded over.
    pub retreats: BTreeMap<usize, Retreat>,
    /// Mean number of steps of the curve solver to the published tolerance.
    pub mean_sqp_iterations: f64,
    /// How the base mesh was made; missing if it was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_mesh: Option<BaseMeshReport>,
    /// How an accuracy was reached; missing if none was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adaptation: Option<Adaptation>,
    /// Seconds by stage, wall clock.
    pub seconds: BTreeMap<String, f64>,
}

/// How the base mesh was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseMeshReport {
    /// Triangles of the polygonization.
    pub triangles: usize,
    /// Cells along the longest side of the region.
    pub cells: usize,
    /// Whether two resolutions agreed about Euler characteristic and number of components.
    pub topology_confirmed: bool,
    /// Largest angle between the normals at the ends of an edge, in degrees.
    pub max_turning_deg: f64,
    /// Smallest angle of a face, in degrees.
    pub min_angle_deg: f64,
    /// Faces added where the simplified mesh did not resolve the surface.
    pub added_faces: usize,
}

/// Measures a surface against its target; adds the stage [`Stage::Measure`] to its times.
///
/// Returns the report and the figures of each face.
#[must_use]
pub fn report(
    surface: &G1Surface,
    target: &dyn SurfaceTarget,
    progress: &mut dyn Progress,
) -> (Report, basemesh::FaceMap<FaceDeviation>) {
    report_by(surface, &|_| target, progress)
}

/// [`report`] of a surface over a mesh with sharp edges, each piece against its own smooth surface.
#[must_use]
pub fn report_sharp(
    surface: &G1Surface,
    mesh: &SharpMesh,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> (Report, basemesh::FaceMap<FaceDeviation>) {
    let sources = mesh.sources(settings.projection);
    report_by(surface, &|face| &sources[mesh.piece_of(face)], progress)
}

fn report_by<'t>(
    surface: &G1Surface,
    targets: &(dyn (Fn(FaceId) -> &'t dyn SurfaceTarget) + Sync),
    progress: &mut dyn Progress,
) -> (Report, basemesh::FaceMap<FaceDeviation>) {
    let mut clock = Clock::new(progress);
    let topology = surface.whole().topology();
    let nets = &surface.patches.nets;
    let creases: HashSet<EdgeId> =
        surface.rim.iter().flat_map(|rim| rim.creases.iter().copied()).collect();
    let (mut report, faces) = clock.run(Stage::Measure, topology.face_count(), || {
        let (deviation, faces) = deviation_by(nets, targets, surface.mesh.diagonal());
        let report = Report {
            continuity: continuity_beside(topology, nets, &|edge, _| creases.contains(&edge)),
            row_residual: surface.max_row_residual(),
            deviation,
            interpolation: interpolation(surface),
            fallback_edges: fallback_edges(surface),
            retreats: retreats(surface),
            mean_sqp_iterations: surface.curve_summary().mean_iterations,
            base_mesh: base_mesh(surface),
            adaptation: surface.origin.adaptation,
            seconds: BTreeMap::new(),
        };
        (report, faces)
    });
    report.seconds = surface
        .times
        .iter()
        .chain(clock.times.iter())
        .map(|(stage, seconds)| (stage.name().to_owned(), seconds))
        .collect();
    (report, faces)
}

fn fallback_edges(surface: &G1Surface) -> Vec<[usize; 2]> {
    surface
        .curves
        .iter()
        .filter(|(_, outcome)| outcome.status.is_fallback())
        .map(|(edge, _)| surface.mesh.topology().edge_vertices(edge).map(basemesh::VertexId::index))
        .collect()
}

fn retreats(surface: &G1Surface) -> BTreeMap<usize, Retreat> {
    surface
        .retreats
        .iter()
        .filter_map(|(face, retreat)| retreat.map(|retreat| (face.index(), retreat)))
        .collect()
}

fn base_mesh(surface: &G1Surface) -> Option<BaseMeshReport> {
    let polygonized = surface.origin.polygonized?;
    let normals = surface.jets.map(|_, jet| jet.normal);
    let quality = MeshQuality::measure(&surface.mesh, &normals);
    Some(BaseMeshReport {
        triangles: polygonized.triangles,
        cells: polygonized.found.cells,
        topology_confirmed: polygonized.confirmed,
        max_turning_deg: quality.max_turning_deg,
        min_angle_deg: quality.min_angle_deg,
        added_faces: surface.origin.added_faces,
    })
}
