//! Everything measured about a surface of rational A-patches.

use apatch::rational::{RationalSurface, Report};
use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, SurfaceTarget};
use serde::Serialize;

use super::joints::{Joints, joints};
use super::samples::{edge_samples, face_samples};
use crate::measure::{Deviation, FaceDeviation, deviation_of};

/// Steps of the grid on which transversals are counted: not those of the construction.
pub const SHEET_GRID: usize = 17;

/// The measured qualities of a surface. Ids are those of the mesh that the patches are over: the one
/// that was given, unless `construction.loop_steps` is 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RationalReport {
    /// Number of faces.
    pub faces: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Vertices minus edges plus faces.
    pub euler_characteristic: i64,
    /// Number of connected components.
    pub components: usize,
    /// Whether every edge has two faces.
    pub closed: bool,
    /// Diagonal of the bounding box of the vertices. Unit: length.
    pub diagonal: f64,
    /// What the construction says.
    pub construction: Report,
    /// How the pieces meet.
    pub joints: Joints,
    /// How often transversals meet the surface.
    pub sheet: Sheet,
    /// Distance from a reference surface. Patches are numbered: those over faces first, by face id,
    /// then those over edges, by edge id.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deviation: Option<Deviation>,
}

/// Transversals on grids of [`SHEET_GRID`] steps over faces and edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Sheet {
    /// Number of transversals.
    pub transversals: usize,
    /// Number of those that do not meet the surface exactly once.
    pub bad: usize,
}

/// The figures of each patch.
#[derive(Clone, Debug)]
pub struct RationalFigures {
    /// Distances of the patches over faces from the reference surface.
    pub faces: FaceMap<FaceDeviation>,
    /// Those of the patches over edges; all zero where there is none.
    pub edges: EdgeMap<FaceDeviation>,
}

/// Measures a surface, and how far it is from a reference surface.
#[must_use]
pub fn report(
    surface: &RationalSurface,
    reference: Option<&dyn SurfaceTarget>,
) -> (RationalReport, Option<RationalFigures>) {
    let topology = surface.mesh().topology();
    let diagonal = surface.mesh().diagonal();
    let (bad, transversals) = surface.count_bad_transversals(SHEET_GRID);
    let compared = reference.map(|target| deviations(surface, target, diagonal));
    let (deviation, figures) = compared.unzip();
    let report = RationalReport {
        faces: topology.face_count(),
        edges: topology.edge_count(),
        vertices: topology.vertex_count(),
        euler_characteristic: topology.euler_characteristic(),
        components: topology.component_count(),
        closed: topology.is_closed(),
        diagonal,
        construction: surface.report().clone(),
        joints: joints(surface),
        sheet: Sheet { transversals, bad },
        deviation,
    };
    (report, figures)
}

fn deviations(
    surface: &RationalSurface,
    target: &dyn SurfaceTarget,
    diagonal: f64,
) -> (Deviation, RationalFigures) {
    let topology = surface.mesh().topology();
    let (faces, edges) = (topology.face_count(), topology.edge_count());
    let sample = |patch: FaceId, n: usize| match patch.index().checked_sub(faces) {
        None => face_samples(surface, patch, n),
        Some(edge) => edge_samples(surface, EdgeId::new(edge), n),
    };
    let (deviation, patches) = deviation_of(faces + edges, sample, target, diagonal);
    let mut of_faces = patches.into_vec();
    let of_edges = of_faces.split_off(faces);
    let figures =
        RationalFigures { faces: FaceMap::from_vec(of_faces), edges: EdgeMap::from_vec(of_edges) };
    (deviation, figures)
}
