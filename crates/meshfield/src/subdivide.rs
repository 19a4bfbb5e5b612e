//! Triangles cut in four.

use basemesh::TriMesh;
use glam::DVec3;

/// The same flat surface with every triangle cut at the middles of its edges. The vertices keep their
/// numbers; those of the middles follow in the order of the edges.
#[must_use]
pub fn subdivided(mesh: &TriMesh) -> TriMesh {
    let topology = mesh.topology();
    let count = topology.vertex_count();
    let middles = topology.edges().map(|edge| {
        let [a, b] = topology.edge_vertices(edge).map(|v| mesh.position(v));
        (a + b) * 0.5
    });
    let positions: Vec<DVec3> =
        mesh.positions().as_slice().iter().copied().chain(middles).collect();
    let mut faces = Vec::with_capacity(4 * topology.face_count());
    for face in topology.faces() {
        let [a, b, c] = topology.corners(face).map(basemesh::VertexId::index);
        let [ab, bc, ca] = face.halfedges().map(|h| count + topology.edge(h).index());
        faces.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    TriMesh::new(positions, &faces).expect("invariant: cut faces meet as the whole ones do")
}
