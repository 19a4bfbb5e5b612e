//! Tangential smoothing of a dense mesh before it is decimated.

use glam::DVec3;

use crate::improve::surface_mesh::SurfaceMesh;
use crate::maps::VertexMap;

/// Moves all vertices at once to the mean of their neighbours, within their tangent planes, and back
/// onto the surface, `iterations` times.
///
/// Unguarded: meant for dense meshes, whose faces are much smaller than the features of the
/// surface. The mesh must be compact.
pub(super) fn relax(surface: &mut SurfaceMesh<'_>, iterations: usize) {
    for _ in 0..iterations {
        let (mesh, normals) = (&surface.mesh, &surface.normals);
        let moved = VertexMap::from_fn(mesh.vertex_slots(), |v| {
            let p = mesh.position(v);
            let (sum, count) = mesh.fan(v).fold((DVec3::ZERO, 0.0), |(sum, count), h| {
                (sum + (mesh.position(mesh.target(h)) - p), count + 1.0)
            });
            let way = sum / count;
            let normal = normals[v.index()];
            p + (way - way.dot(normal) * normal)
        });
        for (v, &p) in moved.iter() {
            surface.mesh.set_position(v, p);
        }
        surface.project_all();
    }
}
