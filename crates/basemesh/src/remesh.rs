//! A base mesh with wanted edge lengths.

mod collapse;
mod relax;
mod split;

use thiserror::Error;

use crate::ids::VertexId;
use crate::improve::flip::{FlipGoal, flip_edges};
use crate::improve::metric::Metric;
use crate::improve::sliver::lift_slivers;
use crate::improve::surface_mesh::SurfaceMesh;
use crate::improve::{ImproveSettings, Improved};
use crate::maps::VertexMap;
use crate::mesh::TriMesh;
use crate::target::SurfaceTarget;
use crate::{ImproveError, ImproveReport};

/// Settings of [`remesh`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RemeshSettings {
    /// Limits that every change has to respect. Its density is not used: the wanted lengths take
    /// its place.
    pub limits: ImproveSettings,
    /// Rounds of splits, collapses, flips and smoothing. Default 3.
    pub rounds: usize,
    /// Edges longer than this multiple of the wanted length are split. Default 4/3.
    pub longest: f64,
    /// Edges shorter than this multiple of the wanted length are collapsed. Default 4/5.
    pub shortest: f64,
    /// The number of faces of the result, an even number: in the last round the edges that are
    /// longest or shortest in relation to what is wanted are split or collapsed until it is reached,
    /// if the limits allow it. Default none.
    pub faces: Option<usize>,
    /// No edge is split once there are this many faces: at a sharp edge splits would not end. Default
    /// none.
    pub most_faces: Option<usize>,
}

impl Default for RemeshSettings {
    fn default() -> Self {
        Self {
            limits: ImproveSettings::default(),
            rounds: 3,
            longest: 4.0 / 3.0,
            shortest: 4.0 / 5.0,
            faces: None,
            most_faces: None,
        }
    }
}

/// Why a mesh cannot be remeshed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RemeshError {
    /// The mesh has a boundary.
    #[error(transparent)]
    Open(#[from] ImproveError),
    /// A wanted length is not a positive number.
    #[error("the wanted length {length} at vertex {vertex} is not a positive number")]
    Length {
        /// The vertex.
        vertex: usize,
        /// What is wanted there.
        length: f64,
    },
}

/// Splits, collapses and flips edges and moves vertices along the surface until edges are about as
/// long as wanted: [`RemeshSettings::shortest`] to [`RemeshSettings::longest`] times the mean of
/// the `lengths` at their ends.
///
/// A wanted length stands for the size of triangles: that of equilateral ones with such edges.
/// Their shape follows the surface, as in [`improve`](crate::improve()): lengths count the turning of the
/// surface normal, so that triangles are longer along a ridge than across it.
///
/// Only the surroundings of vertices with a wanted length change; vertices without one stay where
/// they are, bit for bit, though edges between them may be flipped or split when a neighbour
/// changes. Edges along which the surface turns beyond the limit are split, too. Every
/// collapse, flip and move passes the limits, unless what it replaces was worse; the topology never
/// changes. The result does not depend on the number of threads, and scaling mesh, lengths and
/// surface by a power of two scales it bit for bit.
///
/// In the manner of Botsch and Kobbelt (2004).
///
/// # Errors
///
/// [`RemeshError`] if the mesh has a boundary or a length is not positive.
///
/// # Panics
///
/// If `lengths` are not for this mesh.
pub fn remesh(
    mesh: &TriMesh,
    target: &dyn SurfaceTarget,
    lengths: &VertexMap<Option<f64>>,
    settings: &RemeshSettings,
) -> Result<Improved, RemeshError> {
    assert_eq!(lengths.len(), mesh.topology().vertex_count(), "one wish per vertex");
    for (vertex, length) in lengths.iter() {
        if let Some(length) = length.filter(|length| !(length.is_finite() && *length > 0.0)) {
            return Err(RemeshError::Length { vertex: vertex.index(), length });
        }
    }
    let surface = SurfaceMesh::new(mesh, target).map_err(|edge| {
        let [a, b] = mesh.topology().edge_vertices(edge).map(VertexId::index);
        ImproveError::Open { a, b }
    })?;
    let metric = Metric::with_turning(&surface, settings.limits.turning_weight);
    let mut work = Remesh { surface, lengths: lengths.as_slice().to_vec(), metric };
    work.measure_in_metric();
    let guard = settings.limits.guard();
    let mut report = ImproveReport::default();
    for round in 1..=settings.rounds {
        work.split_long(settings);
        work.collapse_short(settings, &guard);
        if let Some(faces) = settings.faces.filter(|_| round == settings.rounds) {
            work.split_until(faces, settings);
            work.collapse_until(faces, &guard);
        }
        for goal in [FlipGoal::Valence, FlipGoal::Delaunay(work.metric)] {
            report.flips += flip_edges(&mut work.surface, &guard, goal);
            report.moves += work.relax(settings, &guard);
        }
    }
    report.moves += lift_slivers(&mut work.surface, &guard);
    let (mesh, normals, off_surface) = work.surface.finish();
    report.off_surface = off_surface;
    Ok(Improved { mesh, normals, report })
}

/// A mesh under change with the wanted length of every vertex slot, measured in the metric.
pub(crate) struct Remesh<'a> {
    surface: SurfaceMesh<'a>,
    lengths: Vec<Option<f64>>,
    metric: Metric,
}

impl Remesh<'_> {
    /// Wanted lengths in space become lengths in the metric: those of triangles with the same area
    /// in space.
    fn measure_in_metric(&mut self) {
        for v in (0..self.surface.mesh.vertex_slots()).map(VertexId::new) {
            let [space, metric] = [Metric::SPACE, self.metric].map(|m| m.area(&self.surface, v));
            if let Some(length) = &mut self.lengths[v.index()]
                && space > 0.0
                && metric > 0.0
            {
                *length *= (metric / space).sqrt();
            }
        }
    }

    /// The length of an edge in the metric.
    fn length(&self, [a, b]: [VertexId; 2]) -> f64 {
        self.metric.squared(&self.surface, a, b).sqrt()
    }

    /// Length of the edge over the wanted one; `None` if neither end has a wish.
    fn excess(&self, h: crate::HalfedgeId) -> Option<f64> {
        let mesh = &self.surface.mesh;
        let ends = [mesh.origin(h), mesh.target(h)];
        self.wanted(ends).map(|wanted| self.length(ends) / wanted)
    }

    /// The wanted length of an edge between two vertices.
    fn wanted(&self, ends: [VertexId; 2]) -> Option<f64> {
        match ends.map(|v| self.lengths[v.index()]) {
            [Some(a), Some(b)] => Some(0.5 * (a + b)),
            [Some(one), None] | [None, Some(one)] => Some(one),
            [None, None] => None,
        }
    }
}
