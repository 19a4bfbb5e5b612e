//! A tree of bounding boxes, for finding the cells at a point or along a ray.

use glam::DVec3;

use crate::ray::Ray;

/// Cells a leaf may hold.
const LEAF: usize = 4;

/// A binary tree of axis-parallel boxes over numbered cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Hierarchy {
    nodes: Vec<Node>,
    /// Cells, ordered so that each node holds a range.
    order: Vec<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// Range of a leaf in the order; of an inner node only the start is used: its right child (the
    /// left one follows it).
    start: usize,
    /// 0 for an inner node.
    count: usize,
}

impl Hierarchy {
    /// Over cells with these bounding boxes, numbered in this order; time `n log n`.
    #[must_use]
    pub fn new(boxes: &[[DVec3; 2]]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..boxes.len()).collect() };
        if !boxes.is_empty() {
            let mut order = std::mem::take(&mut tree.order);
            tree.build(boxes, &mut order, 0);
            tree.order = order;
        }
        tree
    }

    fn build(&mut self, boxes: &[[DVec3; 2]], order: &mut [usize], start: usize) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &cell in order.iter() {
            (low, high) = (low.min(boxes[cell][0]), high.max(boxes[cell][1]));
        }
        let at = self.nodes.len();
        self.nodes.push(Node { low, high, start, count: order.len() });
        if order.len() <= LEAF {
            return;
        }
        let axis = (high - low).max_position();
        let key = |cell: usize| boxes[cell][0][axis] + boxes[cell][1][axis];
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
        let (left, right) = order.split_at_mut(middle);
        self.build(boxes, left, start);
        let child = self.nodes.len();
        self.build(boxes, right, start + middle);
        (self.nodes[at].start, self.nodes[at].count) = (child, 0);
    }

    /// Calls `visit` for every cell whose box, grown by `margin`, holds the point, until it returns
    /// `true`.
    pub fn at_point(&self, p: DVec3, margin: f64, mut visit: impl FnMut(usize) -> bool) {
        let mut stack: Vec<usize> = (!self.nodes.is_empty()).then_some(0).into_iter().collect();
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at];
            let inside = p.cmpge(node.low - margin).all() && p.cmple(node.high + margin).all();
            if !inside {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.start, at + 1]);
            } else if self.order[node.start..node.start + node.count].iter().any(|&c| visit(c)) {
                return;
            }
        }
    }

    /// Calls `visit` for every cell in a leaf that meets the box, and for others near it.
    pub fn in_box(&self, [low, high]: [DVec3; 2], mut visit: impl FnMut(usize)) {
        let mut stack: Vec<usize> = (!self.nodes.is_empty()).then_some(0).into_iter().collect();
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at];
            if !(low.cmple(node.high).all() && high.cmpge(node.low).all()) {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.start, at + 1]);
            } else {
                self.order[node.start..node.start + node.count].iter().for_each(|&c| visit(c));
            }
        }
    }

    /// Calls `visit` for the cells whose boxes the ray meets, nearer boxes first; each call returns
    /// how far the ray is still of interest.
    pub fn along_ray(&self, ray: &Ray, mut visit: impl FnMut(usize) -> f64) {
        let mut far = f64::INFINITY;
        let enter =
            |at: usize, far: f64| self.nodes.get(at).and_then(|n| ray.enters([n.low, n.high], far));
        let mut stack: Vec<(f64, usize)> = enter(0, far).map(|s| (s, 0)).into_iter().collect();
        while let Some((s, at)) = stack.pop() {
            if s > far {
                continue;
            }
            let node = &self.nodes[at];
            if node.count > 0 {
                for &cell in &self.order[node.start..node.start + node.count] {
                    far = far.min(visit(cell));
                }
                continue;
            }
            let mut children = [node.start, at + 1].map(|c| (enter(c, far), c));
            if children[0].0 < children[1].0 {
                children.swap(0, 1);
            }
            // the nearer child is taken from the stack first
            stack.extend(children.into_iter().filter_map(|(s, c)| s.map(|s| (s, c))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn boxes(numbers: &[(f64, f64, f64)]) -> Vec<[DVec3; 2]> {
        numbers
            .iter()
            .map(|&(x, y, z)| DVec3::new(x, y, z))
            .map(|low| [low, low + DVec3::splat(0.2)])
            .collect()
    }

    proptest! {
        #[test]
        fn finds_what_a_plain_search_finds(
            numbers in proptest::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64), 0..60),
            origin in (-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64),
            target in (0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64),
        ) {
            let boxes = boxes(&numbers);
            let tree = Hierarchy::new(&boxes);
            let point = DVec3::from(target);
            let mut found = Vec::new();
            tree.at_point(point, 0.0, |cell| { found.push(cell); false });
            found.sort_unstable();
            found.retain(|&c| point.cmpge(boxes[c][0]).all() && point.cmple(boxes[c][1]).all());
            let plain: Vec<_> = (0..boxes.len())
                .filter(|&c| point.cmpge(boxes[c][0]).all() && point.cmple(boxes[c][1]).all())
                .collect();
            prop_assert_eq!(found, plain);

            let origin = DVec3::from(origin);
            let ray = Ray { origin, direction: point - origin };
            let nearest = |cell: usize| ray.enters(boxes[cell], f64::INFINITY).unwrap_or(f64::INFINITY);
            let mut best = f64::INFINITY;
            tree.along_ray(&ray, |cell| { best = best.min(nearest(cell)); best });
            let plain = (0..boxes.len()).map(nearest).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(best, plain);
        }
    }
}
