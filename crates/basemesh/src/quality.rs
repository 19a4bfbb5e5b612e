//! Measures of a base mesh: angles, slivers, normal turning and the validity of its fans.

mod measure;

use glam::DVec3;

pub use measure::MeshQuality;

use crate::ids::{EdgeId, HalfedgeId, VertexId};
use crate::maps::VertexMap;
use crate::mesh::TriMesh;

/// Smallest sine of the angle between consecutive edges of a valid fan; below, rounding decides
/// which of two edges comes first.
const MIN_FAN_SINE: f64 = 1e-9;

/// Shape of a triangle, `2√3 |u × v| / Σ length²`: one if equilateral, zero if degenerate.
///
/// Independent of size and position. A triangle of three equal points has quality zero.
#[must_use]
pub fn triangle_quality([p, q, r]: [DVec3; 3]) -> f64 {
    let (u, v, w) = (q - p, r - p, r - q);
    let squares = u.length_squared() + v.length_squared() + w.length_squared();
    if squares > 0.0 { 2.0 * 3.0_f64.sqrt() * u.cross(v).length() / squares } else { 0.0 }
}

/// Angle in radians between the surface normals at both ends of an edge.
///
/// `normals` are unit normals of the surface, one per vertex. Accurate for small angles too.
#[must_use]
pub fn edge_turning(mesh: &TriMesh, normals: &VertexMap<DVec3>, edge: EdgeId) -> f64 {
    let [a, b] = mesh.topology().edge_vertices(edge);
    angle_between(normals[a], normals[b])
}

/// Vertices around which no G1 surface can be built from this fan of edges.
///
/// The edges of a vertex, projected into the tangent plane of its normal, must turn
/// counter-clockwise, each by an angle in (0°, 180°), and once around for a vertex that is not on a
/// boundary. Sorted by id. Scale free.
///
/// `docs/math/base-mesh.md`: such vertices are where patches fold; the remedy is a finer
/// mesh there, see [`split_edges`](crate::split_edges).
///
/// # Panics
///
/// If there is not one normal per vertex.
#[must_use]
pub fn invalid_fans(mesh: &TriMesh, normals: &VertexMap<DVec3>) -> Vec<VertexId> {
    let t = mesh.topology();
    assert_eq!(normals.len(), t.vertex_count(), "one normal per vertex");
    let valid = VertexMap::from_fn(t.vertex_count(), |v| is_valid_fan(mesh, v, normals[v]));
    valid.iter().filter(|(_, valid)| !**valid).map(|(v, _)| v).collect()
}

fn is_valid_fan(mesh: &TriMesh, v: VertexId, normal: DVec3) -> bool {
    let t = mesh.topology();
    let mut total = 0.0;
    for h in t.fan(v) {
        let [first, second] = [h, h.previous()].map(|g| projected_edge(mesh, v, g, normal));
        let sine = first.cross(second).dot(normal);
        let size = (first.length_squared() * second.length_squared()).sqrt();
        if sine.is_nan() || sine <= MIN_FAN_SINE * size {
            return false;
        }
        total += sine.atan2(first.dot(second));
    }
    // sums of turning angles are multiples of a full turn: the limit is in the middle of two of them
    total < 1.5 * std::f64::consts::TAU
}

/// The edge of `h` away from its end `v`, in the plane across `normal`.
fn projected_edge(mesh: &TriMesh, v: VertexId, h: HalfedgeId, normal: DVec3) -> DVec3 {
    let t = mesh.topology();
    let far = if t.origin(h) == v { t.target(h) } else { t.origin(h) };
    let edge = mesh.position(far) - mesh.position(v);
    edge - edge.dot(normal) * normal
}

/// Angle in radians between two vectors of any length.
pub(crate) fn angle_between(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
