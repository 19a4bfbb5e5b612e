//! Vertices move towards evenly sized surroundings.

use glam::DVec3;

use super::{Remesh, RemeshSettings};
use crate::ids::VertexId;
use crate::improve::guard::Guard;
use crate::improve::metric::to_circumcentre;
use crate::improve::sliver::check_move;

/// Parts of the wanted step that are tried in turn.
const STEPS: [f64; 2] = [1.0, 0.5];

impl Remesh<'_> {
    /// Moves every vertex with a wish in turn to the mean of the circumcentres of its faces, taken in
    /// the metric, each weighted with the square of its area over that of the wanted size; returns
    /// the number of moves.
    pub(super) fn relax(&mut self, settings: &RemeshSettings, guard: &Guard) -> usize {
        let mut moves = 0;
        for _ in 0..settings.limits.smoothing_iterations {
            for v in (0..self.surface.mesh.vertex_slots()).map(VertexId::new) {
                if self.lengths[v.index()].is_some() && self.move_vertex(guard, v) {
                    moves += 1;
                }
            }
        }
        moves
    }

    fn move_vertex(&mut self, guard: &Guard, v: VertexId) -> bool {
        let Some(step) = self.wanted_step(v) else { return false };
        let from = self.surface.mesh.position(v);
        let reach = self.surface.mesh.longest_edge(v);
        for part in STEPS {
            let Some(foot) = self.surface.foot(from + part * step, reach) else { continue };
            if check_move(&self.surface, guard, v, &foot).is_ok() {
                self.surface.put(v, foot);
                return true;
            }
        }
        false
    }

    fn wanted_step(&self, v: VertexId) -> Option<DVec3> {
        let mesh = &self.surface.mesh;
        let own = self.lengths[v.index()]?;
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        for h in mesh.fan(v) {
            let ids @ [_, q, r] = [v, mesh.target(h), mesh.apex(h)];
            let sides = [[q, r], [v, q], [v, r]];
            let sides = sides.map(|[a, b]| self.metric.squared(&self.surface, a, b));
            let (weight, way) = to_circumcentre(ids.map(|w| mesh.position(w)), sides);
            let [a, b] = [q, r].map(|w| self.lengths[w.index()].unwrap_or(own));
            let wanted = ((own + a + b) / 3.0).powi(4);
            sum += way / wanted;
            total += weight / wanted;
        }
        if total <= 0.0 {
            return None;
        }
        let way = sum / total;
        let normal = self.surface.normal(v);
        Some(way - way.dot(normal) * normal)
    }
}
