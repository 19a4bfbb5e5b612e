//! Whether the tetrahedra of a hull fit together. Always run: no construction rule guarantees it.

use glam::DVec3;

use super::hull::{Cell, Hull};
use super::skeleton::TriangleOrigin;
use crate::hierarchy::Hierarchy;
use crate::rational::Side;

/// What is wrong with a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Finding {
    /// The triangulation has another Euler characteristic than the solid.
    Characteristic {
        /// Of the triangulation.
        triangulation: i64,
        /// Of the solid.
        solid: i64,
    },
    /// An edge is convex to one side at one end and to the other at the other end.
    IllegalEdge {
        /// Ends of the edge, points of the hull.
        ends: [usize; 2],
        /// What the triangle on its left rounds off.
        at: TriangleOrigin,
    },
    /// A triangle needs an apex on a side where its place in the solid offers none.
    MissingApex {
        /// What the triangle rounds off.
        at: TriangleOrigin,
        /// The side.
        side: Side,
    },
    /// The planes of two triangles leave no room for the tetrahedra over their edge.
    NoSplit {
        /// What the triangles round off.
        at: [TriangleOrigin; 2],
        /// The side.
        side: Side,
    },
    /// A tetrahedron reaches through a tangent plane at one of its corners.
    OutsideTangent {
        /// What the triangle rounds off.
        at: TriangleOrigin,
        /// How far, in sizes of the solid.
        depth: f64,
    },
    /// The tetrahedra around an edge are not in order.
    Wedge {
        /// What the triangles round off.
        at: [TriangleOrigin; 2],
        /// The side.
        side: Side,
        /// The least of the four angles in radians.
        angle: f64,
    },
    /// An apex is not over its triangle.
    LowApex {
        /// What the triangle rounds off.
        at: TriangleOrigin,
        /// Height in sizes of the solid.
        height: f64,
    },
    /// Two tetrahedra overlap.
    Overlap {
        /// What their triangles round off.
        at: [TriangleOrigin; 2],
        /// Least width of the overlap in sizes of the solid.
        width: f64,
    },
}

/// The smallest margins of a hull, in units that do not depend on its size.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Margins {
    /// Least height of an upper point over the tangent planes at the corners below it.
    pub tangent: f64,
    /// Least height of an apex over its triangle.
    pub apex: f64,
    /// Least last coordinate of a split point: its height over a triangle over that of the apex.
    pub split: f64,
    /// Least measure of how far two neighbouring triangles are from one plane: the volume that their
    /// edges span at their common edge over the product of the lengths.
    pub coplanarity: f64,
}

/// Depths below this count as round-off or as the tolerance of planar faces, in sizes of the solid.
const TOUCH: f64 = 1e-6;
/// Overlaps below this count as common sides.
const OVERLAP: f64 = 1e-9;

/// All that is wrong, and the margins.
pub(crate) fn check(hull: &Hull, characteristic: i64, size: f64) -> (Vec<Finding>, Margins) {
    let mut findings = Vec::new();
    if hull.euler_characteristic != characteristic {
        let (triangulation, solid) = (hull.euler_characteristic, characteristic);
        findings.push(Finding::Characteristic { triangulation, solid });
    }
    let origin = |t: usize| hull.triangles[t].origin;
    let of_edge = |e: usize| hull.edges[e].triangles.map(origin);
    findings.extend(hull.illegal.iter().map(|&e| Finding::IllegalEdge {
        ends: hull.edges[e].ends,
        at: origin(hull.edges[e].triangles[0]),
    }));
    let missing = |&(t, side): &(usize, Side)| Finding::MissingApex { at: origin(t), side };
    findings.extend(hull.missing.iter().map(missing));
    let narrow = |&(e, side): &(usize, Side)| Finding::NoSplit { at: of_edge(e), side };
    findings.extend(hull.narrow.iter().map(narrow));
    let mut margins = Margins {
        tangent: f64::INFINITY,
        apex: f64::INFINITY,
        split: f64::INFINITY,
        coplanarity: coplanarity(hull),
    };
    for &cell in &hull.cells {
        let tangent = tangent(hull, cell) / size;
        margins.tangent = margins.tangent.min(tangent);
        if tangent.is_nan() || tangent < -TOUCH {
            let at = origin(triangle_of(hull, cell));
            findings.push(Finding::OutsideTangent { at, depth: -tangent });
        }
        if let Cell::Face(t, side) = cell {
            let apex = hull.points[hull.corners(cell)[3]];
            let height = side.sign() * hull.height(t, apex) / size;
            margins.apex = margins.apex.min(height);
            if height.is_nan() || height <= TOUCH {
                findings.push(Finding::LowApex { at: origin(t), height });
            }
        }
    }
    for (e, edge) in hull.edges.iter().enumerate() {
        for side in Side::BOTH {
            let Some(split) = &edge.splits[side.index()] else { continue };
            let least = split.coordinates[0][3].min(split.coordinates[1][3]);
            margins.split = margins.split.min(least);
            let angle = wedge(hull, e, side);
            // also true for numbers that are not finite
            if !(angle > OVERLAP && least > OVERLAP) {
                findings.push(Finding::Wedge { at: of_edge(e), side, angle });
            }
        }
    }
    findings.extend(overlaps(hull, size));
    (findings, margins)
}

fn triangle_of(hull: &Hull, cell: Cell) -> usize {
    match cell {
        Cell::Face(t, _) => t,
        Cell::Edge(e, _, which) => hull.edges[e].triangles[which],
    }
}

/// Least height of the upper corners of a cell over the tangent planes at its lower ones.
fn tangent(hull: &Hull, cell: Cell) -> f64 {
    let corners = hull.corners(cell);
    let (lower, upper) = corners.split_at(cell.base());
    let height = |p: usize, q: usize| {
        cell.side().sign() * (hull.points[q] - hull.points[p]).dot(hull.normals[p])
    };
    let heights = lower.iter().flat_map(|&p| upper.iter().map(move |&q| height(p, q)));
    heights.fold(f64::INFINITY, f64::min)
}

/// The least of the angles around an edge from one triangle over both tetrahedra to the other.
fn wedge(hull: &Hull, e: usize, side: Side) -> f64 {
    let edge = &hull.edges[e];
    let [first, second] =
        [0, 1].map(|which| hull.corners(Cell::Edge(e, side, which)).map(|p| hull.points[p]));
    let [a, b, s, q] = first;
    let around = [edge.opposite[0], edge.opposite[1]].map(|p| hull.points[p]);
    let axis = (b - a).normalize_or_zero() * side.sign();
    let fan = [around[0], q, s, second[3], around[1]].map(|p| (p - a).reject_from_normalized(axis));
    let angle = |u: DVec3, v: DVec3| axis.dot(u.cross(v)).atan2(u.dot(v));
    fan.windows(2).map(|pair| angle(pair[0], pair[1])).fold(f64::INFINITY, f64::min)
}

fn coplanarity(hull: &Hull) -> f64 {
    let measure = |e: &super::hull::HullEdge| {
        let [a, b] = e.ends.map(|p| hull.points[p]);
        let [p, q] = e.opposite.map(|p| hull.points[p]);
        let [u, v, w] = [b - a, p - a, q - a];
        u.cross(v).dot(w).abs() / (u.length() * v.length() * w.length())
    };
    let curved = hull.edges.iter().filter(|e| e.splits.iter().any(Option::is_some));
    curved.map(measure).fold(f64::INFINITY, f64::min)
}

/// Pairs of tetrahedra with common inner points.
fn overlaps(hull: &Hull, size: f64) -> Vec<Finding> {
    let tetrahedra: Vec<Prepared> =
        hull.cells.iter().map(|&cell| Prepared::new(hull.tetrahedron(cell).corners)).collect();
    let boxes: Vec<_> = tetrahedra.iter().map(|t| t.bounds).collect();
    let tree = Hierarchy::new(&boxes);
    let mut findings = Vec::new();
    let mut near = Vec::new();
    for (i, first) in tetrahedra.iter().enumerate() {
        near.clear();
        tree.in_box(first.bounds, |j| near.push(j));
        near.sort_unstable();
        for &j in near.iter().filter(|&&j| j > i) {
            if let Some(width) = first.overlap(&tetrahedra[j], OVERLAP * size) {
                let at = [i, j].map(|c| hull.triangles[triangle_of(hull, hull.cells[c])].origin);
                findings.push(Finding::Overlap { at, width: width / size });
            }
        }
    }
    findings
}

/// A tetrahedron with its bounds and the directions of its faces and edges.
struct Prepared {
    corners: [DVec3; 4],
    bounds: [DVec3; 2],
    normals: [DVec3; 4],
    edges: [DVec3; 6],
}

impl Prepared {
    fn new(corners: [DVec3; 4]) -> Self {
        let [a, b, c, d] = corners;
        let normal = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).normalize_or_zero();
        Self {
            corners,
            bounds: [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))],
            normals: [normal(a, b, c), normal(a, b, d), normal(a, c, d), normal(b, c, d)],
            edges: [b - a, c - a, d - a, c - b, d - b, d - c].map(DVec3::normalize_or_zero),
        }
    }

    /// Width of the overlap along a unit vector; not positive if it separates.
    fn width(&self, other: &Self, axis: DVec3) -> f64 {
        let range = |t: &Self| {
            let x = t.corners.map(|p| axis.dot(p - self.corners[0]));
            let fold = |f: fn(f64, f64) -> f64| f(f(x[0], x[1]), f(x[2], x[3]));
            (fold(f64::min), fold(f64::max))
        };
        let ((a, b), (c, d)) = (range(self), range(other));
        (b - c).min(d - a)
    }

    /// Least width of the overlap over all axes that could separate, if it is above `touch`.
    fn overlap(&self, other: &Self, touch: f64) -> Option<f64> {
        let mut least = f64::INFINITY;
        for axis in self.normals.into_iter().chain(other.normals) {
            least = least.min(self.width(other, axis));
            if least <= touch {
                return None;
            }
        }
        for u in self.edges {
            for v in other.edges {
                let cross = u.cross(v);
                let length = cross.length();
                // nearly parallel edges span no axis of their own
                if length > 1e-6 {
                    least = least.min(self.width(other, cross / length));
                    if least <= touch {
                        return None;
                    }
                }
            }
        }
        Some(least)
    }
}
