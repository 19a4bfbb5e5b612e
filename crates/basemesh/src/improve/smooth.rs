//! Guarded smoothing of vertices along the surface.

use glam::DVec3;

use super::guard::Guard;
use super::settings::ImproveSettings;
use super::sliver::check_move;
use super::surface_mesh::SurfaceMesh;
use crate::ids::{HalfedgeId, VertexId};
use crate::quality::angle_between;

/// Parts of the wanted step that are tried in turn: a refused step may pass when it is shorter.
const STEPS: [f64; 2] = [1.0, 0.5];

/// Moves every vertex in turn towards the weighted centre of its faces, for
/// `settings.smoothing_iterations` sweeps; returns the number of moves.
///
/// The weight of a face is `area · (offset + turning)^exponent`, with the largest turning of the
/// surface normal along its edges in radians. Steps run in the tangent plane, end on the surface
/// and pass the guards. Earlier moves of a sweep are seen by later ones.
pub(crate) fn smooth(
    surface: &mut SurfaceMesh<'_>,
    guard: &Guard,
    settings: &ImproveSettings,
) -> usize {
    let mut moves = 0;
    for _ in 0..settings.smoothing_iterations {
        for v in (0..surface.mesh.vertex_slots()).map(VertexId::new) {
            if surface.mesh.is_live_vertex(v) && move_vertex(surface, guard, settings, v) {
                moves += 1;
            }
        }
    }
    moves
}

fn move_vertex(
    surface: &mut SurfaceMesh<'_>,
    guard: &Guard,
    settings: &ImproveSettings,
    v: VertexId,
) -> bool {
    let Some(step) = wanted_step(surface, settings, v) else { return false };
    let from = surface.mesh.position(v);
    let reach = surface.mesh.longest_edge(v);
    for part in STEPS {
        let Some(foot) = surface.foot(from + part * step, reach) else { continue };
        if check_move(surface, guard, v, &foot).is_ok() {
            surface.put(v, foot);
            return true;
        }
    }
    false
}

/// Tangential way to the weighted centre of the faces.
fn wanted_step(
    surface: &SurfaceMesh<'_>,
    settings: &ImproveSettings,
    v: VertexId,
) -> Option<DVec3> {
    let from = surface.mesh.position(v);
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for h in surface.mesh.fan(v) {
        let [_, p, q] = corners_from(surface, h).map(|c| surface.mesh.position(c));
        let doubled = (p - from).cross(q - from).length();
        let turning = face_turning(corners_from(surface, h).map(|c| surface.normal(c)));
        let weight = doubled * density(settings, turning);
        sum += weight * ((p - from) + (q - from));
        total += weight;
    }
    if total <= 0.0 {
        return None;
    }
    let way = sum / (3.0 * total);
    let normal = surface.normal(v);
    Some(way - way.dot(normal) * normal)
}

/// Corners of the face of `h`, its origin first.
fn corners_from(surface: &SurfaceMesh<'_>, h: HalfedgeId) -> [VertexId; 3] {
    [surface.mesh.origin(h), surface.mesh.target(h), surface.mesh.apex(h)]
}

fn face_turning([a, b, c]: [DVec3; 3]) -> f64 {
    angle_between(a, b).max(angle_between(b, c)).max(angle_between(c, a))
}

fn density(settings: &ImproveSettings, turning: f64) -> f64 {
    (settings.density_offset + turning).powf(settings.density_exponent)
}
