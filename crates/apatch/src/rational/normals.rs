//! Normals from the triangulation, where none are given.

use basemesh::{FaceId, HalfedgeId, TriMesh, VertexId, VertexMap};
use glam::DVec3;

use crate::min_norm::deepest_direction;

/// Unit normals of the limit surface of Loop's scheme at the vertices; at boundary vertices, of its
/// boundary rule. Where it has none, the mean of the face normals by area.
#[must_use]
pub fn loop_limit_normals(mesh: &TriMesh) -> VertexMap<DVec3> {
    VertexMap::from_fn(mesh.topology().vertex_count(), |vertex| {
        let mean = mean_normal(mesh, vertex);
        let ring = ring(mesh, vertex);
        let limit = if mesh.topology().is_boundary_vertex(vertex) {
            boundary_tangents(mesh.position(vertex), &ring)
        } else {
            inner_tangents(mesh.position(vertex), &ring)
        };
        let [along, across] = limit;
        let normal = along.cross(across).try_normalize().unwrap_or(mean);
        let normal = if normal.dot(mean) < 0.0 { -normal } else { normal };
        if normal == DVec3::ZERO { DVec3::Z } else { normal }
    })
}

/// Unit normals that see all faces of their vertex as steeply as possible from above: they maximise
/// the smallest product with the normals of those faces. A vertex without such a direction keeps
/// `otherwise`.
#[must_use]
pub fn cone_normals(mesh: &TriMesh, otherwise: &VertexMap<DVec3>) -> VertexMap<DVec3> {
    otherwise.map(|vertex, &normal| {
        let normals: Vec<DVec3> = mesh
            .topology()
            .fan(vertex)
            .filter_map(|h| area_normal(mesh, h.face()).try_normalize())
            .collect();
        deepest_direction(&normals).unwrap_or(normal)
    })
}

/// Neighbours of a vertex, counter-clockwise; of a boundary vertex, from boundary to boundary.
pub(crate) fn ring(mesh: &TriMesh, vertex: VertexId) -> Vec<DVec3> {
    let topology = mesh.topology();
    let halfedges: Vec<HalfedgeId> = topology.fan(vertex).collect();
    let mut ring: Vec<_> = halfedges.iter().map(|&h| mesh.position(topology.target(h))).collect();
    if let Some(&last) = halfedges.last().filter(|_| topology.is_boundary_vertex(vertex)) {
        ring.push(mesh.position(topology.origin(last.previous())));
    }
    ring
}

fn inner_tangents(centre: DVec3, ring: &[DVec3]) -> [DVec3; 2] {
    let step = std::f64::consts::TAU / ring.len() as f64;
    let mut tangents = [DVec3::ZERO; 2];
    for (i, p) in ring.iter().enumerate() {
        let (sin, cos) = (step * i as f64).sin_cos();
        tangents[0] += (*p - centre) * cos;
        tangents[1] += (*p - centre) * sin;
    }
    tangents
}

/// Along the boundary and across it; the sign is left open.
fn boundary_tangents(centre: DVec3, ring: &[DVec3]) -> [DVec3; 2] {
    let rays: Vec<DVec3> = ring.iter().map(|p| *p - centre).collect();
    let (first, last) = (rays[0], rays[rays.len() - 1]);
    let across = match rays.len() {
        2 => first + last,
        3 => rays[1],
        count => {
            let angle = std::f64::consts::PI / (count - 1) as f64;
            let inner: DVec3 = (1..count - 1).map(|i| rays[i] * (angle * i as f64).sin()).sum();
            (first + last) * angle.sin() + inner * (2.0 * angle.cos() - 2.0)
        }
    };
    [first - last, across]
}

fn mean_normal(mesh: &TriMesh, vertex: VertexId) -> DVec3 {
    let sum: DVec3 = mesh.topology().fan(vertex).map(|h| area_normal(mesh, h.face())).sum();
    sum.normalize_or_zero()
}

fn area_normal(mesh: &TriMesh, face: FaceId) -> DVec3 {
    let [a, b, c] = mesh.triangle(face);
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles around the origin in the plane with this normal.
    fn flat_fan(count: usize, closed: bool, normal: DVec3) -> TriMesh {
        let (u, v) = normal.any_orthonormal_pair();
        let step = if closed { std::f64::consts::TAU / count as f64 } else { 0.6 };
        let mut points = vec![DVec3::ZERO];
        points.extend((0..count).map(|i| {
            let (sin, cos) = (step * i as f64).sin_cos();
            (u * cos + v * sin) * (1.0 + 0.1 * i as f64)
        }));
        let faces: Vec<_> =
            (1..count).map(|i| [0, i, i + 1]).chain(closed.then_some([0, count, 1])).collect();
        TriMesh::new(points, &faces).unwrap()
    }

    #[test]
    fn planes_have_their_normal() {
        let normal = DVec3::new(0.3, -0.2, 0.9).normalize();
        for (count, closed) in
            [(6, true), (5, true), (2, false), (3, false), (4, false), (5, false)]
        {
            let mesh = flat_fan(count, closed, normal);
            let limit = loop_limit_normals(&mesh);
            let cone = cone_normals(&mesh, &limit);
            for v in mesh.topology().vertices() {
                let [limit, cone] = [limit[v], cone[v]];
                assert!((limit - normal).length() < 1e-14, "{count} {closed} {v}: {limit}");
                assert!((cone - normal).length() < 1e-14, "{count} {closed} {v}: {cone}");
            }
        }
    }
}
