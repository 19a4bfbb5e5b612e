//! A triangle mesh: topology and a position for each vertex.

use glam::DVec3;
use thiserror::Error;

use crate::build::TopologyError;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::maps::VertexMap;
use crate::topology::Topology;

/// Why positions and faces do not make a mesh.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The faces are not an oriented manifold.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has the position {position}, which is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
}

/// An oriented manifold triangle mesh with finite vertex positions.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TriMesh {
    topology: Topology,
    positions: VertexMap<DVec3>,
}

impl TriMesh {
    /// A mesh from vertex positions and faces of three vertex indices, counter-clockwise seen from
    /// outside.
    ///
    /// # Errors
    ///
    /// [`MeshError`] with the first offending element.
    pub fn new(positions: Vec<DVec3>, faces: &[[usize; 3]]) -> Result<Self, MeshError> {
        let topology = Topology::from_faces(positions.len(), faces)?;
        check_finite(&positions)?;
        Ok(Self { topology, positions: VertexMap::from_vec(positions) })
    }

    /// The connectivity.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// All vertex positions.
    #[must_use]
    pub fn positions(&self) -> &VertexMap<DVec3> {
        &self.positions
    }

    /// The same connectivity with other positions.
    ///
    /// # Errors
    ///
    /// [`MeshError::NotFinite`] for the first position that is not finite.
    ///
    /// # Panics
    ///
    /// If the number of positions is not the number of vertices.
    pub fn with_positions(self, positions: VertexMap<DVec3>) -> Result<Self, MeshError> {
        assert_eq!(positions.len(), self.positions.len(), "one position per vertex");
        check_finite(positions.as_slice())?;
        Ok(Self { topology: self.topology, positions })
    }

    /// Position of a vertex.
    #[inline]
    #[must_use]
    pub fn position(&self, vertex: VertexId) -> DVec3 {
        self.positions[vertex]
    }

    /// Corner positions of a face, counter-clockwise seen from outside.
    #[inline]
    #[must_use]
    pub fn triangle(&self, face: FaceId) -> [DVec3; 3] {
        self.topology.corners(face).map(|v| self.positions[v])
    }

    /// Length of an edge.
    #[must_use]
    pub fn edge_length(&self, edge: EdgeId) -> f64 {
        let [a, b] = self.topology.edge_vertices(edge);
        self.positions[a].distance(self.positions[b])
    }

    /// Lower and upper corner of the axis-parallel bounding box.
    #[must_use]
    pub fn bounding_box(&self) -> [DVec3; 2] {
        self.positions
            .as_slice()
            .iter()
            .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], &p| [lo.min(p), hi.max(p)])
    }

    /// Diagonal of the axis-parallel bounding box: the length that tolerances are relative to.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        let [lo, hi] = self.bounding_box();
        lo.distance(hi)
    }

    /// Faces as plain indices, in id order.
    #[must_use]
    pub fn face_indices(&self) -> Vec<[usize; 3]> {
        self.topology.faces().map(|f| self.topology.corners(f).map(VertexId::index)).collect()
    }
}

fn check_finite(positions: &[DVec3]) -> Result<(), MeshError> {
    match positions.iter().position(|p| !p.is_finite()) {
        Some(vertex) => Err(MeshError::NotFinite { vertex, position: positions[vertex] }),
        None => Ok(()),
    }
}
