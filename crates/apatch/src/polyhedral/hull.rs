//! The simplicial hull: tetrahedra over the triangles and edges of the triangulation.

use basemesh::{EdgeId, EdgeMap, FaceId, TriMesh, VertexMap};
use glam::DVec3;

use super::error::HullError;
use super::skeleton::{PointOrigin, Skeleton, SkeletonTriangle, TriangleOrigin};
use crate::rational::{Convexity, Side};
use crate::tetrahedron::Tetrahedron;

/// The tetrahedra on one side of an edge: where they meet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Split {
    /// Weight of the second apex in the point between the apices.
    pub mu: f64,
    /// Number of that point among the points of the hull.
    pub point: usize,
    /// Barycentric coordinates of the point in the tetrahedra of both triangles: opposite corner,
    /// ends of the edge, apex.
    pub coordinates: [[f64; 4]; 2],
}

/// An edge of the triangulation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HullEdge {
    /// Its ends, the lower number first.
    pub ends: [usize; 2],
    /// The triangle that contains the edge in this direction, then the other one.
    pub triangles: [usize; 2],
    /// The third corners of the triangles.
    pub opposite: [usize; 2],
    /// To which side it is convex; straight edges lie in both tangent planes.
    pub convexity: Convexity,
    /// Its tetrahedra on the positive and negative side.
    pub splits: [Option<Split>; 2],
}

/// A triangle of the triangulation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HullTriangle {
    /// Its corners, counter-clockwise seen from outside.
    pub corners: [usize; 3],
    /// Its edges, that from the first to the second corner first.
    pub edges: [usize; 3],
    /// Number of its apex among the points of the hull, on the positive and negative side.
    pub apices: [Option<usize>; 2],
    /// What it rounds off.
    pub origin: TriangleOrigin,
}

/// A tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Cell {
    /// Over a triangle; corners: those of the triangle, the apex.
    Face(usize, Side),
    /// Over an edge, next to its first or second triangle; corners: the ends, the point between the
    /// apices, the apex.
    Edge(usize, Side, usize),
}

/// The tetrahedra around the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    /// Points of the triangulation, then apices, then points between apices.
    pub points: Vec<DVec3>,
    /// Unit normals at the points of the triangulation.
    pub normals: Vec<DVec3>,
    /// Where the points of the triangulation come from.
    pub origins: Vec<PointOrigin>,
    /// The triangles.
    pub triangles: Vec<HullTriangle>,
    /// The edges.
    pub edges: Vec<HullEdge>,
    /// All tetrahedra: over triangles, then over edges.
    pub cells: Vec<Cell>,
    /// Euler characteristic of the triangulation.
    pub euler_characteristic: i64,
    /// Edges that are convex to one side at one end and to the other at the other.
    pub(crate) illegal: Vec<usize>,
    /// Triangles and sides where an apex is needed but not offered.
    pub(crate) missing: Vec<(usize, Side)>,
    /// Edges and sides without a place for the point between the apices.
    pub(crate) narrow: Vec<(usize, Side)>,
}

/// Heights below this times the length count as zero: the edge is straight.
const STRAIGHT: f64 = 1e-9;

impl Hull {
    /// Over a triangulation, as of a file. Whether the tetrahedra fit together is not checked here:
    /// the report of a surface tells.
    ///
    /// # Errors
    ///
    /// [`HullError::Triangulation`]; [`HullError::Setting`] without one normal and origin a point.
    pub fn new(skeleton: Skeleton) -> Result<Self, HullError> {
        let count = skeleton.points.len();
        for (name, n) in [("normals", skeleton.normals.len()), ("origins", skeleton.origins.len())]
        {
            if n != count {
                let (value, expected) = (n as f64, "one for each point");
                return Err(HullError::Setting { name, value, expected });
            }
        }
        let faces: Vec<_> = skeleton.triangles.iter().map(|t| t.corners).collect();
        let mesh =
            TriMesh::new(skeleton.points.clone(), &faces).map_err(HullError::Triangulation)?;
        let topology = mesh.topology();
        let normals = VertexMap::from_vec(skeleton.normals.clone());
        let edges = EdgeMap::from_fn(topology.edge_count(), |e| edge(&mesh, &normals, e));
        let mut hull = Self {
            points: skeleton.points,
            normals: skeleton.normals,
            origins: skeleton.origins,
            triangles: Vec::new(),
            illegal: Vec::new(),
            edges: Vec::new(),
            cells: Vec::new(),
            euler_characteristic: topology.euler_characteristic(),
            missing: Vec::new(),
            narrow: Vec::new(),
        };
        for (id, (edge, legal)) in edges.iter() {
            hull.edges.push(*edge);
            if !legal {
                hull.illegal.push(id.index());
            }
        }
        for (face, facet) in skeleton.triangles.iter().enumerate() {
            let edges = FaceId::new(face).halfedges().map(|h| topology.edge(h).index());
            hull.add_triangle(facet.corners, edges, facet.apices, facet.origin);
        }
        (0..hull.edges.len()).for_each(|e| hull.add_split(e));
        Ok(hull)
    }

    fn add_triangle(
        &mut self,
        corners: [usize; 3],
        edges: [usize; 3],
        offered: [Option<DVec3>; 2],
        origin: TriangleOrigin,
    ) {
        let triangle = self.triangles.len();
        let mut apices = [None; 2];
        for side in Side::BOTH {
            if !edges.iter().any(|&e| self.edges[e].convexity.has(side)) {
                continue;
            }
            match offered[side.index()] {
                Some(apex) => {
                    apices[side.index()] = Some(self.points.len());
                    self.points.push(apex);
                    self.cells.push(Cell::Face(triangle, side));
                }
                None => self.missing.push((triangle, side)),
            }
        }
        self.triangles.push(HullTriangle { corners, edges, apices, origin });
    }

    /// The point between the apices, strictly over the planes of both triangles if possible.
    fn add_split(&mut self, index: usize) {
        let edge = self.edges[index];
        for side in Side::BOTH.into_iter().filter(|&s| edge.convexity.has(s)) {
            let apices = edge.triangles.map(|t| self.triangles[t].apices[side.index()]);
            let [Some(l), Some(n)] = apices else { continue };
            let (left, next) = (self.points[l], self.points[n]);
            let height = |i: usize, p: DVec3| side.sign() * self.height(edge.triangles[i], p);
            let (mut low, mut high) = (0.0_f64, 1.0_f64);
            if height(0, next) < 0.0 {
                high = height(0, left) / (height(0, left) - height(0, next));
            }
            if height(1, left) < 0.0 {
                low = -height(1, left) / (height(1, next) - height(1, left));
            }
            let middle = (0.5 - low) / (high - low);
            let mu = if middle > 0.2 && middle < 0.8 { 0.5 } else { 0.5 * (low + high) };
            // also true for numbers that are not finite
            if !(low < high && mu > 0.0 && mu < 1.0) {
                self.narrow.push((index, side));
                continue;
            }
            let point = self.points.len();
            let s = left * (1.0 - mu) + next * mu;
            let [a, b] = edge.ends.map(|p| self.points[p]);
            let coordinates = [(0, left), (1, next)].map(|(i, apex)| {
                let opposite = self.points[edge.opposite[i]];
                Tetrahedron::new([opposite, a, b, apex]).barycentric(s)
            });
            self.points.push(s);
            self.edges[index].splits[side.index()] = Some(Split { mu, point, coordinates });
            self.cells.extend([0, 1].map(|which| Cell::Edge(index, side, which)));
        }
    }

    /// Height of a point over the plane of a triangle.
    pub(crate) fn height(&self, triangle: usize, p: DVec3) -> f64 {
        let [a, b, c] = self.triangles[triangle].corners.map(|i| self.points[i]);
        (b - a).cross(c - a).normalize_or_zero().dot(p - a)
    }

    /// The triangulation, from which [`Hull::new`] makes the same hull again.
    #[must_use]
    pub fn skeleton(&self) -> Skeleton {
        let triangle = |t: &HullTriangle| SkeletonTriangle {
            corners: t.corners,
            apices: t.apices.map(|apex| apex.map(|p| self.points[p])),
            origin: t.origin,
        };
        Skeleton {
            points: self.points[..self.base_count()].to_vec(),
            normals: self.normals.clone(),
            origins: self.origins.clone(),
            triangles: self.triangles.iter().map(triangle).collect(),
        }
    }

    /// Number of points of the triangulation.
    #[must_use]
    pub fn base_count(&self) -> usize {
        self.normals.len()
    }

    /// Numbers of the corners of a tetrahedron.
    #[must_use]
    pub fn corners(&self, cell: Cell) -> [usize; 4] {
        let made = "invariant: cells have apices";
        match cell {
            Cell::Face(t, side) => {
                let HullTriangle { corners: [a, b, c], apices, .. } = self.triangles[t];
                [a, b, c, apices[side.index()].expect(made)]
            }
            Cell::Edge(e, side, which) => {
                let edge = &self.edges[e];
                let apex = self.triangles[edge.triangles[which]].apices[side.index()].expect(made);
                let split = edge.splits[side.index()].expect(made);
                [edge.ends[0], edge.ends[1], split.point, apex]
            }
        }
    }

    /// The tetrahedron of a cell.
    #[must_use]
    pub fn tetrahedron(&self, cell: Cell) -> Tetrahedron {
        Tetrahedron::new(self.corners(cell).map(|p| self.points[p]))
    }

    /// The side of an edge of a triangle on which it has tetrahedra; `None` if it is straight.
    #[must_use]
    pub fn edge_side(&self, edge: usize) -> Option<Side> {
        match self.edges[edge].convexity {
            Convexity::Positive => Some(Side::Positive),
            Convexity::Negative => Some(Side::Negative),
            Convexity::Nonconvex | Convexity::Zero => None,
        }
    }

    /// The same hull in another unit.
    pub(crate) fn scaled(mut self, factor: f64) -> Self {
        self.points.iter_mut().for_each(|p| *p *= factor);
        self
    }
}

impl Cell {
    /// Its side of the triangulation.
    #[must_use]
    pub const fn side(self) -> Side {
        match self {
            Self::Face(_, side) | Self::Edge(_, side, _) => side,
        }
    }

    /// Number of its corners on the triangulation: 3 over a triangle, 2 over an edge.
    #[must_use]
    pub const fn base(self) -> usize {
        match self {
            Self::Face(..) => 3,
            Self::Edge(..) => 2,
        }
    }
}

/// An edge without tetrahedra, and whether it is convex to one side only.
fn edge(mesh: &TriMesh, normals: &VertexMap<DVec3>, edge: EdgeId) -> (HullEdge, bool) {
    let topology = mesh.topology();
    let canonical = topology.canonical(edge);
    let twin = topology.twin(canonical).unwrap_or(canonical);
    let swap = topology.origin(canonical) > topology.target(canonical);
    let sides = if swap { [twin, canonical] } else { [canonical, twin] };
    let [a, b] = [topology.origin(sides[0]), topology.target(sides[0])];
    let along = mesh.position(b) - mesh.position(a);
    // how far each end lies over the tangent plane of the other
    let over = [along.dot(normals[a]), -along.dot(normals[b])].map(|u| u / along.length());
    let (above, below) = (over.map(|u| u > STRAIGHT), over.map(|u| u < -STRAIGHT));
    let [any_above, any_below] = [above, below].map(|s| s[0] || s[1]);
    let convexity = match (any_above, any_below) {
        (false, false) => Convexity::Zero,
        (false, true) => Convexity::Positive,
        (true, false) => Convexity::Negative,
        (true, true) => Convexity::Nonconvex,
    };
    let edge = HullEdge {
        ends: [a.index(), b.index()],
        triangles: sides.map(|h| h.face().index()),
        opposite: sides.map(|h| topology.origin(h.previous()).index()),
        convexity,
        splits: [None; 2],
    };
    (edge, convexity != Convexity::Nonconvex)
}
