//! One step of Loop's subdivision.

use basemesh::{EdgeId, FaceId, MeshError, TriMesh, VertexId};
use glam::DVec3;

use super::normals::ring;

/// Splits every face into four and smooths the vertices by Loop's scheme; face `f` becomes the faces
/// `4 f` to `4 f + 3`, the last one in the middle. Vertices keep their ids; edge `e` becomes vertex
/// `vertices + e`.
///
/// # Errors
///
/// [`MeshError`] if the result is too large.
pub fn loop_step(mesh: &TriMesh) -> Result<TriMesh, MeshError> {
    let topology = mesh.topology();
    let mut positions: Vec<DVec3> = topology.vertices().map(|v| moved(mesh, v)).collect();
    positions.extend(topology.edges().map(|e| middle(mesh, e)));
    let split = |face: FaceId| {
        let [a, b, c] = topology.corners(face).map(VertexId::index);
        let [ab, bc, ca] =
            face.halfedges().map(|h| topology.vertex_count() + topology.edge(h).index());
        [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    };
    let faces: Vec<[usize; 3]> = topology.faces().flat_map(split).collect();
    TriMesh::new(positions, &faces)
}

fn moved(mesh: &TriMesh, vertex: VertexId) -> DVec3 {
    let (old, ring) = (mesh.position(vertex), ring(mesh, vertex));
    if mesh.topology().is_boundary_vertex(vertex) {
        return old * 0.75 + (ring[0] + ring[ring.len() - 1]) * 0.125;
    }
    let count = ring.len() as f64;
    let cos = (std::f64::consts::TAU / count).cos();
    let share = 0.625 - (0.375 + 0.25 * cos).powi(2);
    old * (1.0 - share) + ring.into_iter().sum::<DVec3>() * (share / count)
}

fn middle(mesh: &TriMesh, edge: EdgeId) -> DVec3 {
    let topology = mesh.topology();
    let h = topology.canonical(edge);
    let ends = mesh.position(topology.origin(h)) + mesh.position(topology.target(h));
    let Some(twin) = topology.twin(h) else { return ends * 0.5 };
    let across = [h, twin].map(|h| mesh.position(topology.origin(h.previous())));
    ends * 0.375 + (across[0] + across[1]) * 0.125
}
