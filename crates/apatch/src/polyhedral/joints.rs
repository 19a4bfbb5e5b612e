//! How smooth the function and the surface are where tetrahedra meet.

use glam::DMat3;

use super::conditions::neighbours;
use super::surface::PolyhedralSurface;

/// Largest jumps across all common triangles of two tetrahedra.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joints {
    /// Of the value, over the size of the hull.
    pub value_jump: f64,
    /// Of the gradient, over the largest gradient.
    pub gradient_jump: f64,
    /// Of the second derivatives, over the largest ones; only a C2 function has a small one.
    pub hessian_jump: f64,
    /// Angle between the normals on the surface, in radians.
    pub normal_angle: f64,
    /// Of mean and Gauss curvature on the surface, over the larger of one and their largest value in
    /// sizes of the hull; only a C2 surface has a small one.
    pub curvature_jump: f64,
}

/// Steps of the grid on a common triangle, and along its rays.
const GRID: usize = 4;
const RAYS: usize = 8;

impl PolyhedralSurface {
    /// Measures the joints on a grid of points of every common triangle.
    #[must_use]
    pub fn joints(&self) -> Joints {
        let mut found = Joints::default();
        let (mut steepest, mut largest, mut bent) = (0.0_f64, 0.0_f64, 1.0_f64);
        let size = self.hull.size();
        for pair in neighbours(&self.hull) {
            for at in self.grid_between(pair) {
                let [p, q] = [0, 1].map(|i| self.jet(pair[i], at[i]));
                steepest = steepest.max(p.gradient.length());
                largest = largest.max(norm(p.hessian));
                found.value_jump = found.value_jump.max((p.value - q.value).abs() / size);
                found.gradient_jump = found.gradient_jump.max(p.gradient.distance(q.gradient));
                found.hessian_jump = found.hessian_jump.max(norm(p.hessian - q.hessian));
            }
            for at in self.points_between(pair) {
                let [p, q] = [0, 1].map(|i| self.jet(pair[i], at[i]));
                let angle = p.gradient.cross(q.gradient).length().atan2(p.gradient.dot(q.gradient));
                found.normal_angle = found.normal_angle.max(angle);
                let [a, b] = [p, q].map(|jet| jet.curvatures());
                bent = bent.max(a.mean.abs() * size).max(a.gauss.abs() * size * size);
                let mean = (a.mean - b.mean).abs() * size;
                let gauss = (a.gauss - b.gauss).abs() * size * size;
                found.curvature_jump = found.curvature_jump.max(mean).max(gauss);
            }
        }
        if steepest > 0.0 && largest > 0.0 {
            found.gradient_jump /= steepest;
            found.hessian_jump /= largest;
        }
        found.curvature_jump /= bent;
        found
    }

    /// The corners of two neighbours, and those that they share as places in both.
    fn shared(&self, pair: [usize; 2]) -> Vec<[usize; 2]> {
        let [first, second] = pair.map(|c| self.hull.corners(self.hull.cells[c]));
        let place = |p: usize| second.iter().position(|&q| q == p);
        (0..4).filter_map(|c| place(first[c]).map(|d| [c, d])).collect()
    }

    fn grid_between(&self, pair: [usize; 2]) -> Vec<[[f64; 4]; 2]> {
        let shared = self.shared(pair);
        let mut points = Vec::new();
        for i in 0..=GRID {
            for j in 0..=GRID - i {
                let x = [i, j, GRID - i - j].map(|k| k as f64 / GRID as f64);
                let mut at = [[0.0; 4]; 2];
                for ([c, d], x) in shared.iter().zip(x) {
                    (at[0][*c], at[1][*d]) = (x, x);
                }
                points.push(at);
            }
        }
        points
    }

    /// Points of the surface on the common triangle of two neighbours over the same edge.
    fn points_between(&self, pair: [usize; 2]) -> Vec<[[f64; 4]; 2]> {
        let shared = self.shared(pair);
        let first = self.hull.corners(self.hull.cells[pair[0]]);
        let is_base = |&&[c, _]: &&[usize; 2]| first[c] < self.hull.base_count();
        let base: Vec<_> = shared.iter().filter(is_base).collect();
        let top = shared.iter().find(|s| !is_base(s));
        let ([[a, _], [b, _]], Some([t, _])) = (&*base, top) else { return Vec::new() };
        let hit = |k: usize| {
            let x = k as f64 / RAYS as f64;
            let (mut foot, mut apex) = ([0.0; 4], [0.0; 4]);
            (foot[*a], foot[*b], apex[*t]) = (1.0 - x, x, 1.0);
            let at = self.point(pair[0], foot, apex)?.at;
            let mut other = [0.0; 4];
            shared.iter().for_each(|[c, d]| other[*d] = at[*c]);
            Some([at, other])
        };
        (1..RAYS).filter_map(hit).collect()
    }
}

fn norm(m: DMat3) -> f64 {
    m.to_cols_array().map(|v| v * v).iter().sum::<f64>().sqrt()
}
