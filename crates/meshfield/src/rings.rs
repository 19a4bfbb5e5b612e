//! The neighbours of a vertex, ring by ring.

use basemesh::{TriMesh, VertexId};

/// Rings that are tried at most.
const MOST_RINGS: usize = 6;

/// Vertices around another.
pub(crate) struct Neighbours {
    /// Ring after ring, each ascending by id.
    pub(crate) vertices: Vec<VertexId>,
    /// How many rings.
    pub(crate) rings: usize,
    /// Whether all vertices of these rings are there.
    pub(crate) complete: bool,
}

/// The vertices around `centre` that `accept` takes, whole rings until there are `enough`. `accept` is
/// told the ring; rings grow through accepted vertices only.
pub(crate) fn neighbours(
    mesh: &TriMesh,
    centre: VertexId,
    enough: usize,
    accept: impl Fn(VertexId, usize) -> bool,
) -> Neighbours {
    let vertices = Vec::with_capacity(2 * enough);
    let mut found = Neighbours { vertices, rings: 0, complete: true };
    let mut ring = vec![centre];
    while found.vertices.len() < enough && found.rings < MOST_RINGS && !ring.is_empty() {
        let mut next: Vec<VertexId> = ring
            .iter()
            .flat_map(|&v| adjacent(mesh, v))
            .filter(|v| *v != centre && !found.vertices.contains(v))
            .collect();
        next.sort_unstable();
        next.dedup();
        found.rings += 1;
        let all = next.len();
        next.retain(|&v| accept(v, found.rings));
        found.complete &= next.len() == all;
        found.vertices.extend_from_slice(&next);
        ring = next;
    }
    found
}

/// The other ends of the edges of a vertex.
fn adjacent(mesh: &TriMesh, vertex: VertexId) -> impl Iterator<Item = VertexId> {
    let topology = mesh.topology();
    topology.fan(vertex).flat_map(move |h| {
        // the last edge at a boundary belongs to the fan's last face only
        [topology.target(h), topology.origin(h.previous())]
    })
}
