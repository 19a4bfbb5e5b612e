//! The neighbours of a vertex, ring by ring.

use basemesh::{TriMesh, VertexId};

/// Rings that are tried at most.
const MOST_RINGS: usize = 6;

/// The vertices around `centre` that `accept` takes, ring by ring until there are `enough`, each ring
/// complete and ascending by id; and the number of rings. Rings grow through accepted vertices only.
pub(crate) fn neighbours(
    mesh: &TriMesh,
    centre: VertexId,
    enough: usize,
    accept: impl Fn(VertexId) -> bool,
) -> (Vec<VertexId>, usize) {
    let mut found = Vec::with_capacity(2 * enough);
    let mut ring = vec![centre];
    for rings in 1..=MOST_RINGS {
        let mut next: Vec<VertexId> = ring
            .iter()
            .flat_map(|&v| adjacent(mesh, v))
            .filter(|&v| v != centre && !found.contains(&v) && accept(v))
            .collect();
        next.sort_unstable();
        next.dedup();
        found.extend_from_slice(&next);
        if found.len() >= enough || next.is_empty() {
            return (found, rings);
        }
        ring = next;
    }
    (found, MOST_RINGS)
}

/// The other ends of the edges of a vertex.
fn adjacent(mesh: &TriMesh, vertex: VertexId) -> impl Iterator<Item = VertexId> {
    let topology = mesh.topology();
    topology.fan(vertex).flat_map(move |h| {
        // the last edge at a boundary belongs to the fan's last face only
        [topology.target(h), topology.origin(h.previous())]
    })
}
