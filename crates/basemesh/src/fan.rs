//! The ordered star of a vertex.

use crate::ids::{HalfedgeId, VertexId};
use crate::topology::Topology;

impl Topology {
    /// The next outgoing half-edge of the same origin, counter-clockwise; `None` past a boundary.
    #[inline]
    #[must_use]
    pub fn rotated_ccw(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.twin(h.previous())
    }

    /// The next outgoing half-edge of the same origin, clockwise; `None` past a boundary.
    #[inline]
    #[must_use]
    pub fn rotated_cw(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.twin(h).map(HalfedgeId::next)
    }

    /// Outgoing half-edges of a vertex, counter-clockwise, one per incident face.
    ///
    /// The fan of an inner vertex starts at its half-edge towards the lowest-numbered neighbour, so
    /// that the order does not depend on how faces are numbered; the fan of a boundary vertex
    /// starts at the boundary.
    pub fn fan(&self, vertex: VertexId) -> Fan<'_> {
        let first = self.outgoing[vertex];
        let boundary = self.twin(first).is_none();
        let from = |start| Fan { topology: self, start, next: Some(start) };
        if boundary {
            return from(first);
        }
        from(from(first).min_by_key(|&h| self.target(h)).unwrap_or(first))
    }

    /// Number of faces around a vertex (its number of edges, if it is not on a boundary).
    #[must_use]
    pub fn valence(&self, vertex: VertexId) -> usize {
        let start = self.outgoing[vertex];
        Fan { topology: self, start, next: Some(start) }.count()
    }
}

/// Iterator over the outgoing half-edges of a vertex; see [`Topology::fan`].
#[derive(Clone, Debug)]
pub struct Fan<'a> {
    topology: &'a Topology,
    start: HalfedgeId,
    next: Option<HalfedgeId>,
}

impl Iterator for Fan<'_> {
    type Item = HalfedgeId;

    fn next(&mut self) -> Option<HalfedgeId> {
        let current = self.next?;
        self.next = self.topology.rotated_ccw(current).filter(|&h| h != self.start);
        Some(current)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_fan_starts_at_the_lowest_neighbour() {
        // an octahedron: 4 is the north pole
        let faces = [
            [0, 1, 4],
            [1, 2, 4],
            [2, 3, 4],
            [3, 0, 4],
            [1, 0, 5],
            [2, 1, 5],
            [3, 2, 5],
            [0, 3, 5],
        ];
        let t = Topology::from_faces(6, &faces).unwrap();
        let star: Vec<usize> = t.fan(VertexId::new(4)).map(|h| t.target(h).index()).collect();
        assert_eq!(star, [0, 1, 2, 3]);
    }

    #[test]
    fn boundary_fan_runs_from_boundary_to_boundary() {
        let t = Topology::from_faces(5, &[[4, 0, 1], [4, 1, 2], [4, 2, 3]]).unwrap();
        let star: Vec<usize> = t.fan(VertexId::new(4)).map(|h| t.target(h).index()).collect();
        assert_eq!(star, [0, 1, 2]);
        assert!(t.is_boundary_vertex(VertexId::new(4)));
        assert!(!t.is_closed());
        assert_eq!(t.valence(VertexId::new(1)), 2);
    }
}
