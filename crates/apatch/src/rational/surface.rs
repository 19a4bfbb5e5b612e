//! The surface: all tetrahedra with their weights.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh, VertexMap};
use glam::DVec3;

use super::build;
use super::edge::EdgePatch;
use super::error::SurfaceError;
use super::face::FacePatch;
use super::kinds::Side;
use super::repair::{Normals, repaired_hull};
use super::report::Report;
use super::settings::Settings;
use crate::tetrahedron::{Tetrahedron, gradient};

/// A smooth surface over a triangulation: the zero set of a C1 function on tetrahedra over its faces
/// and edges \[XHB01\].
///
/// It passes through the vertices with the given normals and is parameterised over the
/// triangulation: [`face_point`](Self::face_point) over the triangles,
/// [`edge_point`](Self::edge_point) over a unit square for each edge.
#[derive(Clone, Debug, PartialEq)]
pub struct RationalSurface {
    pub(crate) mesh: TriMesh,
    pub(crate) normals: VertexMap<DVec3>,
    pub(crate) faces: FaceMap<FacePatch>,
    pub(crate) edges: EdgeMap<EdgePatch>,
    pub(crate) report: Report,
}

impl RationalSurface {
    /// The surface over a mesh, open or closed.
    ///
    /// Where the tetrahedra do not fit together, what [`Settings::repair`] allows is tried; what
    /// remains is in the [`report`](Self::report), and the surface is made all the same. A step of
    /// Loop's scheme changes the mesh: see [`mesh`](Self::mesh).
    ///
    /// # Errors
    ///
    /// [`SurfaceError`] for unusable normals, faces without area, and settings out of range.
    pub fn new(mesh: TriMesh, normals: Normals, settings: &Settings) -> Result<Self, SurfaceError> {
        settings.check()?;
        let count = mesh.topology().face_count();
        if let Some(&face) = settings.shape.faces.keys().find(|&&face| face >= count) {
            return Err(SurfaceError::MissingFace { face, count });
        }
        Ok(build::surface(repaired_hull(mesh, normals, settings)?, settings))
    }

    /// The mesh that the surface is built over: the given one, or that after one step of Loop's
    /// scheme if [`Report::loop_steps`] is 1.
    #[must_use]
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// The gradients at the vertices.
    #[must_use]
    pub fn normals(&self) -> &VertexMap<DVec3> {
        &self.normals
    }

    /// What was done and what is wrong.
    #[must_use]
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// The function over a face.
    #[inline]
    #[must_use]
    pub fn face(&self, face: FaceId) -> &FacePatch {
        &self.faces[face]
    }

    /// The function over an edge.
    #[inline]
    #[must_use]
    pub fn edge(&self, edge: EdgeId) -> &EdgePatch {
        &self.edges[edge]
    }

    /// The free weight of a face's tetrahedron; `None` if it has none on this side.
    #[must_use]
    pub fn free_weight(&self, face: FaceId, side: Side) -> Option<f64> {
        self.faces[face].sides[side.index()].map(|s| s.free)
    }

    /// The tetrahedron over a face: its corners, then the apex.
    #[must_use]
    pub fn face_tetrahedron(&self, face: FaceId, side: Side) -> Option<Tetrahedron> {
        let patch = &self.faces[face];
        patch.sides[side.index()].as_ref().map(|s| s.tetrahedron(&patch.corners))
    }

    /// The tetrahedron over an edge: apex of its right face, its ends along the canonical half-edge,
    /// apex of its left face.
    #[must_use]
    pub fn edge_tetrahedron(&self, edge: EdgeId, side: Side) -> Option<Tetrahedron> {
        let patch = &self.edges[edge];
        patch.sides[side.index()].as_ref().map(|s| s.tetrahedron(&patch.ends))
    }

    /// Value and gradient of the function at barycentric coordinates of a face's tetrahedron.
    #[must_use]
    pub fn face_value(&self, face: FaceId, side: Side, at: [f64; 4]) -> Option<(f64, DVec3)> {
        let patch = &self.faces[face];
        let s = patch.sides[side.index()].as_ref()?;
        let (value, slopes) = s.jet(&patch.base, at);
        Some((value, gradient(slopes, &s.tetrahedron(&patch.corners).gradients())))
    }

    /// Value and gradient of the function at barycentric coordinates of an edge's tetrahedron.
    #[must_use]
    pub fn edge_value(&self, edge: EdgeId, side: Side, at: [f64; 4]) -> Option<(f64, DVec3)> {
        let patch = &self.edges[edge];
        let s = patch.sides[side.index()].as_ref()?;
        let (value, slopes) = s.jet(patch.weights, at);
        Some((value, gradient(slopes, &s.tetrahedron(&patch.ends).gradients())))
    }

    /// Bytes on the heap for faces and edges, without what allocators add.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.faces.as_slice()) + size_of_val(self.edges.as_slice())
    }
}
