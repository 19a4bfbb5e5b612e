//! The triangles of a cell for each of the 256 sign configurations.

use std::sync::LazyLock;

use super::contour::{edge_axis, loops, lower_end, share_face};

/// How a cell with a certain configuration is filled.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// The crossed edges.
    pub(super) edges: Vec<u8>,
    /// Triangles between the crossings of three edges.
    pub(super) triangles: Vec<[u8; 3]>,
}

/// The table, by configuration; computed once.
pub(super) static CASES: LazyLock<Vec<Case>> =
    LazyLock::new(|| (0..=u8::MAX).map(Case::new).collect());

impl Case {
    fn new(configuration: u8) -> Self {
        let loops = loops(configuration);
        let triangles = loops.iter().flat_map(|contour| triangulate(contour)).collect();
        Self { edges: loops.concat(), triangles }
    }
}

/// Cost of the polygon between two points of a loop and the third corner of the triangle on the
/// side between them; `None` if it cannot be triangulated.
type Best = Option<(u32, usize)>;

/// Triangles of a loop without a diagonal between two points of one face.
///
/// Among all such triangulations the one with the smallest sum of squared diagonals between edge
/// midpoints is taken, by dynamic programming over the intervals of the loop.
fn triangulate(contour: &[u8]) -> Vec<[u8; 3]> {
    let n = contour.len();
    let mut best: Vec<Vec<Best>> = vec![vec![Some((0, 0)); n]; n];
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            let closing = length == n - 1;
            let side = if closing { Some(0) } else { diagonal_cost(contour[i], contour[j]) };
            let corner = |k: usize| Some((best[i][k]?.0 + best[k][j]?.0 + side?, k));
            best[i][j] = (i + 1..j).filter_map(corner).min();
        }
    }
    let mut triangles = Vec::with_capacity(n - 2);
    let mut open = vec![(0, n - 1)];
    while let Some((i, j)) = open.pop() {
        if j - i >= 2 {
            let (_, k) = best[i][j].expect("invariant: no loop of the 256 cases needs more points");
            triangles.push([contour[i], contour[k], contour[j]]);
            open.extend([(i, k), (k, j)]);
        }
    }
    triangles
}

/// Squared distance of two edge midpoints in half cells; `None` if the diagonal is not allowed.
fn diagonal_cost(a: u8, b: u8) -> Option<u32> {
    let midpoint = |edge: u8| -> [u8; 3] {
        std::array::from_fn(|axis| {
            if axis == edge_axis(edge) { 1 } else { 2 * (lower_end(edge) >> axis & 1) }
        })
    };
    let (a_mid, b_mid) = (midpoint(a), midpoint(b));
    let squared = (0..3).map(|axis| u32::from(a_mid[axis].abs_diff(b_mid[axis])).pow(2)).sum();
    (!share_face(a, b)).then_some(squared)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directed edges of the triangles.
    fn sides(case: &Case) -> Vec<(u8, u8)> {
        case.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect()
    }

    #[test]
    fn triangles_of_a_loop_are_bounded_by_it() {
        for (configuration, case) in (0..=255).zip(CASES.iter()) {
            let sides = sides(case);
            let mut boundary: Vec<_> =
                sides.iter().filter(|&&(a, b)| !sides.contains(&(b, a))).copied().collect();
            let mut expected: Vec<_> = loops(configuration)
                .into_iter()
                .flat_map(|l| (0..l.len()).map(move |i| (l[i], l[(i + 1) % l.len()])))
                .collect();
            boundary.sort_unstable();
            expected.sort_unstable();
            assert_eq!(boundary, expected, "configuration {configuration:08b}");
        }
    }

    #[test]
    fn inner_sides_join_no_two_points_of_one_face() {
        for case in CASES.iter() {
            let sides = sides(case);
            for &(a, b) in sides.iter().filter(|&&(a, b)| sides.contains(&(b, a))) {
                assert!(!share_face(a, b), "side {a}-{b} of {case:?}");
            }
        }
    }
}
