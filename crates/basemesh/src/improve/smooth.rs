//! Guarded smoothing of vertices along the surface.

use glam::DVec3;

use super::guard::Guard;
use super::metric::{Metric, to_circumcentre};
use super::sliver::check_move;
use super::surface_mesh::SurfaceMesh;
use crate::ids::VertexId;

/// Parts of the wanted step that are tried in turn: a refused step may pass when it is shorter.
const STEPS: [f64; 2] = [1.0, 0.5];

/// Steps shorter than this part of the longest edge of their vertex are not taken.
const SHORTEST_STEP: f64 = 1e-3;

/// Moves every vertex in turn to the weighted mean of the circumcentres of its faces, for
/// `iterations` sweeps; returns the number of moves.
///
/// Circumcentres are taken in the metric, and weights are squared areas in it. Steps run in the
/// tangent plane, end on the surface and pass the guards. Earlier moves of a sweep are seen by
/// later ones.
///
/// With areas instead of their squares this is the smoothing of Chen and Holst (2011) for optimal
/// Delaunay triangulations. Centroids in place of circumcentres would not do: they let a mesh
/// shear freely. Squared areas even out the sizes of the triangles sooner.
pub(crate) fn smooth(
    surface: &mut SurfaceMesh<'_>,
    guard: &Guard,
    metric: &Metric,
    iterations: usize,
) -> usize {
    let mut moves = 0;
    for _ in 0..iterations {
        for v in (0..surface.mesh.vertex_slots()).map(VertexId::new) {
            if surface.is_movable(v) && move_vertex(surface, guard, metric, v) {
                moves += 1;
            }
        }
    }
    moves
}

fn move_vertex(surface: &mut SurfaceMesh<'_>, guard: &Guard, metric: &Metric, v: VertexId) -> bool {
    let Some(step) = wanted_step(surface, metric, v) else { return false };
    let from = surface.mesh.position(v);
    let reach = surface.mesh.longest_edge(v);
    if step.length() < SHORTEST_STEP * reach {
        return false;
    }
    for part in STEPS {
        let Some(foot) = surface.foot(from + part * step, reach) else { continue };
        if check_move(surface, guard, v, &foot).is_ok() {
            surface.put(v, foot);
            return true;
        }
    }
    false
}

/// Tangential way to the weighted mean of the circumcentres.
fn wanted_step(surface: &SurfaceMesh<'_>, metric: &Metric, v: VertexId) -> Option<DVec3> {
    let mesh = &surface.mesh;
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for h in mesh.fan(v) {
        let ids @ [_, q, r] = [v, mesh.target(h), mesh.apex(h)];
        let sides = [[q, r], [v, q], [v, r]].map(|[a, b]| metric.squared(surface, a, b));
        let (weight, way) = to_circumcentre(ids.map(|w| mesh.position(w)), sides);
        sum += way;
        total += weight;
    }
    if total <= 0.0 {
        return None;
    }
    let way = sum / total;
    let normal = surface.normal(v);
    Some(way - way.dot(normal) * normal)
}
