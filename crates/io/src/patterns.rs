//! The regular lattice on one face of three or four corners: where its points lie, and the cells
//! between them.
//!
//! Points of a triangle have the order of [`Barycentric::lattice`]; those of a quadrilateral form
//! rows from its first side to the opposite one.

use bezier_core::{Barycentric, MultiIndex};

use crate::lattice::{Site as TriangleSite, site_of};
use crate::samples::FacePoint;
use crate::tessellate::triangle_pattern;

/// Where a lattice point lies on its face.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Site {
    /// At this corner.
    Corner(usize),
    /// So many steps from the start of the side that starts at this corner.
    Side {
        side: usize,
        step: usize,
    },
    Inside,
}

/// The lattice on all faces with the same number of corners; cells name its points by their rank.
#[derive(Debug)]
pub(crate) struct Pattern {
    pub(crate) points: Vec<(Site, FacePoint)>,
    pub(crate) triangles: Vec<[usize; 3]>,
    divisions: usize,
}

impl Pattern {
    /// A lattice with this many steps along each side; at least one.
    pub(crate) fn triangle(divisions: usize) -> Self {
        let mut interior = 0;
        let site = |m| match site_of(m, &mut interior) {
            TriangleSite::Corner(corner) => Site::Corner(corner.index()),
            TriangleSite::Edge { edge, step } => Site::Side { side: edge.start().index(), step },
            TriangleSite::Interior(_) => Site::Inside,
        };
        let at = Barycentric::lattice(divisions).map(FacePoint::Triangle);
        let points = MultiIndex::all(divisions).map(site).zip(at).collect();
        Self { points, triangles: triangle_pattern(divisions), divisions }
    }

    /// A lattice with this many steps along each side; at least one.
    pub(crate) fn quad(divisions: usize) -> Self {
        let n = divisions;
        let rows = (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
        let at = |i, j| FacePoint::Quad([i, j].map(|step: usize| step as f64 / n as f64));
        let points = rows.map(|(i, j)| (site_in_quad(n, i, j), at(i, j))).collect();
        let squares = (0..n).flat_map(|j| (0..n).map(move |i| [0, 1].map(|d| j * (n + 1) + i + d)));
        let triangles = squares
            .flat_map(|[a, b]| {
                let [d, c] = [a, b].map(|rank| rank + n + 1);
                [[a, b, c], [a, c, d]]
            })
            .collect();
        Self { points, triangles, divisions }
    }

    /// The six points of each quadratic triangle on a triangle, two steps along each side.
    pub(crate) fn quadratic_triangles(&self) -> Vec<[usize; 6]> {
        const UPRIGHT: [[usize; 3]; 6] =
            [[2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 1, 0], [0, 1, 1], [1, 0, 1]];
        const INVERTED: [[usize; 3]; 6] =
            [[0, 2, 2], [2, 0, 2], [2, 2, 0], [1, 1, 2], [2, 1, 1], [1, 2, 1]];
        let half = self.half();
        let cell = |m: MultiIndex, nodes: [[usize; 3]; 6]| {
            nodes.map(|[i, j, k]| MultiIndex::new(2 * m.i + i, 2 * m.j + j, 2 * m.k + k).rank())
        };
        let mut cells: Vec<_> = MultiIndex::all(half - 1).map(|m| cell(m, UPRIGHT)).collect();
        if half >= 2 {
            cells.extend(MultiIndex::all(half - 2).map(|m| cell(m, INVERTED)));
        }
        cells
    }

    /// The eight points of each quadratic quadrilateral on a quadrilateral, two steps along each
    /// side.
    pub(crate) fn quadratic_quads(&self) -> Vec<[usize; 8]> {
        const NODES: [[usize; 2]; 8] =
            [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]];
        let half = self.half();
        let row = self.divisions + 1;
        let squares = (0..half).flat_map(|j| (0..half).map(move |i| [i, j]));
        squares.map(|[i, j]| NODES.map(|[di, dj]| (2 * j + dj) * row + 2 * i + di)).collect()
    }

    /// Steps along each side.
    pub(crate) fn divisions(&self) -> usize {
        self.divisions
    }

    fn half(&self) -> usize {
        assert!(self.divisions.is_multiple_of(2), "quadratic cells take two divisions each");
        self.divisions / 2
    }
}

fn site_in_quad(n: usize, i: usize, j: usize) -> Site {
    match (i, j) {
        (0, 0) => Site::Corner(0),
        _ if (i, j) == (n, 0) => Site::Corner(1),
        _ if (i, j) == (n, n) => Site::Corner(2),
        _ if (i, j) == (0, n) => Site::Corner(3),
        (_, 0) => Site::Side { side: 0, step: i },
        _ if i == n => Site::Side { side: 1, step: j },
        _ if j == n => Site::Side { side: 2, step: n - i },
        (0, _) => Site::Side { side: 3, step: n - j },
        _ => Site::Inside,
    }
}
