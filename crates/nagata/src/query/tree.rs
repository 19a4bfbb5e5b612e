//! A hierarchy of boxes.

use super::piece::Aabb;

/// Most boxes in a leaf.
const LEAF: usize = 2;

/// A binary tree over numbered boxes. Each half holds as many boxes as the other: the depth is the
/// logarithm of their number, whatever they are.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// Numbers of the boxes, in the order of the leaves.
    order: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    aabb: Aabb,
    /// First box of a leaf, second child of an inner node; the first child is the next node.
    link: u32,
    /// Boxes in a leaf; zero for inner nodes.
    count: u32,
}

impl Tree {
    pub(super) fn new(boxes: &[Aabb]) -> Self {
        let mut order: Vec<u32> = (0..boxes.len()).map(number).collect();
        let mut nodes = Vec::with_capacity(2 * boxes.len());
        build(boxes, &mut order, 0, &mut nodes);
        Self { nodes, order }
    }

    pub(super) fn aabb(&self) -> Aabb {
        self.nodes[0].aabb
    }

    /// Visits the boxes whose key is not above a limit, roughly in ascending order. `key` is `None` for
    /// boxes without interest and not larger for a box than for those inside it; `visit` takes the
    /// number of a box and returns the new limit.
    pub(super) fn visit(
        &self,
        mut limit: f64,
        key: impl Fn(&Aabb, f64) -> Option<f64>,
        mut visit: impl FnMut(usize) -> f64,
    ) {
        let mut open: Vec<(f64, usize)> = Vec::with_capacity(64);
        open.extend(key(&self.nodes[0].aabb, limit).map(|k| (k, 0)));
        while let Some((k, at)) = open.pop() {
            if k > limit {
                continue;
            }
            let node = &self.nodes[at];
            if node.count > 0 {
                let first = node.link as usize;
                for &item in &self.order[first..first + node.count as usize] {
                    limit = visit(item as usize);
                }
                continue;
            }
            let [a, b] = [at + 1, node.link as usize]
                .map(|child| (key(&self.nodes[child].aabb, limit), child));
            let (near, far) = if a.0 <= b.0 { (a, b) } else { (b, a) };
            open.extend([far, near].into_iter().filter_map(|(k, child)| Some((k?, child))));
        }
    }
}

fn number(index: usize) -> u32 {
    u32::try_from(index).expect("invariant: face counts fit 31 bits")
}

/// Appends the nodes for these boxes; `first` is where they are in the whole order.
fn build(boxes: &[Aabb], order: &mut [u32], first: usize, nodes: &mut Vec<Node>) {
    let mut items = order.iter().map(|&i| boxes[i as usize]);
    let start = items.next().expect("invariant: a mesh has faces");
    let aabb = items.fold(start, |all, next| all.with(&next));
    let at = nodes.len();
    if order.len() <= LEAF {
        nodes.push(Node { aabb, link: number(first), count: number(order.len()) });
        return;
    }
    nodes.push(Node { aabb, link: 0, count: 0 });
    let centre = |i: u32| boxes[i as usize].low + boxes[i as usize].high;
    let spread = Aabb::around(order.iter().map(|&i| centre(i)));
    let extent = spread.high - spread.low;
    let axis = if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    };
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&i, &j| {
        centre(i)[axis].total_cmp(&centre(j)[axis]).then(i.cmp(&j))
    });
    let (left, right) = order.split_at_mut(half);
    build(boxes, left, first, nodes);
    nodes[at].link = number(nodes.len());
    build(boxes, right, first + half, nodes);
}
