//! The contour loops of a cell, from the signs of its eight corners.
//!
//! Corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1), and bit c of a configuration tells that the
//! corner is inside. Edge 4 a + k is parallel to axis a; k numbers its lower end among the corners
//! with coordinate 0 along a.

/// The lower ends of the edges parallel to each axis.
const LOWER_ENDS: [[u8; 4]; 3] = [[0, 2, 4, 6], [0, 1, 4, 5], [0, 1, 2, 3]];

/// Axis of a cell edge.
pub(super) fn edge_axis(edge: u8) -> usize {
    usize::from(edge / 4)
}

/// The corner where a cell edge starts.
pub(super) fn lower_end(edge: u8) -> u8 {
    LOWER_ENDS[edge_axis(edge)][usize::from(edge % 4)]
}

/// The edge between two corners that differ in one coordinate.
fn edge_between(a: u8, b: u8) -> u8 {
    (0..12)
        .find(|&edge| lower_end(edge) == a & b && 1 << edge_axis(edge) == a ^ b)
        .expect("invariant: the corners of a face are visited in cyclic order")
}

/// The six faces, each by its corners, counter-clockwise seen from outside the cell.
fn faces() -> [[u8; 4]; 6] {
    std::array::from_fn(|face| {
        let axis = face / 2;
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        if face % 2 == 0 {
            [0, v, u | v, u]
        } else {
            [0, u, u | v, v].map(|corner| corner | 1 << axis)
        }
    })
}

/// Whether two edges belong to one face.
pub(super) fn share_face(a: u8, b: u8) -> bool {
    let on_face = |edge: u8, axis: usize, side: u8| {
        edge_axis(edge) != axis && lower_end(edge) >> axis & 1 == side
    };
    (0..3).any(|axis| [0, 1].iter().any(|&s| on_face(a, axis, s) && on_face(b, axis, s)))
}

/// For each crossed edge the next one on its contour loop.
///
/// A face contributes one segment for each maximal run of inside corners on its boundary: from the
/// edge where the walk around the face enters the run to the edge where it leaves it. If two
/// opposite corners are inside they are therefore separated, and seen from outside the surface the
/// loops run counter-clockwise.
fn successors(configuration: u8) -> [Option<u8>; 12] {
    let inside = |corner: u8| configuration >> corner & 1 == 1;
    let mut next = [None; 12];
    for corners in faces() {
        for i in 0..4 {
            let at = |k: usize| corners[(i + k) % 4];
            if inside(at(0)) || !inside(at(1)) {
                continue;
            }
            let run = (1..4).take_while(|&k| inside(at(k))).count();
            let entry = edge_between(at(0), at(1));
            next[usize::from(entry)] = Some(edge_between(at(run), at(run + 1)));
        }
    }
    next
}

/// The contour loops of a configuration: edges in counter-clockwise order seen from outside.
pub(super) fn loops(configuration: u8) -> Vec<Vec<u8>> {
    let next = successors(configuration);
    let mut used = [false; 12];
    let mut loops = Vec::new();
    for first in 0..12 {
        let mut contour = Vec::new();
        let mut edge = first;
        while let Some(following) = next[usize::from(edge)].filter(|_| !used[usize::from(edge)]) {
            used[usize::from(edge)] = true;
            contour.push(edge);
            edge = following;
        }
        if !contour.is_empty() {
            loops.push(contour);
        }
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crossed_edge_is_on_one_loop() {
        for configuration in 0..=255_u8 {
            let inside = |corner: u8| configuration >> corner & 1;
            let crossed: Vec<u8> = (0..12)
                .filter(|&edge| {
                    let start = lower_end(edge);
                    inside(start) != inside(start | 1 << edge_axis(edge))
                })
                .collect();
            let mut found: Vec<u8> = loops(configuration).concat();
            found.sort_unstable();
            assert_eq!(found, crossed, "configuration {configuration:08b}");
        }
    }

    #[test]
    fn one_corner_is_cut_off_counter_clockwise() {
        // edges 0, 4, 8 leave corner 0 along x, y, z; seen from (1, 1, 1) they are ordered so
        assert_eq!(loops(0b0000_0001), [[0, 4, 8]]);
        assert_eq!(loops(0b1111_1110), [[0, 8, 4]]);
    }

    #[test]
    fn opposite_inside_corners_of_a_face_are_separated() {
        assert_eq!(loops(0b0000_1001).len(), 2);
        assert_eq!(loops(0b1111_0110).len(), 1);
    }

    #[test]
    fn consecutive_edges_share_a_face() {
        for contour in (0..=255).flat_map(loops) {
            assert!(contour.len() >= 3, "loop {contour:?}");
            for (i, &edge) in contour.iter().enumerate() {
                assert!(share_face(edge, contour[(i + 1) % contour.len()]), "loop {contour:?}");
            }
        }
    }
}
