//! The weights of single tetrahedra; those at split points follow from the others.

use super::{MARGIN, Weights, edge_between};
use crate::bernstein::indices;
use crate::polyhedral::hull::{Cell, HullTriangle, Split};
use crate::rational::Side;

impl Weights<'_> {
    /// All weights of a cell.
    pub(super) fn of_cell(&self, cell: Cell) -> [f64; 20] {
        let mut weights = [0.0; 20];
        for (w, index) in weights.iter_mut().zip(indices(3)) {
            let mut places = [0; 3];
            let all = (0..4).flat_map(|c| std::iter::repeat_n(c, index[c]));
            places.iter_mut().zip(all).for_each(|(place, c)| *place = c);
            *w = match cell {
                Cell::Face(t, side) => self.in_face(t, side, places),
                Cell::Edge(e, side, which) => self.in_edge(e, side, which, places),
            };
        }
        weights
    }

    /// A weight of the tetrahedron over a triangle, by the places of its points in ascending order.
    fn in_face(&self, t: usize, side: Side, [i, j, k]: [usize; 3]) -> f64 {
        let HullTriangle { corners, apices, .. } = self.hull.triangles[t];
        let made = "invariant: cells have apices";
        let upper = self.upper[t][side.index()].as_ref().expect(made);
        let apex = apices[side.index()].expect(made);
        let one = |p: usize, x: usize| self.one(corners[p], if x == 3 { apex } else { corners[x] });
        match [i, j, k] {
            [3, 3, 3] => upper.six,
            [p, 3, 3] => upper.four[p],
            [0, 1, 2] => self.middle[t],
            [a, b, _] if a == b && b == k => 0.0,
            [a, b, x] if a == b => one(a, x),
            [x, a, b] if a == b => one(a, x),
            [a, b, _] => upper.three[edge_between(a, b)],
        }
    }

    /// A weight of a tetrahedron over an edge, by the places of its points: ends, split point, apex.
    fn in_edge(&self, e: usize, side: Side, which: usize, places: [usize; 3]) -> f64 {
        const S: usize = 2;
        let edge = &self.hull.edges[e];
        let split = edge.splits[side.index()].as_ref().expect("invariant: cells have splits");
        let t = edge.triangles[which];
        let at = |p: usize| self.corner_of(t, edge.ends[p]);
        let face = |t: usize, places: [usize; 3]| {
            let mut places = places;
            places.sort_unstable();
            self.in_face(t, side, places)
        };
        // without the split point: the weight of the triangle's tetrahedron
        let named = |p: usize| if p == 3 { 3 } else { at(p) };
        let blend = |x: usize, y: usize| {
            let [a, b] = [0, 1].map(|i| self.in_edge_with(e, side, i, split, [x, y]));
            a * (1.0 - split.mu) + b * split.mu
        };
        match places {
            [S, S, S] => {
                let [a, b] = [0, 1].map(|i| self.six_split(e, side, i, split));
                a * (1.0 - split.mu) + b * split.mu
            }
            [S, S, 3] => self.six_split(e, side, which, split),
            // number 7
            [p, S, S] => blend(p, S),
            [p, r, S] if p == r => self.one(edge.ends[p], split.point),
            [a, b, S] => {
                let three = |i: usize| {
                    let t = edge.triangles[i];
                    let [a, b] = [a, b].map(|p| self.corner_of(t, edge.ends[p]));
                    self.in_face(t, side, [a.min(b), a.max(b), 3])
                };
                three(0) * (1.0 - split.mu) + three(1) * split.mu
            }
            [p, S, 3] => self.in_edge_with(e, side, which, split, [p, 3]),
            [S, 3, 3] => self.in_edge_with(e, side, which, split, [3, 3]),
            [x, y, z] => face(t, [x, y, z].map(named)),
        }
    }

    /// The weight of `x`, `y` and the split point by the C1 condition across the triangle's
    /// tetrahedron; places as in [`Self::in_edge`]. For `y` the split point, `w(x q s)`.
    fn in_edge_with(
        &self,
        e: usize,
        side: Side,
        which: usize,
        split: &Split,
        xy: [usize; 2],
    ) -> f64 {
        let edge = &self.hull.edges[e];
        let t = edge.triangles[which];
        let ends = edge.ends.map(|p| self.corner_of(t, p));
        let named = |p: usize| if p == 3 { 3 } else { ends[p] };
        // the split point is reached through the apex
        let [x, y] = xy.map(|p| named(if p == 2 { 3 } else { p }));
        let opposite = 3 - ends[0] - ends[1];
        let corners = [opposite, ends[0], ends[1], 3];
        let terms = corners.into_iter().zip(split.coordinates[which]).map(|(c, weight)| {
            let mut places = [x, y, c];
            places.sort_unstable();
            weight * self.in_face(t, side, places)
        });
        terms.sum()
    }

    /// Number 6 of a split point, `w(qss)`: the C2 extension of the triangle's function if it has the
    /// right sign.
    fn six_split(&self, e: usize, side: Side, which: usize, split: &Split) -> f64 {
        let edge = &self.hull.edges[e];
        let t = edge.triangles[which];
        let ends = edge.ends.map(|p| self.corner_of(t, p));
        let corners = [3 - ends[0] - ends[1], ends[0], ends[1], 3];
        let x = split.coordinates[which];
        let mut sum = 0.0;
        for i in 0..4 {
            for j in 0..4 {
                let mut places = [corners[i], corners[j], 3];
                places.sort_unstable();
                sum += x[i] * x[j] * self.in_face(t, side, places);
            }
        }
        let length = self.point(edge.ends[0]).distance(self.point(edge.ends[1]));
        side.sign() * (side.sign() * sum).max(MARGIN * length)
    }

    /// Place of a point among the corners of a triangle.
    fn corner_of(&self, t: usize, p: usize) -> usize {
        let corners = self.hull.triangles[t].corners;
        corners.iter().position(|&c| c == p).expect("invariant: a corner of the triangle")
    }
}
