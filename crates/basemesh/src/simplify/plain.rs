//! Fast collapses by quadric error alone, in passes over the cheapest edges.

use glam::DVec3;

use super::merge::{Merge, merge};
use super::quadric::Quadric;
use crate::ids::{FaceId, HalfedgeId};
use crate::improve::edit_mesh::EditMesh;
use crate::improve::link::RingMarks;
use crate::improve::surface_mesh::keep;
use crate::maps::FaceMap;

/// A pass looks at one edge in this many, cheapest first. Larger is closer to a priority queue and
/// slower.
const EDGES_PER_CANDIDATE: usize = 4;

/// Faces whose edges are priced together; only a granularity of the parallel loop.
const FACES_PER_BLOCK: usize = 4096;

/// Collapses edges until `faces` are left or nothing can be collapsed any more.
///
/// Keeps the topology (link condition) and lets no face turn by more than the angle of cosine
/// `flip_cos` in one step; the target surface is not asked. Each pass prices all edges, takes the
/// cheapest quarter and collapses, in that order, those whose ends no earlier collapse of the pass has
/// touched. Passes remove a nearly fixed share of what is left, so that the work is linear in the
/// number of faces.
pub(super) fn collapse_plain(
    mesh: &mut EditMesh,
    quadrics: &mut Vec<Quadric>,
    faces: usize,
    flip_cos: f64,
) {
    let mut pass = Pass { flip_cos, marks: RingMarks::default(), touched: Vec::new() };
    while mesh.face_count() > faces {
        let before = mesh.face_count();
        let edges = 3 * before / 2;
        let mut scope = edges.div_ceil(EDGES_PER_CANDIDATE);
        // a stalled pass looks at every edge before giving up
        while mesh.face_count() == before && scope < 2 * edges {
            let candidates = cheapest(mesh, quadrics, scope.min(edges));
            pass.run(mesh, quadrics, &candidates, faces);
            scope *= 2;
        }
        let kept = mesh.compact();
        keep(quadrics, &kept);
        if mesh.face_count() == before {
            return;
        }
    }
}

/// The `count` cheapest edges of a compact mesh by the binary order of magnitude of their cost, and
/// within one by id: neighbours in the list are mostly neighbours in space, so that a pass walks
/// through memory instead of jumping.
fn cheapest(mesh: &EditMesh, quadrics: &[Quadric], count: usize) -> Vec<(Magnitude, HalfedgeId)> {
    let blocks = mesh.face_slots().div_ceil(FACES_PER_BLOCK);
    let priced = FaceMap::from_fn(blocks, |block| {
        let first = block.index() * FACES_PER_BLOCK;
        let end = (first + FACES_PER_BLOCK).min(mesh.face_slots());
        (first..end)
            .flat_map(|f| FaceId::new(f).halfedges())
            .filter(|&h| h < mesh.twin(h))
            .map(|h| (magnitude(merge(mesh, quadrics, h).cost), h))
            .collect::<Vec<_>>()
    });
    let mut all = Vec::with_capacity(3 * mesh.face_slots() / 2);
    for block in priced.into_vec() {
        all.extend(block);
    }
    if count < all.len() {
        all.select_nth_unstable(count);
        all.truncate(count);
    }
    all.sort_unstable();
    all
}

/// Binary order of magnitude of a cost.
type Magnitude = i16;

/// The exponent of a cost; rounding may have made it negative, which is as good as zero.
fn magnitude(cost: f64) -> Magnitude {
    let exponent = |x: f64| (x.to_bits() >> 52) as Magnitude;
    if cost > 0.0 { exponent(cost) } else { exponent(0.0) }
}

struct Pass {
    flip_cos: f64,
    marks: RingMarks,
    /// Ends of the collapses of this pass: the prices of their edges are out of date.
    touched: Vec<bool>,
}

impl Pass {
    fn run(
        &mut self,
        mesh: &mut EditMesh,
        quadrics: &mut [Quadric],
        candidates: &[(Magnitude, HalfedgeId)],
        faces: usize,
    ) {
        self.touched.clear();
        self.touched.resize(mesh.vertex_slots(), false);
        for &(_, h) in candidates {
            if mesh.face_count() <= faces {
                return;
            }
            let [a, b] = [mesh.origin(h), mesh.target(h)];
            if !mesh.is_live_halfedge(h) || self.touched[a.index()] || self.touched[b.index()] {
                continue;
            }
            let Merge { position, quadric, .. } = merge(mesh, quadrics, h);
            if turns_a_face(mesh, h, position, self.flip_cos)
                || !mesh.satisfies_link_condition(h, &mut self.marks)
            {
                continue;
            }
            mesh.collapse(h);
            mesh.set_position(a, position);
            quadrics[a.index()] = quadric;
            self.touched[a.index()] = true;
            self.touched[b.index()] = true;
        }
    }
}

/// Whether moving both ends of `h` to `position` turns a face that survives by more than allowed.
fn turns_a_face(mesh: &EditMesh, h: HalfedgeId, position: DVec3, flip_cos: f64) -> bool {
    [h, mesh.twin(h)].into_iter().any(|side| {
        let end = mesh.origin(side);
        let pivot = mesh.position(end);
        // the faces of `end` except the two next to the edge
        mesh.fan_from(mesh.twin(side.previous())).any(|g| {
            if g == side || g == mesh.twin(side).next() {
                return false;
            }
            let [p, q] = [mesh.target(g), mesh.apex(g)].map(|v| mesh.position(v));
            let old = (p - pivot).cross(q - pivot);
            let new = (p - position).cross(q - position);
            old.dot(new) <= flip_cos * (old.length_squared() * new.length_squared()).sqrt()
        })
    })
}
