//! Improvement of a base mesh without changing its number of vertices.

pub(crate) mod edit_mesh;
pub(crate) mod flip;
pub(crate) mod guard;
pub(crate) mod link;
pub(crate) mod metric;
mod settings;
pub(crate) mod sliver;
mod smooth;
mod split;
pub(crate) mod surface_mesh;

use glam::DVec3;
use thiserror::Error;

pub use settings::ImproveSettings;
pub use split::{SplitError, split_edges};

use crate::ids::VertexId;
use crate::maps::VertexMap;
use crate::mesh::TriMesh;
use crate::target::SurfaceTarget;
use flip::{FlipGoal, flip_edges};
use metric::Metric;
use sliver::lift_slivers;
use smooth::smooth;
use surface_mesh::SurfaceMesh;

/// Why a mesh cannot be improved.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ImproveError {
    /// The mesh has a boundary.
    #[error("edge {a}-{b} has one face only; close the surface first")]
    Open {
        /// Lower end of the first boundary edge.
        a: usize,
        /// Higher end.
        b: usize,
    },
}

/// An improved mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Improved {
    /// Same vertex ids and number of faces as the input.
    pub mesh: TriMesh,
    /// Unit surface normals at the vertices.
    pub normals: VertexMap<DVec3>,
    /// What was done.
    pub report: ImproveReport,
}

/// What an improvement did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ImproveReport {
    /// Edges flipped, over all rounds.
    pub flips: usize,
    /// Vertices moved, over all iterations.
    pub moves: usize,
    /// Vertices near which no surface point was found. They keep their place, and their normals are
    /// those of the faces around them.
    pub off_surface: Vec<VertexId>,
}

/// Flips edges and moves vertices along the surface, so that triangles become well shaped and fine
/// where the surface bends.
///
/// All vertices are put on the surface first. Then, `rounds` times: flips towards valence 6,
/// smoothing, flips towards the Delaunay condition, smoothing, and single moves that lift
/// triangles that are still thin. Smoothing and the Delaunay condition measure lengths that count
/// the turning of the surface normal, see [`ImproveSettings::turning_weight`]. Every change passes the guards of
/// `settings`, so that no property they watch gets worse; a mesh that violates them already is
/// improved as far as single steps lead. Deterministic, single threaded except for projections;
/// lengths may have any scale.
///
/// See `docs/math/base-mesh.md`.
///
/// # Errors
///
/// [`ImproveError::Open`] if the mesh has a boundary.
pub fn improve(
    mesh: &TriMesh,
    target: &dyn SurfaceTarget,
    settings: &ImproveSettings,
) -> Result<Improved, ImproveError> {
    let mut surface = SurfaceMesh::new(mesh, target).map_err(|edge| {
        let [a, b] = mesh.topology().edge_vertices(edge).map(VertexId::index);
        ImproveError::Open { a, b }
    })?;
    let mut report = improve_surface(&mut surface, settings);
    let (mesh, normals, off_surface) = surface.finish();
    report.off_surface = off_surface;
    Ok(Improved { mesh, normals, report })
}

/// The rounds of [`improve`].
pub(crate) fn improve_surface(
    surface: &mut SurfaceMesh<'_>,
    settings: &ImproveSettings,
) -> ImproveReport {
    let guard = settings.guard();
    let mut report = ImproveReport::default();
    for _ in 0..settings.rounds {
        let metric = Metric::with_turning(surface, settings.turning_weight);
        for goal in [FlipGoal::Valence, FlipGoal::Delaunay(metric)] {
            report.flips += flip_edges(surface, &guard, goal);
            report.moves += smooth(surface, &guard, &metric, settings.smoothing_iterations);
        }
        report.moves += lift_slivers(surface, &guard);
    }
    report
}
