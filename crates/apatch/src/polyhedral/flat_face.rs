//! A face in coordinates of its plane: half-planes, visibility, the deepest point of some of them.

use glam::{DVec2, DVec3};

use super::polyhedron::Polyhedron;

/// An edge of a face, its inside on the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FlatEdge {
    pub(crate) from: DVec2,
    pub(crate) to: DVec2,
    /// Unit vector to the inside.
    inward: DVec2,
}

impl FlatEdge {
    fn new(from: DVec2, to: DVec2) -> Self {
        Self { from, to, inward: (to - from).perp().normalize_or_zero() }
    }

    /// Distance of a point from the line of the edge, positive inside.
    pub(crate) fn depth(&self, p: DVec2) -> f64 {
        self.inward.dot(p - self.from)
    }

    /// Whether a segment passes through the inner part of the edge.
    fn is_crossed(&self, p: DVec2, q: DVec2) -> bool {
        let side = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
        let split = |x: f64, y: f64| (x > 0.0 && y < 0.0) || (x < 0.0 && y > 0.0);
        split(self.depth(p), self.depth(q)) && split(side(p, q, self.from), side(p, q, self.to))
    }
}

/// A face in the coordinates of its plane; the origin is its centroid.
#[derive(Clone, Debug)]
pub(crate) struct FlatFace {
    origin: DVec3,
    axes: [DVec3; 2],
    /// Sides of the polyhedron, loop by loop, each from the vertex with the lowest number.
    pub(crate) loops: Vec<Vec<usize>>,
    /// The edge of each side, in the same order.
    pub(crate) edges: Vec<Vec<FlatEdge>>,
    /// Largest coordinate.
    pub(crate) size: f64,
}

/// Slack relative to the size of the face below which a point is on a line.
const ON_LINE: f64 = 1e-9;

impl FlatFace {
    pub(crate) fn new(solid: &Polyhedron, face: usize, first_side: usize) -> Self {
        let facet = &solid.facets()[face];
        let axes = facet.normal.any_orthonormal_pair();
        let axes = [axes.0, axes.1];
        let origin = facet.centroid;
        let flat = |vertex: usize| axes.map(|a| a.dot(solid.position(vertex) - origin)).into();
        let mut start = first_side;
        let mut loops = Vec::new();
        for corners in &facet.loops {
            let n = corners.len();
            let lowest = (0..n).min_by_key(|&i| corners[i]).unwrap_or(0);
            loops.push((0..n).map(|i| start + (lowest + i) % n).collect::<Vec<_>>());
            start += n;
        }
        let edge = |&side: &usize| {
            let side = solid.sides[side];
            FlatEdge::new(flat(side.origin), flat(side.target))
        };
        let edges: Vec<Vec<FlatEdge>> =
            loops.iter().map(|l| l.iter().map(edge).collect()).collect();
        let size = edges.iter().flatten().map(|e| e.from.abs().max_element()).fold(0.0, f64::max);
        Self { origin, axes, loops, edges, size }
    }

    /// The point in space.
    pub(crate) fn lift(&self, p: DVec2) -> DVec3 {
        self.origin + self.axes[0] * p.x + self.axes[1] * p.y
    }

    /// The foot of a point in space.
    pub(crate) fn drop(&self, p: DVec3) -> DVec2 {
        self.axes.map(|a| a.dot(p - self.origin)).into()
    }

    /// Whether no corner is reflex and there are no holes.
    pub(crate) fn is_convex(&self) -> bool {
        let [outer] = &*self.edges else { return false };
        let next = outer.iter().cycle().skip(1);
        outer.iter().zip(next).all(|(e, next)| e.depth(next.to) >= -ON_LINE * self.size)
    }

    /// The two edges at a corner: that which ends and that which starts there.
    fn at_corner(&self, [in_loop, corner]: [usize; 2]) -> [FlatEdge; 2] {
        let edges = &self.edges[in_loop];
        [edges[(corner + edges.len() - 1) % edges.len()], edges[corner]]
    }

    /// Whether a point is a guard of a corner: inside both edges there, and sees it.
    pub(crate) fn guards(&self, p: DVec2, corner: [usize; 2]) -> bool {
        let sides = self.at_corner(corner);
        let inside = sides.iter().all(|e| e.depth(p) > ON_LINE * self.size);
        let at = sides[1].from;
        inside && !self.edges.iter().flatten().any(|e| e.is_crossed(p, at))
    }

    /// The point deepest inside the edges at some corners, and inside all other edges that have those
    /// corners on their inner side; with its depth. `None` if it does not guard all corners.
    pub(crate) fn guard_of(&self, corners: &[[usize; 2]]) -> Option<(DVec2, f64)> {
        let slack = -ON_LINE * self.size;
        let at: Vec<DVec2> = corners.iter().map(|&c| self.at_corner(c)[1].from).collect();
        let around = |e: &FlatEdge| at.iter().all(|p| e.depth(*p) >= slack);
        let mut lines: Vec<FlatEdge> = corners.iter().flat_map(|&c| self.at_corner(c)).collect();
        lines.extend(self.edges.iter().flatten().filter(|e| around(e)));
        let (p, depth) = deepest(&lines, self.size)?;
        corners.iter().all(|&c| self.guards(p, c)).then_some((p, depth))
    }

    /// The point deepest inside all edges, if there is one inside all of them.
    pub(crate) fn kernel_centre(&self) -> Option<DVec2> {
        let lines: Vec<FlatEdge> = self.edges.iter().flatten().copied().collect();
        deepest(&lines, self.size).map(|(p, _)| p)
    }
}

/// The point with the largest least depth, and that depth; the middle one if there are several.
///
/// By trying all triples of lines: faces have few edges, and unlike an interior-point method this
/// gives symmetric faces exactly symmetric guards.
fn deepest(lines: &[FlatEdge], size: f64) -> Option<(DVec2, f64)> {
    let slack = ON_LINE * size;
    let mut best: Vec<(DVec2, f64)> = Vec::new();
    for i in 0..lines.len() {
        for j in 0..i {
            for k in 0..j {
                let Some((p, depth)) = equidistant([lines[i], lines[j], lines[k]]) else {
                    continue;
                };
                let known = best.first().map_or(slack, |b| b.1);
                if depth < known - slack || lines.iter().any(|e| e.depth(p) < depth - slack) {
                    continue;
                }
                if depth > known + slack {
                    best.clear();
                }
                if best.iter().all(|(q, _)| q.distance(p) > slack) {
                    best.push((p, depth));
                }
            }
        }
    }
    let count = best.len() as f64;
    let depth = best.first()?.1;
    let middle = best.iter().map(|(p, _)| *p).sum::<DVec2>() / count;
    Some((middle, depth))
}

/// The point at equal depths inside three lines, and the depth.
fn equidistant([a, b, c]: [FlatEdge; 3]) -> Option<(DVec2, f64)> {
    // n_i p - r = n_i from_i; differences of two rows have no r
    let (ab, ac) = (a.inward - b.inward, a.inward - c.inward);
    let offset = |e: FlatEdge| e.inward.dot(e.from);
    let (x, y) = (offset(a) - offset(b), offset(a) - offset(c));
    let determinant = ab.perp_dot(ac);
    // unit normals: parallel lines give round-off
    if determinant.abs() <= 1e-9 {
        return None;
    }
    let p = DVec2::new(x * ac.y - y * ab.y, y * ab.x - x * ac.x) / determinant;
    p.is_finite().then(|| (p, a.depth(p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 2]]) -> Vec<FlatEdge> {
        let at = |i: usize| DVec2::from_array(corners[i % corners.len()]);
        (0..corners.len()).map(|i| FlatEdge::new(at(i), at(i + 1))).collect()
    }

    #[test]
    fn the_middle_of_a_rectangle_and_of_the_kernel_of_an_l() {
        let rectangle = polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
        assert_eq!(deepest(&rectangle, 2.0), Some((DVec2::new(1.0, 0.5), 0.5)));
        let l = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        assert_eq!(deepest(&polygon(&l), 2.0), Some((DVec2::new(0.5, 0.5), 0.5)));
    }

    #[test]
    fn nothing_inside_all_sides_of_a_u() {
        let u = [
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 2.0],
            [2.0, 2.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ];
        assert_eq!(deepest(&polygon(&u), 3.0), None);
    }
}
