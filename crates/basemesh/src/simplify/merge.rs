//! What collapsing an edge costs and where the merged vertex goes.

use glam::DVec3;

use super::quadric::Quadric;
use crate::ids::HalfedgeId;
use crate::improve::edit_mesh::EditMesh;

/// Farthest an optimum may lie from the middle of its edge, in edge lengths; beyond, the form is
/// nearly singular there and the better of middle and ends is taken.
const FARTHEST_OPTIMUM: f64 = 1.5;

/// A proposed collapse.
#[derive(Clone, Copy, Debug)]
pub(super) struct Merge {
    /// Mean squared distance of [`position`](Self::position) from the planes, length².
    pub(super) cost: f64,
    /// Where the merged vertex minimises the error.
    pub(super) position: DVec3,
    /// The sum of both forms, relative to `position`.
    pub(super) quadric: Quadric,
}

/// The collapse of the edge of `h`.
pub(super) fn merge(mesh: &EditMesh, quadrics: &[Quadric], h: HalfedgeId) -> Merge {
    let (a, b) = (mesh.origin(h), mesh.target(h));
    let (pa, pb) = (mesh.position(a), mesh.position(b));
    let edge = pb - pa;
    let sum = quadrics[a.index()].plus(&quadrics[b.index()].moved_by(-edge));
    let near = |x: &DVec3| {
        (*x - 0.5 * edge).length_squared()
            <= FARTHEST_OPTIMUM * FARTHEST_OPTIMUM * edge.length_squared()
    };
    let x = sum.minimum().filter(near).unwrap_or_else(|| {
        let better = |best, x| if sum.value(x) < sum.value(best) { x } else { best };
        [DVec3::ZERO, edge].into_iter().fold(0.5 * edge, better)
    });
    Merge { cost: sum.mean(x), position: pa + x, quadric: sum.moved_by(x) }
}

/// The form of every vertex: the planes of its faces.
pub(super) fn vertex_quadrics(mesh: &EditMesh, isotropy: f64) -> Vec<Quadric> {
    let mut quadrics = vec![Quadric::default(); mesh.vertex_slots()];
    for face in mesh.faces() {
        let corners = mesh.corners(face);
        for k in 0..3 {
            let [p, q, r] = [0, 1, 2].map(|i| mesh.position(corners[(k + i) % 3]));
            let v = corners[k].index();
            quadrics[v] = quadrics[v].plus(&Quadric::of_triangle(p, q, r, isotropy));
        }
    }
    quadrics
}
