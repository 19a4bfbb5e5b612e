//! Where a mesh is not smooth.

use basemesh::{EdgeId, TriMesh};

/// Edges whose faces meet at an angle above a limit, and edges with one face only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SharpEdges {
    /// Edges with two faces whose normals differ by more than the limit.
    pub creases: Vec<EdgeId>,
    /// Edges with one face.
    pub boundary: Vec<EdgeId>,
    /// Largest angle between the normals of neighbouring faces. Unit: radians.
    pub largest_angle: f64,
}

/// The edges along which a mesh is not smooth, by the angle between the normals of their faces.
/// `crease_angle` in radians.
#[must_use]
pub fn sharp_edges(mesh: &TriMesh, crease_angle: f64) -> SharpEdges {
    let topology = mesh.topology();
    let normal = |face| {
        let [a, b, c] = mesh.triangle(face);
        (b - a).cross(c - a)
    };
    let mut found = SharpEdges::default();
    for edge in topology.edges() {
        let h = topology.canonical(edge);
        let Some(twin) = topology.twin(h) else {
            found.boundary.push(edge);
            continue;
        };
        let (m, n) = (normal(h.face()), normal(twin.face()));
        let angle = m.cross(n).length().atan2(m.dot(n));
        found.largest_angle = found.largest_angle.max(angle);
        if angle > crease_angle {
            found.creases.push(edge);
        }
    }
    found
}
