//! Tangential smoothing of a dense mesh before it is decimated.

use glam::DVec3;

use crate::ids::VertexId;
use crate::improve::surface_mesh::SurfaceMesh;
use crate::maps::VertexMap;

/// Moves all vertices at once to the mean of their neighbours, within their tangent planes, and back
/// onto the surface, `iterations` times.
///
/// Meant for dense meshes, whose faces are much smaller than the features of the surface. Where they
/// are not, on a thin tube for instance, vertices slip around the bend: a sweep after which the
/// surface turns by more than `turning_cos` along an edge, and by more than anywhere before, is
/// undone and ends the smoothing. The mesh must be compact.
pub(super) fn relax(surface: &mut SurfaceMesh<'_>, iterations: usize, turning_cos: f64) {
    let mut worst = smallest_cos(surface);
    for _ in 0..iterations {
        let before = State::of(surface);
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
        let now = smallest_cos(surface);
        if now < turning_cos.min(worst) {
            before.restore(surface);
            return;
        }
        worst = now;
    }
}

/// Smallest cosine between the surface normals at the ends of an edge.
fn smallest_cos(surface: &SurfaceMesh<'_>) -> f64 {
    let mesh = &surface.mesh;
    let cos = |h| surface.normal(mesh.origin(h)).dot(surface.normal(mesh.target(h)));
    mesh.edges().map(cos).fold(1.0, f64::min)
}

/// What a sweep changes.
struct State {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    off_surface: Vec<bool>,
}

impl State {
    fn of(surface: &SurfaceMesh<'_>) -> Self {
        Self {
            positions: surface.mesh.positions().to_vec(),
            normals: surface.normals.clone(),
            off_surface: surface.off_surface.clone(),
        }
    }

    fn restore(self, surface: &mut SurfaceMesh<'_>) {
        for (v, &p) in self.positions.iter().enumerate() {
            surface.mesh.set_position(VertexId::new(v), p);
        }
        surface.normals = self.normals;
        surface.off_surface = self.off_surface;
    }
}
