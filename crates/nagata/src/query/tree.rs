//! A hierarchy of oriented boxes around flat triangles.

use std::cell::Cell;
use std::hint::black_box;

use glam::DVec3;

use super::leaf::{Leaf, Reach};
use super::piece::Flat;
use super::ray::Ray;

/// Children of a node.
pub(super) const WIDTH: usize = 8;
/// Marks an item or a leaf among the entries of a traversal.
const LAST: u32 = 1 << 31;

/// A tree over numbered items, each a flat triangle with what bulges from it. Items are numbered in the
/// order of the leaves; the depth is the logarithm of their number, whatever they are.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// Eight items each, in order.
    leaves: Vec<Leaf>,
    /// Length of a unit of the boxes.
    unit: f64,
}

/// Up to eight boxes with sides parallel to common axes.
#[derive(Clone, Debug)]
pub(super) struct Node {
    centre: DVec3,
    /// Orthogonal; their lengths are one in units of the boxes.
    axes: [DVec3; 3],
    /// Lowest and highest coordinates along the axes, rounded outward.
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    /// The first child, the others follow: items, marked, or nodes.
    first: u32,
    /// The same, but with leaves, marked, for children that are items or have no other children.
    first_or_leaf: u32,
    count: u32,
}

impl Tree {
    /// Sorts the items.
    pub(super) fn new(items: &mut [Flat]) -> Self {
        let points = || items.iter().flat_map(|item| item.corners);
        let (low, high) = points()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
                (low.min(p), high.max(p))
            });
        let size = (high - low).max_element();
        let unit = if size > 0.0 { size } else { 1.0 };
        let mut tree = Self { nodes: vec![Node::EMPTY], leaves: Vec::new(), unit };
        tree.fill(0, 0, items);
        tree.leaves = items.chunks(WIDTH).map(|items| Leaf::new(items, 1.0 / unit)).collect();
        tree
    }

    /// Makes this node one over these items; `first` is where they are among all.
    fn fill(&mut self, at: usize, first: usize, items: &mut [Flat]) {
        let mut part = 1;
        while part * WIDTH < items.len() {
            part *= WIDTH;
        }
        sort_into_parts(items, part);
        let scale = 1.0 / self.unit;
        let mut node = Node::oriented(items, scale);
        for (k, items) in items.chunks(part).enumerate() {
            node.set_box(k, items, scale);
        }
        node.count = number(items.len().div_ceil(part));
        // all parts before the last one are full: leaves begin with multiples of their size
        let leaf = number(first / WIDTH) | LAST;
        if part == 1 {
            (node.first, node.first_or_leaf) = (number(first) | LAST, leaf);
            self.nodes[at] = node;
            return;
        }
        let child = self.nodes.len();
        node.first = number(child);
        node.first_or_leaf = if part == WIDTH { leaf } else { node.first };
        self.nodes.resize(child + node.count as usize, Node::EMPTY);
        self.nodes[at] = node;
        for (k, items) in items.chunks_mut(part).enumerate() {
            self.fill(child + k, first + k * part, items);
        }
    }

    /// Visits runs of up to eight items whose box is not farther from `p` than `limit`, which may be lowered
    /// meanwhile; roughly the nearest first. `visit` takes the first item.
    pub(super) fn visit_near(
        &self,
        p: DVec3,
        limit: &Cell<f64>,
        mut visit: impl FnMut(usize, &Reach),
    ) {
        let squared = |distance: f64| (distance / self.unit) * (distance / self.unit);
        let mut one_leaf = [f64::NAN; WIDTH];
        one_leaf[0] = 0.0;
        let keys = |node: &Node| {
            let has_items = node.first & LAST != 0;
            if has_items { one_leaf } else { node.squared_distances(p) }
        };
        let visit = |leaf: usize| visit(leaf * WIDTH, &self.leaves[leaf].reach(p, 1.0 / self.unit));
        let fetch = |at: u32| {
            if at & LAST != 0 {
                self.leaves[(at & !LAST) as usize].fetch();
            } else {
                self.nodes[at as usize].fetch();
            }
        };
        self.visit(|| squared(limit.get()), keys, |node| node.first_or_leaf, fetch, visit);
    }

    /// Visits the items whose box a ray meets before `limit` of its parameter, which may be lowered
    /// meanwhile, roughly the first ones first. `slack` is the round-off of positions.
    pub(super) fn visit_along(
        &self,
        ray: &Ray,
        slack: f64,
        limit: &Cell<f64>,
        visit: impl FnMut(usize),
    ) {
        let slack = slack / self.unit;
        let keys = |node: &Node| node.entries(ray, slack, limit.get());
        self.visit(|| limit.get(), keys, |node| node.first, |_| (), visit);
    }

    /// Visits what is marked and has keys up to `most`, roughly ascending. `keys` are those of the children of
    /// a node, of which it has the `first` one; NaN for a child without interest.
    fn visit(
        &self,
        most: impl Fn() -> f64,
        keys: impl Fn(&Node) -> [f64; WIDTH],
        first: impl Fn(&Node) -> u32,
        fetch: impl Fn(u32),
        mut visit: impl FnMut(usize),
    ) {
        let mut open: Vec<(f64, u32)> = Vec::with_capacity(64);
        open.push((0.0, 0));
        while let Some((key, at)) = open.pop() {
            if key > most() {
                continue;
            }
            if at & LAST != 0 {
                visit((at & !LAST) as usize);
                continue;
            }
            let node = &self.nodes[at as usize];
            let (all, start) = (keys(node), open.len());
            for (at, key) in (first(node)..).zip(&all[..node.count as usize]) {
                if *key <= most() {
                    open.push((*key, at));
                    fetch(at);
                    // the nearest one last, to be taken first
                    let mut k = open.len() - 1;
                    while k > start && open[k - 1].0 <= open[k].0 {
                        open.swap(k - 1, k);
                        k -= 1;
                    }
                }
            }
        }
    }
}

impl Node {
    const EMPTY: Self = Self {
        centre: DVec3::ZERO,
        axes: [DVec3::ZERO; 3],
        low: [[0.0; WIDTH]; 3],
        high: [[0.0; WIDTH]; 3],
        first: 0,
        first_or_leaf: 0,
        count: 0,
    };

    /// Without children yet; one axis is the mean normal of the items: boxes of smooth pieces are flat.
    fn oriented(items: &[Flat], scale: f64) -> Self {
        let normal: DVec3 = items.iter().map(Flat::area_normal).sum();
        let normal = normal.try_normalize().unwrap_or(DVec3::Z);
        let (x, y) = normal.any_orthonormal_pair();
        let centre = items.iter().map(Flat::centre).sum::<DVec3>() / items.len() as f64;
        Self { centre, axes: [normal, x, y].map(|axis| axis * scale), ..Self::EMPTY }
    }

    /// Reads a number of each cache line, so that several nodes are waited for together.
    #[inline]
    fn fetch(&self) {
        let boxes = self.low.iter().chain(&self.high).map(|all| all[0]);
        black_box((boxes.sum::<f32>(), self.centre.x, self.first));
    }

    /// Components along the axes.
    #[inline]
    fn along(&self, v: DVec3) -> [f64; 3] {
        let [a, b, c] = self.axes;
        [a.dot(v), b.dot(v), c.dot(v)]
    }

    /// Puts a box around these items.
    fn set_box(&mut self, k: usize, items: &[Flat], scale: f64) {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for item in items {
            let bulge = item.bounds.bulge * scale;
            for p in item.corners {
                let at = self.along(p - self.centre);
                for axis in 0..3 {
                    low[axis] = low[axis].min(at[axis] - bulge);
                    high[axis] = high[axis].max(at[axis] + bulge);
                }
            }
        }
        for axis in 0..3 {
            self.low[axis][k] = single(low[axis]).next_down();
            self.high[axis][k] = single(high[axis]).next_up();
        }
    }

    /// Squared distances of the boxes from `p`, in units of the boxes.
    fn squared_distances(&self, p: DVec3) -> [f64; WIDTH] {
        let at = self.along(p - self.centre);
        let mut squares = [0.0; WIDTH];
        for ((low, high), at) in self.low.iter().zip(&self.high).zip(at) {
            for k in 0..WIDTH {
                let (below, above) = (f64::from(low[k]) - at, at - f64::from(high[k]));
                let out = if below > above { below } else { above };
                let out = if out > 0.0 { out } else { 0.0 };
                squares[k] += out * out;
            }
        }
        squares
    }

    /// Parameters at which a ray enters the boxes; NaN for those it does not enter before `limit`.
    fn entries(&self, ray: &Ray, slack: f64, limit: f64) -> [f64; WIDTH] {
        let origin = self.along(ray.origin - self.centre);
        let direction = self.along(ray.direction);
        let (mut first, mut last) = ([0.0_f64; WIDTH], [limit; WIDTH]);
        for axis in 0..3 {
            let (o, d) = (origin[axis], direction[axis]);
            for k in 0..WIDTH {
                let low = f64::from(self.low[axis][k]) - slack - o;
                let high = f64::from(self.high[axis][k]) + slack - o;
                if d == 0.0 {
                    if low > 0.0 || high < 0.0 {
                        last[k] = f64::NEG_INFINITY;
                    }
                } else {
                    let (a, b) = (low / d, high / d);
                    first[k] = first[k].max(a.min(b));
                    last[k] = last[k].min(a.max(b));
                }
            }
        }
        for k in 0..WIDTH {
            // two roundings each
            let rounded = 4.0 * f64::EPSILON * first[k].abs().max(last[k].abs());
            if first[k] > last[k] + rounded {
                first[k] = f64::NAN;
            }
        }
        first
    }
}

/// Sorts items so that runs of `part` of them lie together in space.
fn sort_into_parts(items: &mut [Flat], part: usize) {
    if items.len() <= part {
        return;
    }
    let (low, high) = items
        .iter()
        .map(Flat::centre)
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |all, p| (all.0.min(p), all.1.max(p)));
    let axis = (high - low).max_position();
    let half = items.len().div_ceil(part) / 2 * part;
    items.select_nth_unstable_by(half, |a, b| {
        a.centre()[axis].total_cmp(&b.centre()[axis]).then(a.order().cmp(&b.order()))
    });
    let (left, right) = items.split_at_mut(half);
    sort_into_parts(left, part);
    sort_into_parts(right, part);
}

#[allow(clippy::cast_possible_truncation, reason = "rounding is what is wanted")]
fn single(x: f64) -> f32 {
    x as f32
}

fn number(index: usize) -> u32 {
    u32::try_from(index).expect("invariant: face counts fit 31 bits")
}
