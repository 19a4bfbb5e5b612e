//! Sets of nodes of a block as bits of one word.

/// Cells of a block along each axis.
pub(super) const CELLS: u32 = 4;
/// Nodes of a block along each axis.
const NODES: u32 = CELLS + 1;
/// Nodes of a block.
pub(super) const NODE_COUNT: usize = (NODES * NODES * NODES) as usize;

/// Distance in bits between neighbours along each axis: node (x, y, z) is bit x + 5 y + 25 z.
pub(super) const STRIDES: [u32; 3] = [1, NODES, NODES * NODES];

/// The bit of a node.
#[inline]
pub(super) fn bit(node: [u32; 3]) -> u32 {
    node[0] + STRIDES[1] * node[1] + STRIDES[2] * node[2]
}

/// The nodes with indices below `counts`.
#[inline]
pub(super) fn corner_box(counts: [u32; 3]) -> u128 {
    let row = (1_u128 << counts[0]) - 1;
    let plane = (0..counts[1]).fold(0, |plane, y| plane | row << (STRIDES[1] * y));
    (0..counts[2]).fold(0, |nodes, z| nodes | plane << (STRIDES[2] * z))
}

/// The nodes of a set in the order of their bits: x fastest, z slowest.
#[inline]
pub(super) fn members(mut nodes: u128) -> impl Iterator<Item = [u32; 3]> {
    std::iter::from_fn(move || {
        let bit = (nodes != 0).then(|| nodes.trailing_zeros())?;
        nodes &= nodes - 1;
        Some([bit % NODES, bit / STRIDES[1] % NODES, bit / STRIDES[2]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_the_nodes_of_a_box_in_order() {
        let found: Vec<[u32; 3]> = members(corner_box([2, 3, 1])).collect();
        assert_eq!(found, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 2, 0], [1, 2, 0]]);
        let all = corner_box([NODES; 3]);
        assert_eq!(all.count_ones() as usize, NODE_COUNT);
        assert!(members(all).map(bit).eq(0..125), "every bit has its node");
    }
}
