//! The C1 cubic in closed form \[BCX94 section 4\]. Weights are named by the numbers of the paper.
//!
//! Each weight belongs to a set of three points of the hull; `w(abq)` is that of `a`, `b` and `q`.

mod cells;
mod upper;

use glam::DVec3;

use super::hull::{Hull, HullTriangle, Split};
use super::middle_weights;
use super::settings::ShapeControl;
use super::skeleton::{PointOrigin, TriangleOrigin};
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
    with_middle(hull, shape, default_middle(hull, shape))
}

/// Number 2 of all triangles.
pub(crate) fn default_middle(hull: &Hull, shape: &ShapeControl) -> Vec<f64> {
    let mut weights = Weights::with_middle(hull, Vec::new());
    weights.middle = (0..hull.triangles.len()).map(|t| weights.default_middle(t, shape)).collect();
    middle_weights::balance(&mut weights);
    weights.middle
}

/// The weights of all cells for given numbers 2.
pub(crate) fn with_middle(hull: &Hull, shape: &ShapeControl, middle: Vec<f64>) -> Vec<f64> {
    let mut weights = Weights::with_middle(hull, middle);
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

impl<'a> Weights<'a> {
    /// Nothing known but numbers 2.
    pub(crate) fn with_middle(hull: &'a Hull, middle: Vec<f64>) -> Self {
        let upper = hull.triangles.iter().map(|t| t.apices.map(|q| q.map(|_| Upper::default())));
        Self { hull, middle, upper: upper.collect() }
    }

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
