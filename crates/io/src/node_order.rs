//! The order in which VTK and Gmsh store the nodes of a triangle.
//!
//! Corners first, then the inner nodes of the edges 0-1, 1-2, 2-0 in that direction, then the
//! interior as a triangle of three degrees less, in the same order. Degree 4:
//!
//! ```text
//!  our rank            file position
//!      0                     0
//!     1 2                   3 11
//!    3 4 5                 4 12 10
//!   6 7 8 9               5 13 14  9
//!  a b c d e             1  6  7  8  2
//! ```
//!
//! VTK uses it for `VTK_BEZIER_TRIANGLE` and `VTK_LAGRANGE_TRIANGLE`, Gmsh for its high-order
//! triangles.

use bezier_core::{Corner, LocalEdge, MultiIndex};

/// The [rank](MultiIndex::rank) of each node of a triangle of this degree, in file order.
///
/// A permutation of `0..MultiIndex::count(degree)`.
#[must_use]
pub fn node_order(degree: usize) -> Vec<usize> {
    let mut order = Vec::with_capacity(MultiIndex::count(degree));
    // `inset` layers of nodes lie between the outer boundary and this one
    for (inset, layer_degree) in (0..=degree).rev().step_by(3).enumerate() {
        let mut push = |edge: LocalEdge, step: usize| {
            let (start, end) = (inset + layer_degree - step, inset + step);
            order.push(MultiIndex::along(edge, start, end, inset).rank());
        };
        if layer_degree == 0 {
            push(LocalEdge::starting_at(Corner::First), 0);
            continue;
        }
        for edge in LocalEdge::ALL {
            push(edge, 0);
        }
        for edge in LocalEdge::ALL {
            (1..layer_degree).for_each(|step| push(edge, step));
        }
    }
    order
}

/// The rank of each node of a quadrilateral of this degree in the order of Gmsh; ranks count rows of
/// `degree + 1` nodes from the first side to the opposite one.
///
/// Corners first, then the inner nodes of the sides 0-1, 1-2, 2-3, 3-0 in that direction, then the
/// interior as a quadrilateral of two degrees less, in the same order. (VTK's order is another one.)
#[must_use]
pub fn quad_node_order(degree: usize) -> Vec<usize> {
    let mut order = Vec::with_capacity((degree + 1) * (degree + 1));
    for (inset, side) in (0..=degree).rev().step_by(2).enumerate() {
        let mut push = |i: usize, j: usize| order.push((inset + j) * (degree + 1) + inset + i);
        if side == 0 {
            push(0, 0);
            continue;
        }
        for (i, j) in [(0, 0), (side, 0), (side, side), (0, side)] {
            push(i, j);
        }
        (1..side).for_each(|step| push(step, 0));
        (1..side).for_each(|step| push(side, step));
        (1..side).for_each(|step| push(side - step, side));
        (1..side).for_each(|step| push(0, side - step));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exponents(degree: usize) -> Vec<[usize; 3]> {
        node_order(degree)
            .into_iter()
            .map(|rank| MultiIndex::at_rank(degree, rank))
            .map(|m| [m.i, m.j, m.k])
            .collect()
    }

    #[test]
    fn degree_three() {
        #[rustfmt::skip]
        let expected = [
            [3, 0, 0], [0, 3, 0], [0, 0, 3],
            [2, 1, 0], [1, 2, 0], [0, 2, 1], [0, 1, 2], [1, 0, 2], [2, 0, 1],
            [1, 1, 1],
        ];
        assert_eq!(exponents(3), expected);
        assert_eq!(node_order(3), [0, 6, 9, 1, 3, 7, 8, 5, 2, 4]);
    }

    #[test]
    fn degree_seven() {
        #[rustfmt::skip]
        let expected = [
            [7, 0, 0], [0, 7, 0], [0, 0, 7],
            [6, 1, 0], [5, 2, 0], [4, 3, 0], [3, 4, 0], [2, 5, 0], [1, 6, 0],
            [0, 6, 1], [0, 5, 2], [0, 4, 3], [0, 3, 4], [0, 2, 5], [0, 1, 6],
            [1, 0, 6], [2, 0, 5], [3, 0, 4], [4, 0, 3], [5, 0, 2], [6, 0, 1],
            [5, 1, 1], [1, 5, 1], [1, 1, 5],
            [4, 2, 1], [3, 3, 1], [2, 4, 1],
            [1, 4, 2], [1, 3, 3], [1, 2, 4],
            [2, 1, 4], [3, 1, 3], [4, 1, 2],
            [3, 2, 2], [2, 3, 2], [2, 2, 3],
        ];
        assert_eq!(exponents(7), expected);
    }

    #[test]
    fn a_permutation_at_every_degree() {
        for degree in 0..=20 {
            let mut order = node_order(degree);
            order.sort_unstable();
            assert!(order.into_iter().eq(0..MultiIndex::count(degree)), "degree {degree}");
        }
    }

    #[test]
    fn quads() {
        assert_eq!(quad_node_order(2), [0, 2, 8, 6, 1, 5, 7, 3, 4]);
        let third = [0, 3, 15, 12, 1, 2, 7, 11, 14, 13, 8, 4, 5, 6, 10, 9];
        assert_eq!(quad_node_order(3), third);
        for degree in 0..=10 {
            let mut order = quad_node_order(degree);
            order.sort_unstable();
            assert!(order.into_iter().eq(0..(degree + 1) * (degree + 1)), "degree {degree}");
        }
    }

    #[test]
    fn the_drawing() {
        let mut position = vec![0; 15];
        for (at, rank) in node_order(4).into_iter().enumerate() {
            position[rank] = at;
        }
        assert_eq!(position, [0, 3, 11, 4, 12, 10, 5, 13, 14, 9, 1, 6, 7, 8, 2]);
    }
}
