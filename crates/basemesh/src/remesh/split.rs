//! Long edges are split.

use super::{Remesh, RemeshSettings};
use crate::ids::HalfedgeId;
use crate::improve::guard::area_vector;
use crate::quality::angle_between;

/// Most sweeps over all edges; every sweep halves the longest.
const MAX_SWEEPS: usize = 4;
/// Share by which an edge must exceed the turning limit: many edges are exactly at it, up to
/// rounding.
const EXCESS: f64 = 1e-9;

impl Remesh<'_> {
    /// Splits edges that are longer than wanted or turn too far, the worst first (ties by half-edge
    /// id), until a sweep finds none.
    pub(super) fn split_long(&mut self, settings: &RemeshSettings) {
        let most = settings.most_faces.unwrap_or(usize::MAX);
        for _ in 0..MAX_SWEEPS {
            let mut edges: Vec<(f64, HalfedgeId)> = self
                .surface
                .mesh
                .edges()
                .map(|h| (self.need(settings, h), h))
                .filter(|&(need, _)| need > 1.0 + EXCESS)
                .collect();
            edges.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
            // an earlier split may have changed the edge of a half-edge: no longer than it was
            let splits = edges
                .into_iter()
                .filter(|&(need, h)| {
                    let room = self.surface.mesh.face_count() < most;
                    room && self.need(settings, h) >= need && self.split(h)
                })
                .count();
            if splits == 0 {
                break;
            }
        }
    }

    /// Splits the edges that need it most until there are at least `faces` faces.
    pub(super) fn split_until(&mut self, faces: usize, settings: &RemeshSettings) {
        for _ in 0..MAX_SWEEPS {
            let mut edges: Vec<(f64, HalfedgeId)> =
                self.surface.mesh.edges().map(|h| (self.need(settings, h), h)).collect();
            edges.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
            for (need, h) in edges {
                if self.surface.mesh.face_count() >= faces {
                    return;
                }
                // not the halves of an edge split in this sweep
                if self.need(settings, h) >= need {
                    self.split(h);
                }
            }
        }
    }

    /// How much too long an edge is, or how much too far the surface turns along it: above one, it
    /// is split.
    fn need(&self, settings: &RemeshSettings, h: HalfedgeId) -> f64 {
        let [n, m] = [self.surface.mesh.origin(h), self.surface.mesh.target(h)]
            .map(|v| self.surface.normal(v));
        let turning = angle_between(n, m) / settings.limits.max_turning_deg.to_radians();
        self.excess(h).map_or(turning, |excess| turning.max(excess / settings.longest))
    }

    /// Puts a vertex on the surface near the middle of an edge, unless a face would lean away from
    /// the surface; its wanted length is that of the edge.
    fn split(&mut self, h: HalfedgeId) -> bool {
        let surface = &self.surface;
        let mesh = &surface.mesh;
        let ends = [mesh.origin(h), mesh.target(h)];
        let [pa, pb] = ends.map(|v| mesh.position(v));
        let Some(foot) = surface.foot(0.5 * (pa + pb), 0.5 * pa.distance(pb)) else { return false };
        let stands = [h, mesh.twin(h)].into_iter().all(|side| {
            let ids @ [a, b, c] = [mesh.origin(side), mesh.target(side), mesh.apex(side)];
            let [p, q, r] = ids.map(|v| mesh.position(v));
            let [first, second] =
                [area_vector([p, foot.point, r]), area_vector([foot.point, q, r])];
            [(first, a), (first, c), (second, b), (second, c)]
                .into_iter()
                .all(|(area, v)| area.dot(foot.normal) > 0.0 && area.dot(surface.normal(v)) > 0.0)
        });
        if stands {
            let wanted = self.wanted(ends).unwrap_or_else(|| 0.5 * self.length(ends));
            self.surface.split(h, foot);
            self.lengths.push(Some(wanted));
        }
        stands
    }
}
