//! Weights near the apices: free, but bounded from below by the weights of the edge tetrahedra.

use glam::DVec3;

use super::{MARGIN, Upper, Weights, edge_between};
use crate::polyhedral::hull::HullTriangle;
use crate::rational::Side;

impl Weights<'_> {
    /// Numbers 4 and 6: as a quadric through the data would have them, times a factor, but large
    /// enough for the weights of the edge tetrahedra to have the right sign.
    pub(super) fn set_upper(&mut self, t: usize, side: Side, factor: f64) {
        let HullTriangle { corners, apices, .. } = self.hull.triangles[t];
        let (Some(q), Some(mut upper)) = (apices[side.index()], self.upper[t][side.index()]) else {
            return;
        };
        let sign = side.sign();
        let natural = sign * self.natural(corners, q);
        for (k, &corner) in corners.iter().enumerate() {
            let wanted = sign * self.one(corner, q) + natural / 3.0;
            let bound = [k, (k + 2) % 3].into_iter().filter_map(|edge| {
                let other = if edge == k { (k + 1) % 3 } else { edge };
                self.four_bound(t, side, &upper, [k, other, edge])
            });
            let bound = bound.fold(f64::NEG_INFINITY, f64::max);
            upper.four[k] = sign * (factor * wanted.max(bound)).max(bound);
        }
        let bounds = (0..3).filter_map(|k| self.six_bound(t, side, &upper, k));
        let bound = bounds.fold(f64::NEG_INFINITY, f64::max);
        upper.six = sign * (factor * natural.max(bound)).max(bound);
        self.upper[t][side.index()] = Some(upper);
    }

    /// Value of a quadric through the data at an apex.
    fn natural(&self, corners: [usize; 3], q: usize) -> f64 {
        let point = |i: usize| self.point(corners[i]);
        let normal = |i: usize| self.hull.normals[corners[i]];
        let pairs = [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]];
        let bend = |[i, j]: [usize; 2]| {
            let d: DVec3 = point(j) - point(i);
            -2.0 * d.dot(normal(i)) / d.length_squared()
        };
        let kappa = pairs.map(bend).iter().sum::<f64>() / 6.0;
        let values = [0, 1, 2].map(|i| {
            let d = self.point(q) - point(i);
            normal(i).dot(d) + 0.5 * kappa * d.length_squared()
        });
        values.iter().sum::<f64>() / 3.0
    }

    /// Coordinates of the split point of an edge in the tetrahedron of a triangle, with its edge's
    /// length; `None` without tetrahedra on this side.
    fn split_in(&self, t: usize, side: Side, k: usize) -> Option<([f64; 4], f64)> {
        let e = self.hull.triangles[t].edges[k];
        let edge = &self.hull.edges[e];
        let split = edge.splits[side.index()].as_ref()?;
        let which = usize::from(edge.triangles[0] != t);
        let [a, b] = edge.ends.map(|p| self.point(p));
        // in the order: corner k, the next one, the opposite one, apex
        let [o, x, y, q] = split.coordinates[which];
        let forward = edge.ends[0] == self.hull.triangles[t].corners[k];
        let [x, y] = if forward { [x, y] } else { [y, x] };
        Some(([x, y, o, q], a.distance(b)))
    }

    /// Least number 4 of corner `p`, for number 5 over the edge from it to `r`, times the sign.
    fn four_bound(
        &self,
        t: usize,
        side: Side,
        upper: &Upper,
        [p, r, k]: [usize; 3],
    ) -> Option<f64> {
        let ([x, y, o, q], length) = self.split_in(t, side, k)?;
        let [x, y] = if p == k { [x, y] } else { [y, x] };
        let HullTriangle { corners, apices, .. } = self.hull.triangles[t];
        let opposite = 3 - p - r;
        let known = o * upper.three[edge_between(opposite, p)]
            + x * self.one(corners[p], apices[side.index()]?)
            + y * upper.three[k];
        Some((MARGIN * length - side.sign() * known) / q)
    }

    /// Least number 6, for number 5 at the apex over edge `k`, times the sign.
    fn six_bound(&self, t: usize, side: Side, upper: &Upper, k: usize) -> Option<f64> {
        let ([x, y, o, q], length) = self.split_in(t, side, k)?;
        let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|i| upper.four[i]);
        Some((MARGIN * length - side.sign() * (x * a + y * b + o * c)) / q)
    }
}
