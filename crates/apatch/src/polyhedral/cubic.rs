//! The C1 cubic in closed form \[BCX94 section 4\]. Weights are named by the numbers of the paper.
//!
//! Each weight belongs to a set of three points of the hull; `w(abq)` is that of `a`, `b` and `q`.

use glam::DVec3;

use super::hull::{Cell, Hull, HullTriangle, Split};
use super::middle_weights;
use super::settings::ShapeControl;
use super::skeleton::{PointOrigin, TriangleOrigin};
use crate::bernstein::indices;
use crate::rational::{Convexity, Side};
use crate::tetrahedron::Tetrahedron;

/// Weights on one side of a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Upper {
    /// Number 3, `w(abq)`, of each edge.
    pub(crate) three: [f64; 3],
    /// Number 4, `w(pqq)`, of each corner.
    four: [f64; 3],
    /// Number 6, `w(qqq)`.
    six: f64,
}

/// All weights but those of split points, which follow from them.
#[derive(Clone, Debug)]
pub(crate) struct Weights<'a> {
    pub(crate) hull: &'a Hull,
    /// Number 2 of each triangle.
    pub(crate) middle: Vec<f64>,
    /// Of each triangle and side.
    upper: Vec<[Option<Upper>; 2]>,
}

/// Least upper weights, in lengths of the edge.
const MARGIN: f64 = 1e-9;

/// The weights of all cells, 20 each.
pub(crate) fn cubic(hull: &Hull, shape: &ShapeControl) -> Vec<f64> {
    let upper = hull.triangles.iter().map(|t| t.apices.map(|q| q.map(|_| Upper::default())));
    let mut weights = Weights { hull, middle: Vec::new(), upper: upper.collect() };
    weights.middle = (0..hull.triangles.len()).map(|t| weights.default_middle(t, shape)).collect();
    middle_weights::balance(&mut weights);
    for e in 0..hull.edges.len() {
        for side in Side::BOTH {
            if let Some(split) = &hull.edges[e].splits[side.index()] {
                weights.set_three(e, side, split);
            }
        }
    }
    (0..hull.triangles.len()).for_each(|t| weights.transfer(t));
    for t in 0..hull.triangles.len() {
        for side in Side::BOTH {
            weights.set_upper(t, side, tension(hull, shape, t).exp2());
        }
    }
    hull.cells.iter().flat_map(|&cell| weights.of_cell(cell)).collect()
}

impl Hull {
    /// The weights of the C1 cubic for all cells, 20 each: see
    /// [`PolyhedralSurface::weights`](super::PolyhedralSurface::weights).
    #[must_use]
    pub fn cubic_weights(&self, shape: &ShapeControl) -> Vec<f64> {
        cubic(self, shape)
    }
}

/// Mean of the tensions at the faces that a triangle touches.
fn tension(hull: &Hull, shape: &ShapeControl, t: usize) -> f64 {
    let corners = hull.triangles[t].corners;
    let faces = corners.into_iter().filter_map(|p| match hull.origins[p] {
        PointOrigin::Guard(face) => Some(shape.tension_of(face)),
        PointOrigin::Corner(_) => None,
    });
    let (sum, count) = faces.fold((0.0, 0.0), |(sum, count), t| (sum + t, count + 1.0));
    if count > 0.0 { sum / count } else { shape.tension }
}

impl Weights<'_> {
    fn point(&self, p: usize) -> DVec3 {
        self.hull.points[p]
    }

    /// Number 1, `w(ppx)`, for a point `x` of the hull.
    pub(crate) fn one(&self, p: usize, x: usize) -> f64 {
        (self.point(x) - self.point(p)).dot(self.hull.normals[p]) / 3.0
    }

    /// Number 2 as a quadric would have it, and the cut asked for.
    fn default_middle(&self, t: usize, shape: &ShapeControl) -> f64 {
        let HullTriangle { corners, origin, edges, .. } = self.hull.triangles[t];
        let pairs = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3]]);
        let quadric = pairs.map(|[a, b]| self.one(a, b) + self.one(b, a)).iter().sum::<f64>() / 4.0;
        let at = match origin {
            TriangleOrigin::Corner(v) | TriangleOrigin::Fan([v, _]) => Some(v),
            TriangleOrigin::Edge(_) | TriangleOrigin::Face(_) => None,
        };
        let cut = at.and_then(|v| shape.cuts.get(&v)).copied().unwrap_or(shape.cut);
        let has = |side| edges.iter().any(|&e| self.hull.edges[e].convexity.has(side));
        let sign = match (has(Side::Positive), has(Side::Negative)) {
            (true, false) => 1.0,
            (false, true) => -1.0,
            // on both sides there is no corner to cut
            _ => 0.0,
        };
        let lengths = pairs.map(|[a, b]| self.point(a).distance(self.point(b)));
        quadric + sign * cut * lengths.into_iter().fold(0.0, f64::max)
    }

    /// The right-hand sides of the two conditions for number 3 over an edge.
    pub(crate) fn right_sides(&self, e: usize, split: &Split) -> [f64; 2] {
        let edge = &self.hull.edges[e];
        let [a, b] = edge.ends;
        [0, 1].map(|i| {
            let [o, x, y, _] = split.coordinates[i];
            o * self.middle[edge.triangles[i]] + x * self.one(a, b) + y * self.one(b, a)
        })
    }

    /// Number 3 of both triangles at an edge:
    /// `(1 - mu) x_1 + mu x_2 - beta4_i x_i = right side i`.
    fn set_three(&mut self, e: usize, side: Side, split: &Split) {
        let matrix = three_matrix(split);
        let right = self.right_sides(e, split);
        let [[a, b], [c, d]] = matrix;
        let solution = if is_coplanar(split) {
            // the conditions agree: of all solutions the shortest
            let square = a * a + b * b + c * c + d * d;
            [(a * right[0] + c * right[1]) / square, (b * right[0] + d * right[1]) / square]
        } else {
            let determinant = a * d - b * c;
            [
                (d * right[0] - b * right[1]) / determinant,
                (a * right[1] - c * right[0]) / determinant,
            ]
        };
        let triangles = self.hull.edges[e].triangles;
        for (t, x) in triangles.into_iter().zip(solution) {
            let k = self.place(t, e);
            if let Some(upper) = &mut self.upper[t][side.index()] {
                upper.three[k] = x;
            }
        }
    }

    /// Place of an edge in a triangle.
    fn place(&self, t: usize, e: usize) -> usize {
        let edges = self.hull.triangles[t].edges;
        edges.iter().position(|&other| other == e).expect("invariant: an edge of the triangle")
    }

    /// Number 3 of a triangle with both apices, on the side where the edge has no tetrahedra: so that
    /// the function is C1 across the triangle.
    fn transfer(&mut self, t: usize) {
        let [Some(mut upper), Some(mut lower)] = self.upper[t] else { return };
        let HullTriangle { corners, edges, apices: [Some(u), Some(l)], .. } =
            self.hull.triangles[t]
        else {
            return;
        };
        let [p, q, r] = corners.map(|c| self.point(c));
        let x = Tetrahedron::new([p, q, r, self.point(u)]).barycentric(self.point(l));
        for (k, &edge) in edges.iter().enumerate() {
            let [a, b, o] = [k, (k + 1) % 3, (k + 2) % 3];
            let flat = x[o] * self.middle[t]
                + x[a] * self.one(corners[a], corners[b])
                + x[b] * self.one(corners[b], corners[a]);
            match self.hull.edges[edge].convexity {
                Convexity::Positive => lower.three[k] = flat + x[3] * upper.three[k],
                Convexity::Negative => upper.three[k] = (lower.three[k] - flat) / x[3],
                Convexity::Nonconvex | Convexity::Zero => {}
            }
        }
        self.upper[t] = [Some(upper), Some(lower)];
    }

    /// Numbers 4 and 6: as a quadric through the data would have them, times a factor, but large
    /// enough for the weights of the edge tetrahedra to have the right sign.
    fn set_upper(&mut self, t: usize, side: Side, factor: f64) {
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

    /// All weights of a cell.
    fn of_cell(&self, cell: Cell) -> [f64; 20] {
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

/// The edge of a triangle between two of its corners.
const fn edge_between(a: usize, b: usize) -> usize {
    // edge k runs from corner k to the next: opposite to corner k + 2
    (4 - a - b) % 3
}

/// The matrix of the two conditions for number 3.
pub(crate) fn three_matrix(split: &Split) -> [[f64; 2]; 2] {
    let (left, right) = (1.0 - split.mu, split.mu);
    let [a, b] = split.coordinates.map(|x| x[3]);
    [[left - a, right], [left, right - b]]
}

/// Whether the triangles at an edge lie in one plane: the conditions for number 3 are then dependent.
pub(crate) fn is_coplanar(split: &Split) -> bool {
    let [[a, b], [c, d]] = three_matrix(split);
    let square = a * a + b * b + c * c + d * d;
    (a * d - b * c).abs() <= 1e-10 * square
}
