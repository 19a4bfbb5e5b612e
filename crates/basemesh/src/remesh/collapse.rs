//! Short edges are collapsed.

use glam::DVec3;

use super::{Remesh, RemeshSettings};
use crate::ids::{HalfedgeId, VertexId};
use crate::improve::guard::Guard;
use crate::improve::link::RingMarks;
use crate::simplify::check_collapse;
use crate::target::Foot;

impl Remesh<'_> {
    /// Collapses the edges that are shortest in relation to what is wanted until there are at most
    /// `faces` faces or the limits allow no more.
    pub(super) fn collapse_until(&mut self, faces: usize, guard: &Guard) {
        let mut marks = RingMarks::default();
        loop {
            let before = self.surface.mesh.face_count();
            for (_, h) in self.by_excess() {
                if self.surface.mesh.face_count() <= faces {
                    break;
                }
                if self.surface.mesh.is_live_halfedge(h) {
                    self.collapse(None, guard, h, &mut marks);
                }
            }
            self.compact();
            let after = self.surface.mesh.face_count();
            if after <= faces || after == before {
                return;
            }
        }
    }

    /// Edges with a wish at an end, the shortest in relation to it first (ties by half-edge id).
    fn by_excess(&self) -> Vec<(f64, HalfedgeId)> {
        let mesh = &self.surface.mesh;
        let mut edges: Vec<(f64, HalfedgeId)> =
            mesh.edges().filter_map(|h| Some((self.excess(h)?, h))).collect();
        edges.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        edges
    }

    fn compact(&mut self) {
        let kept = self.surface.compact();
        crate::improve::surface_mesh::keep(&mut self.lengths, &kept);
    }

    /// Collapses edges that are shorter than wanted, the shortest first (ties by half-edge id),
    /// where the limits allow it and no edge gets longer than those that are split.
    pub(super) fn collapse_short(&mut self, settings: &RemeshSettings, guard: &Guard) {
        let mut marks = RingMarks::default();
        for (_, h) in self.by_excess() {
            let alive = self.surface.mesh.is_live_halfedge(h);
            if alive && self.excess(h).is_some_and(|excess| excess < settings.shortest) {
                self.collapse(Some(settings.longest), guard, h, &mut marks);
            }
        }
        self.compact();
    }

    /// Collapses one edge if the limits allow it, and if no edge gets longer than the multiple
    /// `longest` of what is wanted.
    fn collapse(
        &mut self,
        longest: Option<f64>,
        guard: &Guard,
        h: HalfedgeId,
        marks: &mut RingMarks,
    ) {
        let mesh = &self.surface.mesh;
        let [a, b] = [mesh.origin(h), mesh.target(h)];
        let [pa, pb] = [a, b].map(|v| mesh.position(v));
        // a vertex without a wish stays where it is
        let places: &[DVec3] = match [a, b].map(|v| self.lengths[v.index()].is_some()) {
            [true, true] => &[0.5 * (pa + pb), pa, pb],
            [true, false] => &[pb],
            [false, true] => &[pa],
            [false, false] => return,
        };
        for &place in places {
            let Ok(foot) = check_collapse(&self.surface, guard, h, place, marks) else { continue };
            if longest.is_some_and(|longest| self.grows_too_long(longest, [a, b], &foot)) {
                continue;
            }
            let wish = match [a, b].map(|v| self.lengths[v.index()]) {
                [Some(x), Some(y)] => Some(0.5 * (x + y)),
                _ => None,
            };
            self.surface.mesh.collapse(h);
            self.surface.put(a, foot);
            self.lengths[a.index()] = wish;
            return;
        }
    }

    /// Whether an edge of the merged vertex would have to be split again.
    fn grows_too_long(&self, longest: f64, ends: [VertexId; 2], foot: &Foot) -> bool {
        let mesh = &self.surface.mesh;
        ends.into_iter().any(|end| {
            mesh.fan(end).map(|g| mesh.target(g)).filter(|v| !ends.contains(v)).any(|v| {
                let wanted = self.wanted([end, v]).or(self.wanted(ends));
                let here = (mesh.position(v), self.surface.normal(v));
                let length = self.metric.between(here, (foot.point, foot.normal)).sqrt();
                wanted.is_some_and(|wanted| length > longest * wanted)
            })
        })
    }
}
