//! The points of a regular lattice on every face, with those on edges and corners numbered once.
//!
//! With `D` divisions, ids `0..V` are the vertices; then each edge has `D - 1` points, in edge order
//! and in the direction of its canonical half-edge; then each face has its `(D - 1) (D - 2) / 2`
//! interior points, by rank. The same numbering serves control nets of degree `D`, interpolation
//! points of degree `D`, and tessellations.

use basemesh::{EdgeId, FaceId, FaceMap, Topology, VertexId, VertexMap};
use bezier_core::{Barycentric, BezierTriangle, Corner, LocalEdge, MultiIndex};
use glam::DVec3;
use thiserror::Error;

/// Two faces give a point that they share different positions.
///
/// Positions are compared bit for bit, so 0 and -0 differ.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SharedPointError {
    /// A point inside an edge.
    #[error(
        "faces {owner} and {face} disagree about point {step} of {degree} of their edge {edge}: \
         {owner_position} against {position}; copy the boundary row of one to the other"
    )]
    Edge {
        /// The edge.
        edge: EdgeId,
        /// Index of the point along the canonical half-edge, ends included.
        step: usize,
        /// Polynomial degree.
        degree: usize,
        /// The face of the canonical half-edge.
        owner: FaceId,
        /// The point of that face.
        owner_position: DVec3,
        /// The other face.
        face: FaceId,
        /// The point of the other face.
        position: DVec3,
    },
    /// A corner.
    #[error(
        "faces {owner} and {face} disagree about their vertex {vertex}: {owner_position} against \
         {position}; copy the corner of one to the other"
    )]
    Vertex {
        /// The vertex.
        vertex: VertexId,
        /// The lowest face at this vertex.
        owner: FaceId,
        /// The corner of that face.
        owner_position: DVec3,
        /// The other face.
        face: FaceId,
        /// The corner of the other face.
        position: DVec3,
    },
}

/// Where a lattice point lies in its triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Site {
    Corner(Corner),
    Edge { edge: LocalEdge, step: usize },
    Interior(usize),
}

/// The numbering; see the module.
#[derive(Debug)]
pub(crate) struct Lattice<'a> {
    topology: &'a Topology,
    divisions: usize,
    sites: Vec<Site>,
    interior_count: usize,
    lowest_face: VertexMap<FaceId>,
}

impl<'a> Lattice<'a> {
    /// A lattice with this many steps along each edge; at least one.
    pub(crate) fn new(topology: &'a Topology, divisions: usize) -> Self {
        assert!(divisions >= 1, "a lattice needs at least one division");
        let mut interior_count = 0;
        let sites = MultiIndex::all(divisions).map(|m| site_of(m, &mut interior_count)).collect();
        let mut lowest_face = VertexMap::from_vec(vec![FaceId::new(0); topology.vertex_count()]);
        for face in (0..topology.face_count()).rev().map(FaceId::new) {
            for vertex in topology.corners(face) {
                lowest_face[vertex] = face;
            }
        }
        Self { topology, divisions, sites, interior_count, lowest_face }
    }

    /// Number of points: `V + (D - 1) E + (D - 1) (D - 2) / 2 F`.
    pub(crate) fn point_count(&self) -> usize {
        self.first_interior(FaceId::new(self.topology.face_count()))
    }

    fn first_on(&self, edge: EdgeId) -> usize {
        self.topology.vertex_count() + (self.divisions - 1) * edge.index()
    }

    fn first_interior(&self, face: FaceId) -> usize {
        self.first_on(EdgeId::new(self.topology.edge_count())) + self.interior_count * face.index()
    }

    /// Id of the point with this rank in this face, and the one face that decides its position.
    #[inline]
    pub(crate) fn locate(&self, face: FaceId, rank: usize) -> (usize, FaceId) {
        match self.sites[rank] {
            Site::Corner(corner) => {
                let vertex = self.topology.corners(face)[corner.index()];
                (vertex.index(), self.lowest_face[vertex])
            }
            Site::Edge { edge, step } => {
                let (edge, step) = self.on_canonical(face, edge, step);
                (self.first_on(edge) + step - 1, self.topology.canonical(edge).face())
            }
            Site::Interior(index) => (self.first_interior(face) + index, face),
        }
    }

    /// The edge, and the step counted along its canonical half-edge.
    fn on_canonical(&self, face: FaceId, edge: LocalEdge, step: usize) -> (EdgeId, usize) {
        let halfedge = face.halfedge(edge.start().index());
        let edge = self.topology.edge(halfedge);
        let forward = self.topology.canonical(edge) == halfedge;
        (edge, if forward { step } else { self.divisions - step })
    }

    /// The control points of all patches, shared ones once.
    ///
    /// The divisions of the lattice must be the degree of the patches.
    ///
    /// # Errors
    ///
    /// [`SharedPointError`] for the lowest face that disagrees with another one.
    pub(crate) fn gather<const P: usize>(
        &self,
        nets: &FaceMap<BezierTriangle<DVec3, P>>,
    ) -> Result<Vec<DVec3>, SharedPointError> {
        let mut points = vec![DVec3::ZERO; self.point_count()];
        for (face, patch) in nets.iter() {
            for (rank, &point) in patch.net().iter().enumerate() {
                let (id, owner) = self.locate(face, rank);
                if owner == face {
                    points[id] = point;
                }
            }
        }
        for (face, patch) in nets.iter() {
            for (rank, &point) in patch.net().iter().enumerate() {
                let (id, owner) = self.locate(face, rank);
                if owner != face && bits(points[id]) != bits(point) {
                    return Err(self.disagreement(face, rank, points[id], point));
                }
            }
        }
        Ok(points)
    }

    /// Points on all patches at the lattice parameters, shared ones from their owner.
    pub(crate) fn sample<const P: usize>(
        &self,
        nets: &FaceMap<BezierTriangle<DVec3, P>>,
    ) -> Vec<DVec3> {
        let mut points = vec![DVec3::ZERO; self.point_count()];
        let parameters: Vec<_> = Barycentric::lattice(self.divisions).collect();
        for (face, patch) in nets.iter() {
            for (rank, &at) in parameters.iter().enumerate() {
                let (id, owner) = self.locate(face, rank);
                if owner == face {
                    points[id] = self.corner_of(patch, rank).unwrap_or_else(|| patch.eval(at));
                }
            }
        }
        points
    }

    /// The control point of a patch at this lattice point if it is a corner: it needs no evaluation.
    pub(crate) fn corner_of<const P: usize>(
        &self,
        patch: &BezierTriangle<DVec3, P>,
        rank: usize,
    ) -> Option<DVec3> {
        match self.sites[rank] {
            Site::Corner(corner) => {
                let degree = BezierTriangle::<DVec3, P>::DEGREE;
                Some(patch[MultiIndex::along(LocalEdge::starting_at(corner), degree, 0, 0)])
            }
            _ => None,
        }
    }

    fn disagreement(
        &self,
        face: FaceId,
        rank: usize,
        owner_position: DVec3,
        position: DVec3,
    ) -> SharedPointError {
        let (_, owner) = self.locate(face, rank);
        match self.sites[rank] {
            Site::Edge { edge, step } => {
                let (edge, step) = self.on_canonical(face, edge, step);
                let degree = self.divisions;
                SharedPointError::Edge { edge, step, degree, owner, owner_position, face, position }
            }
            Site::Corner(corner) => {
                let vertex = self.topology.corners(face)[corner.index()];
                SharedPointError::Vertex { vertex, owner, owner_position, face, position }
            }
            Site::Interior(_) => unreachable!("invariant: interior points have one owner"),
        }
    }
}

/// The three coordinates, to compare bit for bit.
pub(crate) fn bits(point: DVec3) -> [u64; 3] {
    point.to_array().map(f64::to_bits)
}

/// The site of a lattice point; interior ones are counted.
pub(crate) fn site_of(m: MultiIndex, interior_count: &mut usize) -> Site {
    let exponents = [m.i, m.j, m.k];
    let degree = m.degree();
    if let Some(corner) = Corner::ALL.into_iter().find(|c| exponents[c.index()] == degree) {
        return Site::Corner(corner);
    }
    if let Some(apex) = Corner::ALL.into_iter().find(|c| exponents[c.index()] == 0) {
        let edge = LocalEdge::opposite(apex);
        return Site::Edge { edge, step: exponents[edge.end().index()] };
    }
    *interior_count += 1;
    Site::Interior(*interior_count - 1)
}
