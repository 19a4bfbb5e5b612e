//! The closest triangle of many.

use glam::DVec3;

/// What rounding may change a squared distance by.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Triangles of a leaf.
const LEAF: usize = 4;

/// A binary tree of boxes around triangles, halved along the longest axis; the same on every run.
#[derive(Clone, Debug)]
pub struct TriangleTree {
    triangles: Vec<[DVec3; 3]>,
    /// Triangles in the order of the leaves.
    order: Vec<u32>,
    nodes: Vec<Node>,
}

/// A box; either with two children, the first of which is the next node, or with triangles.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Inner { second: u32 },
    Leaf { first: u32, count: u32 },
}

/// The closest point of a set of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// The triangle; the lowest if several are equally close.
    pub triangle: usize,
    /// Weights of its corners; exactly zero for corners that do not count.
    pub weights: [f64; 3],
    /// The point.
    pub point: DVec3,
    /// Its distance.
    pub distance: f64,
}

impl TriangleTree {
    /// A tree over these triangles, numbered in their order; their coordinates must be finite.
    #[must_use]
    pub fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let mut order: Vec<u32> = (0..triangles.len()).map(number).collect();
        let mut nodes = Vec::with_capacity(triangles.len());
        if !triangles.is_empty() {
            build(&triangles, &mut order, 0, &mut nodes);
        }
        Self { triangles, order, nodes }
    }

    /// The triangles.
    #[must_use]
    pub fn triangles(&self) -> &[[DVec3; 3]] {
        &self.triangles
    }

    /// The closest point to `p`; `None` without triangles or for a point that is not finite.
    #[must_use]
    pub fn closest(&self, p: DVec3) -> Option<ClosestPoint> {
        if self.nodes.is_empty() || !p.is_finite() {
            return None;
        }
        let mut best: Option<ClosestPoint> = None;
        let mut limit = f64::INFINITY;
        // halving leaves no more open boxes than there are bits in a number, and one
        let mut open = [(0.0, 0_u32); 34];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (square, at) = open[count];
            // boxes as near up to rounding may hold a lower number
            if square > limit * (1.0 + ROUNDING) {
                continue;
            }
            match self.nodes[at as usize].kind {
                Kind::Leaf { first, count } => {
                    for &triangle in &self.order[first as usize..(first + count) as usize] {
                        let triangle = triangle as usize;
                        let (weights, point) = closest_weights(p, self.triangles[triangle]);
                        let square = point.distance_squared(p);
                        if square < limit
                            || (square == limit && best.is_none_or(|b| triangle < b.triangle))
                        {
                            limit = square;
                            best = Some(ClosestPoint {
                                triangle,
                                weights,
                                point,
                                distance: square.sqrt(),
                            });
                        }
                    }
                }
                Kind::Inner { second } => {
                    let children = [at + 1, second].map(|c| (self.square_distance(c, p), c));
                    let [near, far] = children;
                    let sorted = if near.0 <= far.0 { [far, near] } else { [near, far] };
                    open[count..count + 2].copy_from_slice(&sorted);
                    count += 2;
                }
            }
        }
        best
    }

    fn square_distance(&self, node: u32, p: DVec3) -> f64 {
        let Node { low, high, .. } = self.nodes[node as usize];
        (low - p).max(p - high).max(DVec3::ZERO).length_squared()
    }
}

/// Appends the node over `order`, which begins at `first` among all, and those below it.
fn build(triangles: &[[DVec3; 3]], order: &mut [u32], first: usize, nodes: &mut Vec<Node>) {
    let points = order.iter().flat_map(|&t| triangles[t as usize]);
    let (low, high) = points
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let at = nodes.len();
    let kind = Kind::Leaf { first: number(first), count: number(order.len()) };
    nodes.push(Node { low, high, kind });
    if order.len() <= LEAF {
        return;
    }
    let axis = (high - low).max_position();
    let centre = |t: u32| {
        let [a, b, c] = triangles[t as usize];
        a[axis] + b[axis] + c[axis]
    };
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&s, &t| centre(s).total_cmp(&centre(t)).then(s.cmp(&t)));
    let (left, right) = order.split_at_mut(half);
    build(triangles, left, first, nodes);
    nodes[at].kind = Kind::Inner { second: number(nodes.len()) };
    build(triangles, right, first + half, nodes);
}

fn number(index: usize) -> u32 {
    u32::try_from(index).expect("invariant: face counts fit 32 bits")
}

/// Weights and position of the point of a triangle that is closest to `p`.
fn closest_weights(p: DVec3, [a, b, c]: [DVec3; 3]) -> ([f64; 3], DVec3) {
    let normal = (b - a).cross(c - a);
    let square = normal.length_squared();
    if square > 0.0 {
        // signed areas of the parts, over the whole
        let [u, v, w] = [(b, c), (c, a), (a, b)]
            .map(|(from, to)| normal.cross(to - from).dot(p - from) / square);
        if u > 0.0 && v > 0.0 && w > 0.0 {
            let sum = u + v + w;
            let weights = [u / sum, v / sum, w / sum];
            return (weights, a * weights[0] + b * weights[1] + c * weights[2]);
        }
    }
    let on_edge = |from: DVec3, to: DVec3, [i, j]: [usize; 2]| {
        let d = to - from;
        let square = d.length_squared();
        let t = if square > 0.0 { (d.dot(p - from) / square).clamp(0.0, 1.0) } else { 0.0 };
        let mut weights = [0.0; 3];
        weights[i] = 1.0 - t;
        weights[j] = t;
        let point = if t == 0.0 {
            from
        } else if t == 1.0 {
            to
        } else {
            from + d * t
        };
        (point.distance_squared(p), weights, point)
    };
    let [first, second, third] =
        [on_edge(a, b, [0, 1]), on_edge(b, c, [1, 2]), on_edge(c, a, [2, 0])];
    let nearer =
        |x: (f64, [f64; 3], DVec3), y: (f64, [f64; 3], DVec3)| if y.0 < x.0 { y } else { x };
    let (_, weights, point) = nearer(nearer(first, second), third);
    (weights, point)
}
