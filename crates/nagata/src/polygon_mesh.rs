//! The input mesh: triangles and quadrilaterals over shared vertices.

use basemesh::{EdgeId, FaceId, TriMesh, VertexId, VertexMap};
use glam::DVec3;

use crate::edge_table::EdgeTable;
use crate::error::MeshError;
use crate::ids::Side;

const MAX_ELEMENTS: usize = u32::MAX as usize / 4;

/// Triangles and quadrilaterals over shared vertices; any number of faces may meet at an edge.
///
/// Faces are counter-clockwise seen from outside. Edges are numbered by their sorted pairs of vertex
/// ids. Open edges, edges with more than two faces and vertices without faces are allowed.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonMesh {
    positions: VertexMap<DVec3>,
    /// `stride` corners a face; a triangle among quadrilaterals repeats its last corner.
    corners: Vec<VertexId>,
    stride: usize,
    edges: EdgeTable,
}

impl PolygonMesh {
    /// A mesh from vertex positions and faces of three or four vertex indices.
    ///
    /// # Errors
    ///
    /// [`MeshError`] with the first offending element.
    pub fn new<F: AsRef<[usize]>>(positions: Vec<DVec3>, faces: &[F]) -> Result<Self, MeshError> {
        check_sizes(positions.len(), faces.len())?;
        for (face, corners) in faces.iter().enumerate() {
            check_face(face, corners.as_ref(), positions.len())?;
        }
        check_positions(&positions)?;
        let stride = if faces.iter().any(|f| f.as_ref().len() == 4) { 4 } else { 3 };
        let mut corners = Vec::with_capacity(stride * faces.len());
        for face in faces {
            let face = face.as_ref();
            corners.extend((0..stride).map(|c| VertexId::new(face[c.min(face.len() - 1)])));
        }
        Ok(Self::from_corners(VertexMap::from_vec(positions), corners, stride))
    }

    /// Moves all vertices.
    ///
    /// # Errors
    ///
    /// If there is not one position for each vertex, or one is not finite; then none is moved.
    pub fn set_positions(&mut self, positions: &[DVec3]) -> Result<(), MeshError> {
        let (given, expected) = (positions.len(), self.vertex_count());
        if given != expected {
            return Err(MeshError::Positions { given, expected });
        }
        check_positions(positions)?;
        self.positions.as_mut_slice().copy_from_slice(positions);
        Ok(())
    }

    /// Pairs the sides of checked faces.
    fn from_corners(positions: VertexMap<DVec3>, corners: Vec<VertexId>, stride: usize) -> Self {
        let sides = corners.chunks_exact(stride).enumerate().flat_map(|(face, corners)| {
            let corners = without_repetition(corners);
            (0..corners.len())
                .map(move |c| (stride * face + c, corners[c], corners[(c + 1) % corners.len()]))
        });
        let edges = EdgeTable::new(positions.len(), corners.len(), sides);
        Self { positions, corners, stride, edges }
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.corners.len() / self.stride
    }

    /// Number of edges.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.edges.edge_count()
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

    /// Positions of the vertices.
    #[must_use]
    pub fn positions(&self) -> &VertexMap<DVec3> {
        &self.positions
    }

    /// Position of a vertex.
    #[inline]
    #[must_use]
    pub fn position(&self, vertex: VertexId) -> DVec3 {
        self.positions[vertex]
    }

    /// The three or four corners of a face, counter-clockwise seen from outside.
    #[inline]
    #[must_use]
    pub fn corners(&self, face: FaceId) -> &[VertexId] {
        let at = self.stride * face.index();
        without_repetition(&self.corners[at..at + self.stride])
    }

    /// Whether no face is a quadrilateral.
    #[must_use]
    pub fn is_triangular(&self) -> bool {
        self.stride == 3
    }

    /// The sides of a face, from its first corner on.
    pub fn sides(&self, face: FaceId) -> impl ExactSizeIterator<Item = Side> + use<> {
        (0..self.corners(face).len()).map(move |corner| Side { face, corner })
    }

    /// Where a side starts and ends.
    #[inline]
    #[must_use]
    pub fn ends(&self, side: Side) -> [VertexId; 2] {
        let corners = self.corners(side.face);
        let next = if side.corner + 1 == corners.len() { 0 } else { side.corner + 1 };
        [corners[side.corner], corners[next]]
    }

    /// The edge of a side.
    #[inline]
    #[must_use]
    pub fn edge(&self, side: Side) -> EdgeId {
        self.edges.edge(self.slot(side))
    }

    /// The ends of an edge, the lower id first: the direction in which its curve is stored.
    #[inline]
    #[must_use]
    pub fn edge_vertices(&self, edge: EdgeId) -> [VertexId; 2] {
        self.edges.ends(edge)
    }

    /// The same of all edges.
    pub(crate) fn all_edge_vertices(&self) -> &[[VertexId; 2]] {
        self.edges.all_ends()
    }

    /// Whether a side runs from the lower to the higher vertex id.
    #[inline]
    #[must_use]
    pub fn runs_forward(&self, side: Side) -> bool {
        let [start, end] = self.ends(side);
        start < end
    }

    /// The sides at an edge: two on a smooth closed surface, one on a boundary, more where sheets
    /// meet. Ascending in faces.
    #[inline]
    pub fn sides_at(&self, edge: EdgeId) -> impl ExactSizeIterator<Item = Side> + '_ {
        self.edges.sides(edge).iter().map(|&slot| self.side(slot as usize))
    }

    /// The other sides at the edge of a side: where one comes out when walking across it.
    pub fn across(&self, side: Side) -> impl Iterator<Item = Side> + '_ {
        self.sides_at(self.edge(side)).filter(move |other| *other != side)
    }

    /// Whether every edge has two faces.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.edges().all(|edge| self.edges.sides(edge).len() == 2)
    }

    /// Vertices minus edges plus faces; vertices without faces count.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        let count = |n: usize| i64::try_from(n).expect("invariant: element counts fit 32 bits");
        count(self.vertex_count()) - count(self.edge_count()) + count(self.face_count())
    }

    /// Diagonal of the bounding box of the vertices.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        let all = self.positions.as_slice().iter();
        let (low, high) = all.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| {
            (low.min(p), high.max(p))
        });
        low.distance(high)
    }

    /// Number of corner slots: `stride` a face.
    pub(crate) fn slot_count(&self) -> usize {
        self.corners.len()
    }

    /// The slot of the corner where a side starts.
    #[inline]
    pub(crate) fn slot(&self, side: Side) -> usize {
        debug_assert!(side.corner < self.stride, "a face has no corner {}", side.corner);
        self.stride * side.face.index() + side.corner
    }

    /// The vertex of each slot; a slot left over repeats the last corner of its face.
    pub(crate) fn slots(&self) -> &[VertexId] {
        &self.corners
    }

    /// The slots of the corners at both ends of an edge, in each face there: `[lower, higher]`.
    #[inline]
    pub(crate) fn end_slots(&self, edge: EdgeId) -> impl Iterator<Item = [usize; 2]> + '_ {
        let [lower, _] = self.edges.ends(edge);
        self.edges.sides(edge).iter().map(move |&slot| {
            let start = slot as usize;
            let Side { face, corner } = self.side(start);
            let next =
                if corner + 1 == self.corners(face).len() { start - corner } else { start + 1 };
            if self.corners[start] == lower { [start, next] } else { [next, start] }
        })
    }

    /// Bytes on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.positions.as_slice()) + size_of_val(&*self.corners) + self.edges.bytes()
    }

    #[inline]
    fn side(&self, slot: usize) -> Side {
        // a division by a constant is faster
        if self.stride == 3 {
            Side { face: FaceId::new(slot / 3), corner: slot % 3 }
        } else {
            Side { face: FaceId::new(slot / 4), corner: slot % 4 }
        }
    }
}

impl From<&TriMesh> for PolygonMesh {
    fn from(mesh: &TriMesh) -> Self {
        let topology = mesh.topology();
        let corners = topology.faces().flat_map(|f| topology.corners(f)).collect();
        Self::from_corners(mesh.positions().clone(), corners, 3)
    }
}

/// The corners of a face without the last one of a triangle among quadrilaterals.
#[inline]
fn without_repetition(corners: &[VertexId]) -> &[VertexId] {
    let last = corners.len() - 1;
    if corners[last] == corners[last - 1] { &corners[..last] } else { corners }
}

fn check_sizes(vertices: usize, faces: usize) -> Result<(), MeshError> {
    if faces == 0 {
        return Err(MeshError::Empty);
    }
    if faces.max(vertices) > MAX_ELEMENTS {
        return Err(MeshError::TooLarge { faces, vertices, max: MAX_ELEMENTS });
    }
    Ok(())
}

fn check_positions(positions: &[DVec3]) -> Result<(), MeshError> {
    match positions.iter().enumerate().find(|(_, position)| !position.is_finite()) {
        Some((vertex, &position)) => Err(MeshError::NotFinite { vertex, position }),
        None => Ok(()),
    }
}

fn check_face(face: usize, corners: &[usize], count: usize) -> Result<(), MeshError> {
    if !(3..=4).contains(&corners.len()) {
        return Err(MeshError::Corners { face, corners: corners.len() });
    }
    for (c, &vertex) in corners.iter().enumerate() {
        if vertex >= count {
            return Err(MeshError::MissingVertex { face, vertex, count });
        }
        if corners[..c].contains(&vertex) {
            return Err(MeshError::RepeatedVertex { face, vertex });
        }
    }
    Ok(())
}
