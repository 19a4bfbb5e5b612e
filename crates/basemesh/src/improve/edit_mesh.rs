//! A closed triangle mesh that can be edited in place.

use glam::DVec3;

use crate::ids::{EdgeId, FaceId, HalfedgeId, VertexId};
use crate::mesh::TriMesh;

/// A closed oriented triangle mesh in flat arrays: half-edge `3 f + c` runs from corner `c` of face
/// `f` to the next corner, and only twins are stored.
///
/// Collapsed elements leave dead slots until [`compact`](Self::compact). Nothing here allocates per
/// edit except the splits, which append.
#[derive(Clone, Debug)]
pub(crate) struct EditMesh {
    corners: Vec<[VertexId; 3]>,
    twins: Vec<HalfedgeId>,
    outgoing: Vec<HalfedgeId>,
    positions: Vec<DVec3>,
    face_alive: Vec<bool>,
    vertex_alive: Vec<bool>,
    live_faces: usize,
}

impl EditMesh {
    /// A copy of a closed mesh.
    ///
    /// # Errors
    ///
    /// The first edge that has one face only.
    pub(crate) fn from_mesh(mesh: &TriMesh) -> Result<Self, EdgeId> {
        let t = mesh.topology();
        if let Some(open) = t.edges().find(|&e| t.is_boundary_edge(e)) {
            return Err(open);
        }
        let corners: Vec<_> = t.faces().map(|f| t.corners(f)).collect();
        let twins: Vec<_> = t.halfedges().filter_map(|h| t.twin(h)).collect();
        let mut outgoing = vec![HalfedgeId::new(0); t.vertex_count()];
        for h in t.halfedges() {
            outgoing[t.origin(h).index()] = h;
        }
        Ok(Self {
            live_faces: corners.len(),
            face_alive: vec![true; corners.len()],
            vertex_alive: vec![true; outgoing.len()],
            positions: mesh.positions().as_slice().to_vec(),
            corners,
            twins,
            outgoing,
        })
    }

    /// Number of faces that are alive.
    pub(crate) fn face_count(&self) -> usize {
        self.live_faces
    }

    /// Number of face slots, dead ones included.
    pub(crate) fn face_slots(&self) -> usize {
        self.corners.len()
    }

    /// Number of vertex slots, dead ones included.
    pub(crate) fn vertex_slots(&self) -> usize {
        self.outgoing.len()
    }

    pub(crate) fn is_live_vertex(&self, v: VertexId) -> bool {
        self.vertex_alive[v.index()]
    }

    pub(crate) fn is_live_halfedge(&self, h: HalfedgeId) -> bool {
        self.face_alive[h.face().index()]
    }

    /// Vertices that are alive, in id order.
    pub(crate) fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        (0..self.outgoing.len()).filter(|&v| self.vertex_alive[v]).map(VertexId::new)
    }

    /// Faces that are alive, in id order.
    pub(crate) fn faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        (0..self.corners.len()).filter(|&f| self.face_alive[f]).map(FaceId::new)
    }

    /// One half-edge of every live edge, in id order of the lower of its two half-edges.
    pub(crate) fn edges(&self) -> impl Iterator<Item = HalfedgeId> + '_ {
        (0..self.twins.len())
            .map(HalfedgeId::new)
            .filter(|&h| self.is_live_halfedge(h) && h < self.twin(h))
    }

    #[inline]
    pub(crate) fn corners(&self, face: FaceId) -> [VertexId; 3] {
        self.corners[face.index()]
    }

    #[inline]
    pub(crate) fn origin(&self, h: HalfedgeId) -> VertexId {
        self.corners[h.face().index()][h.corner()]
    }

    #[inline]
    pub(crate) fn target(&self, h: HalfedgeId) -> VertexId {
        self.origin(h.next())
    }

    /// The corner opposite a half-edge in its face.
    #[inline]
    pub(crate) fn apex(&self, h: HalfedgeId) -> VertexId {
        self.origin(h.previous())
    }

    #[inline]
    pub(crate) fn twin(&self, h: HalfedgeId) -> HalfedgeId {
        self.twins[h.index()]
    }

    #[inline]
    pub(crate) fn position(&self, v: VertexId) -> DVec3 {
        self.positions[v.index()]
    }

    pub(crate) fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    pub(crate) fn set_position(&mut self, v: VertexId, p: DVec3) {
        self.positions[v.index()] = p;
    }

    #[inline]
    pub(crate) fn triangle(&self, face: FaceId) -> [DVec3; 3] {
        self.corners(face).map(|v| self.position(v))
    }

    /// Outgoing half-edges of a vertex, counter-clockwise.
    #[inline]
    pub(crate) fn fan(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        self.fan_from(self.outgoing[v.index()])
    }

    /// Outgoing half-edges of the origin of `start`, counter-clockwise from `start`.
    #[inline]
    pub(crate) fn fan_from(&self, start: HalfedgeId) -> impl Iterator<Item = HalfedgeId> + '_ {
        let step = move |&h: &HalfedgeId| Some(self.twin(h.previous())).filter(|&n| n != start);
        std::iter::successors(Some(start), step)
    }

    pub(crate) fn valence(&self, v: VertexId) -> usize {
        self.fan(v).count()
    }

    /// Length of the longest edge of a vertex.
    pub(crate) fn longest_edge(&self, v: VertexId) -> f64 {
        let from = self.position(v);
        let length = |h| self.position(self.target(h)).distance_squared(from);
        self.fan(v).map(length).fold(0.0, f64::max).sqrt()
    }

    pub(crate) fn length(&self, h: HalfedgeId) -> f64 {
        self.position(self.origin(h)).distance(self.position(self.target(h)))
    }

    pub(crate) fn are_adjacent(&self, a: VertexId, b: VertexId) -> bool {
        self.fan(a).any(|h| self.target(h) == b)
    }

    /// Merges the target of `h` into its origin, which keeps its id and its position.
    ///
    /// The caller has checked the link condition. Half-edges that touch neither end keep their ids.
    pub(crate) fn collapse(&mut self, h: HalfedgeId) {
        let t = self.twin(h);
        let (kept, gone) = (self.origin(h), self.target(h));
        let mut g = h.next();
        loop {
            let [face, corner] = [g.face().index(), g.corner()];
            self.corners[face][corner] = kept;
            g = self.twin(g.previous());
            if g == h.next() {
                break;
            }
        }
        for side in [h, t] {
            let (first, second) = (self.twin(side.next()), self.twin(side.previous()));
            self.join(first, second);
            self.face_alive[side.face().index()] = false;
            for outer in [first, second] {
                let origin = self.origin(outer);
                self.outgoing[origin.index()] = outer;
            }
        }
        self.vertex_alive[gone.index()] = false;
        self.live_faces -= 2;
    }

    /// Turns the edge of `h` inside the quadrilateral of its two faces.
    ///
    /// The caller has checked that the two opposite corners are not adjacent yet.
    pub(crate) fn flip(&mut self, h: HalfedgeId) {
        let t = self.twin(h);
        let (a, b, c, d) = (self.origin(h), self.target(h), self.apex(h), self.apex(t));
        let outer = [t.next(), h.previous(), h.next(), t.previous()].map(|g| self.twin(g));
        let (f, g) = (h.face(), t.face());
        self.set_face(f, [a, d, c]);
        self.set_face(g, [b, c, d]);
        let [ad, ca, bc, db] = outer;
        self.join(f.halfedge(0), ad);
        self.join(f.halfedge(1), g.halfedge(1));
        self.join(f.halfedge(2), ca);
        self.join(g.halfedge(0), bc);
        self.join(g.halfedge(2), db);
    }

    /// Puts a new vertex on the edge of `h` and cuts both its faces in two.
    pub(crate) fn split(&mut self, h: HalfedgeId, position: DVec3) {
        let t = self.twin(h);
        let (a, b, c, d) = (self.origin(h), self.target(h), self.apex(h), self.apex(t));
        let [bc, ca, ad, db] =
            [h.next(), h.previous(), t.next(), t.previous()].map(|g| self.twin(g));
        let m = VertexId::new(self.positions.len());
        self.positions.push(position);
        self.vertex_alive.push(true);
        self.outgoing.push(h);
        let (f, g) = (h.face(), t.face());
        let (f2, g2) = (self.push_face([m, b, c]), self.push_face([m, a, d]));
        self.set_face(f, [a, m, c]);
        self.set_face(g, [b, m, d]);
        self.join(f.halfedge(2), ca);
        self.join(f2.halfedge(1), bc);
        self.join(g.halfedge(2), db);
        self.join(g2.halfedge(1), ad);
        self.join(f.halfedge(1), f2.halfedge(2));
        self.join(g.halfedge(1), g2.halfedge(2));
        self.join(f.halfedge(0), g2.halfedge(0));
        self.join(g.halfedge(0), f2.halfedge(0));
    }

    fn push_face(&mut self, corners: [VertexId; 3]) -> FaceId {
        let face = FaceId::new(self.corners.len());
        self.corners.push(corners);
        self.face_alive.push(true);
        self.twins.extend(face.halfedges());
        self.live_faces += 1;
        self.set_face(face, corners);
        face
    }

    fn set_face(&mut self, face: FaceId, corners: [VertexId; 3]) {
        self.corners[face.index()] = corners;
        for (corner, v) in corners.into_iter().enumerate() {
            self.outgoing[v.index()] = face.halfedge(corner);
        }
    }

    fn join(&mut self, a: HalfedgeId, b: HalfedgeId) {
        self.twins[a.index()] = b;
        self.twins[b.index()] = a;
    }

    /// Removes dead slots, keeping the order of what lives; returns the old ids of the vertices.
    pub(crate) fn compact(&mut self) -> Vec<VertexId> {
        let kept: Vec<VertexId> = self.vertices().collect();
        let faces: Vec<FaceId> = self.faces().collect();
        let mut new_vertex = vec![VertexId::new(0); self.vertex_slots()];
        for (new, old) in kept.iter().enumerate() {
            new_vertex[old.index()] = VertexId::new(new);
        }
        let mut new_face = vec![FaceId::new(0); self.face_slots()];
        for (new, old) in faces.iter().enumerate() {
            new_face[old.index()] = FaceId::new(new);
        }
        let moved = |h: HalfedgeId| new_face[h.face().index()].halfedge(h.corner());
        for (new, old) in faces.iter().enumerate() {
            self.corners[new] = self.corners(*old).map(|v| new_vertex[v.index()]);
            for corner in 0..3 {
                self.twins[3 * new + corner] = moved(self.twin(old.halfedge(corner)));
            }
        }
        for (new, old) in kept.iter().enumerate() {
            self.outgoing[new] = moved(self.outgoing[old.index()]);
            self.positions[new] = self.position(*old);
        }
        self.truncate(kept.len(), faces.len());
        kept
    }

    fn truncate(&mut self, vertices: usize, faces: usize) {
        self.corners.truncate(faces);
        self.twins.truncate(3 * faces);
        self.outgoing.truncate(vertices);
        self.positions.truncate(vertices);
        self.face_alive = vec![true; faces];
        self.vertex_alive = vec![true; vertices];
    }

    /// The mesh without dead slots; vertex order is kept.
    pub(crate) fn into_mesh(mut self) -> TriMesh {
        self.compact();
        let faces: Vec<[usize; 3]> = self.corners.iter().map(|f| f.map(VertexId::index)).collect();
        TriMesh::new(self.positions, &faces).expect("invariant: edits keep a finite manifold mesh")
    }
}
