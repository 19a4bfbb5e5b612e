//! Single vertices moved for the sake of their worst triangle.

use glam::DVec3;

use super::guard::{Guard, OldFace, Refusal};
use super::surface_mesh::SurfaceMesh;
use crate::ids::VertexId;
use crate::quality::triangle_quality;
use crate::target::Foot;

/// Triangles below this multiple of `min_quality` are lifted: with the default of 0.4, all above
/// have angles over 16°.
const LIFTED_BELOW: f64 = 1.2;

/// Directions tried around a vertex.
const DIRECTIONS: [[f64; 2]; 8] = {
    let s = std::f64::consts::FRAC_1_SQRT_2;
    [[1.0, 0.0], [s, s], [0.0, 1.0], [-s, s], [-1.0, 0.0], [-s, -s], [0.0, -1.0], [s, -s]]
};

/// Lengths of the steps tried, as parts of the longest edge of the vertex.
const STEPS: [f64; 3] = [0.2, 0.07, 0.02];

/// Cap on the sweeps; three in four slivers that can be lifted are lifted by the first two.
const MAX_SWEEPS: usize = 8;

/// Moves the corners of triangles not well above `guard.min_quality` to where the worst triangle
/// around them is better; returns the number of moves.
///
/// Smoothing equalises lengths that count the turning of the surface, and leaves thin triangles
/// where it turns quickly in one direction.
pub(crate) fn lift_slivers(surface: &mut SurfaceMesh<'_>, guard: &Guard) -> usize {
    let mut moves = 0;
    for _ in 0..MAX_SWEEPS {
        let before = moves;
        for v in (0..surface.mesh.vertex_slots()).map(VertexId::new) {
            if surface.is_movable(v) && lift(surface, guard, v) {
                moves += 1;
            }
        }
        if moves == before {
            break;
        }
    }
    moves
}

fn lift(surface: &mut SurfaceMesh<'_>, guard: &Guard, v: VertexId) -> bool {
    let here = Foot { point: surface.mesh.position(v), normal: surface.normal(v) };
    let now = worst_quality(surface, v, here.point);
    if now >= LIFTED_BELOW * guard.min_quality {
        return false;
    }
    let edge = surface.mesh.longest_edge(v);
    let (x, y) = here.normal.any_orthonormal_pair();
    let mut best: Option<(f64, Foot)> = None;
    for step in STEPS {
        for [a, b] in DIRECTIONS {
            let near = here.point + step * edge * (a * x + b * y);
            let Some(foot) = surface.foot(near, edge) else { continue };
            let quality = worst_quality(surface, v, foot.point);
            if quality > best.map_or(now, |best| best.0)
                && check_move(surface, guard, v, &foot).is_ok()
            {
                best = Some((quality, foot));
            }
        }
    }
    let Some((_, foot)) = best else { return false };
    surface.put(v, foot);
    true
}

/// Quality of the worst triangle of `v` if it were at `p`.
fn worst_quality(surface: &SurfaceMesh<'_>, v: VertexId, p: DVec3) -> f64 {
    let mesh = &surface.mesh;
    let quality = |h| {
        let [q, r] = [mesh.target(h), mesh.apex(h)].map(|w| mesh.position(w));
        triangle_quality([p, q, r])
    };
    mesh.fan(v).map(quality).fold(f64::INFINITY, f64::min)
}

/// Tests all faces and edges of a vertex moved to `foot`.
pub(crate) fn check_move(
    surface: &SurfaceMesh<'_>,
    guard: &Guard,
    v: VertexId,
    foot: &Foot,
) -> Result<(), Refusal> {
    let (mesh, normal) = (&surface.mesh, surface.normal(v));
    for h in mesh.fan(v) {
        let (b, c) = (mesh.target(h), mesh.apex(h));
        let (nb, nc) = (surface.normal(b), surface.normal(c));
        guard.check_turning(foot.normal, nb, normal.dot(nb))?;
        let [pb, pc] = [b, c].map(|w| mesh.position(w));
        let old = OldFace::new([mesh.position(v), pb, pc], [normal, nb, nc]);
        guard.check_face(&old, [foot.point, pb, pc], [foot.normal, nb, nc])?;
    }
    Ok(())
}
