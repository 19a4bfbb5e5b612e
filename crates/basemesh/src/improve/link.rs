//! The link condition: which collapses keep the topology.

use super::edit_mesh::EditMesh;
use crate::ids::{HalfedgeId, VertexId};

impl EditMesh {
    /// Whether collapsing the edge of `h` keeps the surface a manifold of the same topology: its
    /// ends have exactly two common neighbours, and neither of these would drop below valence 3.
    pub(crate) fn satisfies_link_condition(&self, h: HalfedgeId, scratch: &mut RingMarks) -> bool {
        let (a, b) = (self.origin(h), self.target(h));
        let stamp = scratch.next_stamp(self.vertex_slots());
        for g in self.fan(a) {
            scratch.marks[self.target(g).index()] = stamp;
        }
        let common =
            self.fan(b).filter(|&g| scratch.marks[self.target(g).index()] == stamp).count();
        let deep = |v: VertexId| self.fan(v).nth(3).is_some();
        common == 2 && deep(self.apex(h)) && deep(self.apex(self.twin(h)))
    }
}

/// Scratch marks over vertices, so that rings are intersected without allocating.
#[derive(Clone, Debug, Default)]
pub(crate) struct RingMarks {
    marks: Vec<u32>,
    stamp: u32,
}

impl RingMarks {
    fn next_stamp(&mut self, vertices: usize) -> u32 {
        if self.marks.len() < vertices || self.stamp == u32::MAX {
            self.marks = vec![0; vertices];
            self.stamp = 0;
        }
        self.stamp += 1;
        self.stamp
    }
}
