//! The surface: all tetrahedra with their weights.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh, VertexMap};
use glam::DVec3;

use super::build;
use super::edge::{EdgePatch, EdgeRecord, EdgeSide, places};
use super::error::SurfaceError;
use super::face::{FacePatch, FaceRecord};
use super::kinds::Side;
use super::repair::{Normals, repaired_hull};
use super::report::Report;
use super::settings::Settings;
use super::validity::{Wedge, wedge};
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
    pub(crate) faces: FaceMap<FaceRecord>,
    pub(crate) edges: EdgeMap<EdgeRecord>,
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

    /// The function over a face. Put together from half as many numbers: keep it for many points.
    #[inline]
    #[must_use]
    pub fn face(&self, face: FaceId) -> FacePatch {
        self.faces[face].patch(self.mesh.triangle(face))
    }

    /// The function over an edge. Put together from the numbers of its faces: keep it for many
    /// points.
    #[inline]
    #[must_use]
    pub fn edge(&self, edge: EdgeId) -> EdgePatch {
        self.edge_with(edge, Side::BOTH.map(|side| self.edge_side(edge, side)))
    }

    #[inline]
    pub(crate) fn edge_with(&self, edge: EdgeId, sides: [Option<EdgeSide>; 2]) -> EdgePatch {
        EdgePatch {
            ends: self.mesh.topology().edge_vertices(edge).map(|v| self.mesh.position(v)),
            convexity: self.edges[edge].convexity,
            weights: self.edge_weights(edge),
            sides,
        }
    }

    /// One tetrahedron of an edge.
    #[inline]
    pub(crate) fn edge_side(&self, edge: EdgeId, side: Side) -> Option<EdgeSide> {
        let apices = self.edges[edge].apices[side.index()]?;
        let topology = self.mesh.topology();
        let places = places(topology, topology.canonical(edge))?;
        EdgeSide::of_faces(places, &self.faces, side, apices)
    }

    /// The weights on an edge, as [`EdgePatch::weights`].
    #[inline]
    pub(crate) fn edge_weights(&self, edge: EdgeId) -> [f64; 2] {
        let h = self.mesh.topology().canonical(edge);
        let e = &self.faces[h.face()].e;
        [e[h.corner()][0], e[h.next().corner()][1]]
    }

    /// The angles at an edge on one side; `None` if it has no tetrahedron there.
    #[must_use]
    pub fn wedge(&self, edge: EdgeId, side: Side) -> Option<Wedge> {
        let tetrahedron = self.edge_tetrahedron(edge, side)?;
        let [right, _, _, left] = tetrahedron.corners;
        wedge(&self.mesh, edge, side, [left, right])
    }

    /// The free weight of a face's tetrahedron; `None` if it has none on this side.
    #[must_use]
    pub fn free_weight(&self, face: FaceId, side: Side) -> Option<f64> {
        self.faces[face].sides[side.index()].map(|s| s.free)
    }

    /// The tetrahedron over a face: its corners, then the apex.
    #[must_use]
    pub fn face_tetrahedron(&self, face: FaceId, side: Side) -> Option<Tetrahedron> {
        let [a, b, c] = self.mesh.triangle(face);
        self.faces[face].sides[side.index()].map(|s| Tetrahedron::new([a, b, c, s.apex]))
    }

    /// The tetrahedron over an edge: apex of its right face, its ends along the canonical half-edge,
    /// apex of its left face.
    #[must_use]
    pub fn edge_tetrahedron(&self, edge: EdgeId, side: Side) -> Option<Tetrahedron> {
        self.edges[edge].apices[side.index()]?;
        let topology = self.mesh.topology();
        let [left, right] = places(topology, topology.canonical(edge))?
            .map(|p| self.faces[p.face].sides[side.index()].map(|s| s.apex));
        let [i, j] = topology.edge_vertices(edge).map(|v| self.mesh.position(v));
        Some(Tetrahedron::new([right?, i, j, left?]))
    }

    /// Value and gradient of the function at barycentric coordinates of a face's tetrahedron.
    #[must_use]
    pub fn face_value(&self, face: FaceId, side: Side, at: [f64; 4]) -> Option<(f64, DVec3)> {
        let patch = self.face(face);
        let s = patch.sides[side.index()].as_ref()?;
        let (value, slopes) = s.jet(&patch.base, at);
        Some((value, gradient(slopes, &s.tetrahedron(&patch.corners).gradients())))
    }

    /// Value and gradient of the function at barycentric coordinates of an edge's tetrahedron.
    #[must_use]
    pub fn edge_value(&self, edge: EdgeId, side: Side, at: [f64; 4]) -> Option<(f64, DVec3)> {
        let s = self.edge_side(edge, side)?;
        let (value, slopes) = s.jet(self.edge_weights(edge), at);
        let gradients = self.edge_tetrahedron(edge, side)?.gradients();
        Some((value, gradient(slopes, &gradients)))
    }

    /// Bytes on the heap for faces and edges, without what allocators add.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.faces.as_slice()) + size_of_val(self.edges.as_slice())
    }
}
