//! Which sides meet at which edge.

use basemesh::{EdgeId, EdgeMap, VertexId};

/// Edges numbered by their sorted pairs of vertex ids, and the sides at each, in any number.
///
/// Sides are numbered `stride * face + corner`. Where faces have fewer corners than the stride, the
/// slots left over belong to no edge.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct EdgeTable {
    /// The edge of each side; meaningless for slots left over.
    edge_of: Vec<EdgeId>,
    /// Lower and higher vertex of each edge.
    ends: EdgeMap<[VertexId; 2]>,
    /// Where the sides of each edge start in `sides`, and their number at the end.
    first: Vec<u32>,
    /// Sides by edge, ascending.
    sides: Vec<u32>,
}

/// One side waiting for its edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Pending {
    higher: u32,
    side: u32,
}

impl EdgeTable {
    /// The edges of `sides`, given as `(number, start, end)`; time and memory are linear.
    ///
    /// `slots` is one more than the largest side number possible.
    pub(crate) fn new(
        vertex_count: usize,
        slots: usize,
        sides: impl Iterator<Item = (usize, VertexId, VertexId)> + Clone,
    ) -> Self {
        let (starts, pending) = by_lower_vertex(vertex_count, sides);
        let mut table = Self {
            edge_of: vec![EdgeId::new(0); slots],
            ends: EdgeMap::from_vec(Vec::new()),
            first: Vec::with_capacity(pending.len() / 2 + 1),
            sides: Vec::with_capacity(pending.len()),
        };
        let mut ends = Vec::with_capacity(pending.len() / 2);
        let mut pending = pending;
        for (lower, range) in starts.windows(2).enumerate() {
            let at_vertex = &mut pending[range[0] as usize..range[1] as usize];
            at_vertex.sort_unstable();
            for group in at_vertex.chunk_by(|a, b| a.higher == b.higher) {
                let edge = EdgeId::new(ends.len());
                ends.push([VertexId::new(lower), VertexId::new(group[0].higher as usize)]);
                table.first.push(short(table.sides.len()));
                for side in group.iter().map(|p| p.side) {
                    table.edge_of[side as usize] = edge;
                    table.sides.push(side);
                }
            }
        }
        table.first.push(short(table.sides.len()));
        table.first.shrink_to_fit();
        ends.shrink_to_fit();
        table.ends = EdgeMap::from_vec(ends);
        table
    }

    pub(crate) fn edge_count(&self) -> usize {
        self.ends.len()
    }

    #[inline]
    pub(crate) fn edge(&self, side: usize) -> EdgeId {
        self.edge_of[side]
    }

    /// Lower and higher vertex.
    #[inline]
    pub(crate) fn ends(&self, edge: EdgeId) -> [VertexId; 2] {
        self.ends[edge]
    }

    /// The same of all edges.
    pub(crate) fn all_ends(&self) -> &[[VertexId; 2]] {
        self.ends.as_slice()
    }

    /// Numbers of the sides at an edge, ascending.
    #[inline]
    pub(crate) fn sides(&self, edge: EdgeId) -> &[u32] {
        let e = edge.index();
        &self.sides[self.first[e] as usize..self.first[e + 1] as usize]
    }

    /// Bytes on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.edge_of)
            + size_of_val(self.ends.as_slice())
            + size_of_val(&*self.first)
            + size_of_val(&*self.sides)
    }
}

fn short(n: usize) -> u32 {
    u32::try_from(n).expect("invariant: element counts fit 32 bits")
}

/// Sorts sides by their lower vertex (counting sort): where each vertex starts, and the sides.
fn by_lower_vertex(
    vertex_count: usize,
    sides: impl Iterator<Item = (usize, VertexId, VertexId)> + Clone,
) -> (Vec<u32>, Vec<Pending>) {
    let mut starts = vec![0_u32; vertex_count + 1];
    for (_, a, b) in sides.clone() {
        starts[a.min(b).index() + 1] += 1;
    }
    for v in 0..vertex_count {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut pending = vec![Pending { higher: 0, side: 0 }; starts[vertex_count] as usize];
    for (side, a, b) in sides {
        let slot = &mut next[a.min(b).index()];
        pending[*slot as usize] = Pending { higher: short(a.max(b).index()), side: short(side) };
        *slot += 1;
    }
    (starts, pending)
}
