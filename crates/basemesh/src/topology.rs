//! Who is whose neighbour: faces, twins and edges of an oriented triangle mesh, without coordinates.

use crate::ids::{EdgeId, FaceId, HalfedgeId, VertexId};
use crate::maps::{EdgeMap, FaceMap, HalfedgeMap, VertexMap};

/// Connectivity of an oriented, edge-manifold and vertex-manifold triangle mesh, with or without
/// boundary.
///
/// Built by [`Topology::from_faces`], which refuses anything else. Half-edges are numbered
/// `3 * face + corner`, so only twins are stored. Edges are numbered by their sorted vertex pairs
/// `(lower, higher)`; the *canonical* half-edge of an edge runs from the lower vertex id to the
/// higher where a face offers it, otherwise (on a boundary) it is the one that exists.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Topology {
    pub(crate) faces: FaceMap<[VertexId; 3]>,
    pub(crate) twins: HalfedgeMap<Option<HalfedgeId>>,
    pub(crate) edge_of: HalfedgeMap<EdgeId>,
    pub(crate) canonical: EdgeMap<HalfedgeId>,
    /// An outgoing half-edge; on a boundary the one from which all others are counter-clockwise.
    pub(crate) outgoing: VertexMap<HalfedgeId>,
}

impl Topology {
    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.outgoing.len()
    }

    /// Number of faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// Number of edges.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.canonical.len()
    }

    /// Number of half-edges, three a face.
    #[must_use]
    pub fn halfedge_count(&self) -> usize {
        self.twins.len()
    }

    /// All vertices in id order.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertex_count()).map(VertexId::new)
    }

    /// All faces in id order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count()).map(FaceId::new)
    }

    /// All edges in id order.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = EdgeId> + use<> {
        (0..self.edge_count()).map(EdgeId::new)
    }

    /// All half-edges in id order.
    pub fn halfedges(&self) -> impl ExactSizeIterator<Item = HalfedgeId> + use<> {
        (0..self.halfedge_count()).map(HalfedgeId::new)
    }

    /// The corners of a face, counter-clockwise seen from outside.
    #[inline]
    #[must_use]
    pub fn corners(&self, face: FaceId) -> [VertexId; 3] {
        self.faces[face]
    }

    /// Vertex where a half-edge starts.
    #[inline]
    #[must_use]
    pub fn origin(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face()][h.corner()]
    }

    /// Vertex where a half-edge ends.
    #[inline]
    #[must_use]
    pub fn target(&self, h: HalfedgeId) -> VertexId {
        self.origin(h.next())
    }

    /// The opposite half-edge in the neighbouring face; `None` on a boundary.
    #[inline]
    #[must_use]
    pub fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.twins[h]
    }

    /// The undirected edge of a half-edge.
    #[inline]
    #[must_use]
    pub fn edge(&self, h: HalfedgeId) -> EdgeId {
        self.edge_of[h]
    }

    /// The canonical half-edge of an edge: from the lower vertex id to the higher if there is one.
    #[inline]
    #[must_use]
    pub fn canonical(&self, edge: EdgeId) -> HalfedgeId {
        self.canonical[edge]
    }

    /// Ends of an edge, in the direction of its canonical half-edge.
    #[inline]
    #[must_use]
    pub fn edge_vertices(&self, edge: EdgeId) -> [VertexId; 2] {
        let h = self.canonical(edge);
        [self.origin(h), self.target(h)]
    }

    /// Whether only one face uses this edge.
    #[must_use]
    pub fn is_boundary_edge(&self, edge: EdgeId) -> bool {
        self.twin(self.canonical(edge)).is_none()
    }

    /// Whether the surface ends at this vertex.
    #[must_use]
    pub fn is_boundary_vertex(&self, vertex: VertexId) -> bool {
        self.twin(self.outgoing[vertex]).is_none()
    }

    /// Whether every edge has two faces.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.twins.as_slice().iter().all(Option::is_some)
    }

    /// Vertices minus edges plus faces: `2 - 2 genus` for each closed component.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        let count = |n: usize| i64::try_from(n).expect("invariant: element counts fit 32 bits");
        count(self.vertex_count()) - count(self.edge_count()) + count(self.face_count())
    }

    /// Number of connected components.
    #[must_use]
    pub fn component_count(&self) -> usize {
        let mut seen = vec![false; self.face_count()];
        let mut stack = Vec::new();
        let mut components = 0;
        for start in self.faces() {
            if seen[start.index()] {
                continue;
            }
            components += 1;
            seen[start.index()] = true;
            stack.push(start);
            while let Some(face) = stack.pop() {
                for twin in face.halfedges().into_iter().filter_map(|h| self.twin(h)) {
                    let neighbour = twin.face();
                    if !std::mem::replace(&mut seen[neighbour.index()], true) {
                        stack.push(neighbour);
                    }
                }
            }
        }
        components
    }
}
