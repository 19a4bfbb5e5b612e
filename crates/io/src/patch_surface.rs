//! Polynomial patches over triangles and quadrilaterals that share their edge curves.

mod error;
mod shells;

use basemesh::{FaceMap, Topology};
use bezier_core::{BezierTriangle, MultiIndex};
use glam::DVec3;

use crate::polygon::Polygon;

pub use error::PatchSurfaceError;
pub(crate) use shells::{Shell, shells};

/// A surface of polynomial patches of one degree over a mesh of triangles and quadrilaterals.
///
/// Vertices and curves of edges are stored once; patches agree with them bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchSurface {
    degree: usize,
    vertices: Vec<DVec3>,
    faces: Vec<Polygon<usize>>,
    /// Sorted pairs of vertices.
    edges: Vec<[usize; 2]>,
    /// `degree + 1` control points for each edge, from its lower vertex.
    curves: Vec<DVec3>,
    /// The edge of each side of each face.
    sides: Vec<Polygon<usize>>,
    /// Control points of all faces one after the other.
    nets: Vec<DVec3>,
    /// Where the net of each face begins, and the end of the last one.
    starts: Vec<usize>,
}

/// One patch of a [`PatchSurface`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PatchNet<'a> {
    /// Control points in the order of [`MultiIndex::rank`].
    Triangle(&'a [DVec3]),
    /// Rows of `degree + 1` control points, from the first side to the opposite one.
    Quad(&'a [DVec3]),
}

impl PatchSurface {
    /// A surface of triangles.
    ///
    /// # Errors
    ///
    /// [`PatchSurfaceError`] if patches disagree about a shared point, or a point is not finite.
    ///
    /// # Panics
    ///
    /// If there is not one patch per face.
    pub fn from_triangles<const P: usize>(
        topology: &Topology,
        nets: &FaceMap<BezierTriangle<DVec3, P>>,
    ) -> Result<Self, PatchSurfaceError> {
        assert_eq!(nets.len(), topology.face_count(), "one patch per face");
        let corners = |face| topology.corners(face).map(basemesh::VertexId::index);
        let faces = topology.faces().map(|face| Polygon::triangle(corners(face))).collect();
        let points = nets.as_slice().iter().flat_map(|patch| *patch.net()).collect();
        Self::new(BezierTriangle::<DVec3, P>::DEGREE, faces, points)
    }

    /// A surface from the vertices and the control points of each face, in the orders of
    /// [`PatchNet`]; one face after the other.
    ///
    /// # Errors
    ///
    /// [`PatchSurfaceError`] if patches disagree about a shared point, or a point is not finite.
    ///
    /// # Panics
    ///
    /// If the degree is zero, a face names a vertex twice, or there are more or fewer control points
    /// than the faces need.
    pub fn new(
        degree: usize,
        faces: Vec<Polygon<usize>>,
        nets: Vec<DVec3>,
    ) -> Result<Self, PatchSurfaceError> {
        assert!(degree >= 1, "patches have edges");
        let mut starts = vec![0];
        let mut end = 0;
        for face in &faces {
            end += net_size(degree, face.corners().len());
            starts.push(end);
        }
        assert_eq!(nets.len(), end, "control points for each face");
        let (edges, sides) = edges(&faces);
        let vertex_count = faces.iter().flat_map(Polygon::corners).max().map_or(0, |last| last + 1);
        let mut surface = Self {
            degree,
            vertices: vec![DVec3::NAN; vertex_count],
            curves: vec![DVec3::NAN; edges.len() * (degree + 1)],
            faces,
            edges,
            sides,
            nets,
            starts,
        };
        surface.check_finite()?;
        surface.gather()?;
        Ok(surface)
    }

    /// Polynomial degree; of quadrilaterals in each direction.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Positions of the vertices; not finite for one that no face uses.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The diagonal of the bounding box of the vertices.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        let used = || self.vertices.iter().copied().filter(|vertex| vertex.is_finite());
        match (used().reduce(DVec3::min), used().reduce(DVec3::max)) {
            (Some(low), Some(high)) => low.distance(high),
            _ => 0.0,
        }
    }

    /// The vertices of each face.
    #[must_use]
    pub fn faces(&self) -> &[Polygon<usize>] {
        &self.faces
    }

    /// The vertices of each edge, the lower first; edges are sorted by them.
    #[must_use]
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// The edge of each side of a face; side `s` begins at corner `s`.
    #[must_use]
    pub fn sides(&self, face: usize) -> &[usize] {
        self.sides[face].corners()
    }

    /// Control points of an edge, from its lower vertex.
    #[must_use]
    pub fn curve(&self, edge: usize) -> &[DVec3] {
        let size = self.degree + 1;
        &self.curves[edge * size..(edge + 1) * size]
    }

    /// The patch of a face.
    #[must_use]
    pub fn net(&self, face: usize) -> PatchNet<'_> {
        let points = &self.nets[self.starts[face]..self.starts[face + 1]];
        if self.faces[face].corners().len() == 3 {
            PatchNet::Triangle(points)
        } else {
            PatchNet::Quad(points)
        }
    }

    /// Whether a side of a face runs from the lower vertex of its edge to the higher one.
    #[must_use]
    pub fn runs_forward(&self, face: usize, side: usize) -> bool {
        let corners = self.faces[face].corners();
        corners[side] < corners[(side + 1) % corners.len()]
    }

    fn check_finite(&self) -> Result<(), PatchSurfaceError> {
        let Some(at) = self.nets.iter().position(|point| !point.is_finite()) else { return Ok(()) };
        let face = self.starts.partition_point(|&start| start <= at) - 1;
        let point = at - self.starts[face];
        Err(PatchSurfaceError::NotFinite { face, point, position: self.nets[at] })
    }

    /// Takes what is shared from the lowest face, and compares the others with it: equal numbers, zeros of
    /// either sign.
    fn gather(&mut self) -> Result<(), PatchSurfaceError> {
        let size = self.degree + 1;
        let mut curve_owner = vec![None; self.edges.len()];
        let mut vertex_owner = vec![None; self.vertices.len()];
        for face in 0..self.faces.len() {
            for side in 0..self.faces[face].corners().len() {
                let row = self.boundary(face, side);
                let vertex = self.faces[face].corners()[side];
                let owner = *vertex_owner[vertex].get_or_insert(face);
                if owner == face {
                    self.vertices[vertex] = row.start;
                } else if self.vertices[vertex] != row.start {
                    let positions = [self.vertices[vertex], row.start];
                    return Err(PatchSurfaceError::Vertex {
                        vertex,
                        faces: [owner, face],
                        positions,
                    });
                }
                let edge = self.sides[face].corners()[side];
                let owner = *curve_owner[edge].get_or_insert(face);
                let curve = &mut self.curves[edge * size..(edge + 1) * size];
                if owner == face {
                    curve.copy_from_slice(&row.forward);
                } else if let Some(step) = (0..size).find(|&step| curve[step] != row.forward[step])
                {
                    let positions = [curve[step], row.forward[step]];
                    let [lower, higher] = self.edges[edge];
                    let faces = [owner, face];
                    return Err(PatchSurfaceError::Edge { lower, higher, step, faces, positions });
                }
            }
        }
        Ok(())
    }

    fn boundary(&self, face: usize, side: usize) -> BoundaryRow {
        let n = self.degree;
        let at = |step| match (self.net(face), side) {
            (PatchNet::Triangle(net), 0) => net[MultiIndex::new(n - step, step, 0).rank()],
            (PatchNet::Triangle(net), 1) => net[MultiIndex::new(0, n - step, step).rank()],
            (PatchNet::Triangle(net), _) => net[MultiIndex::new(step, 0, n - step).rank()],
            (PatchNet::Quad(net), 0) => net[step],
            (PatchNet::Quad(net), 1) => net[step * (n + 1) + n],
            (PatchNet::Quad(net), 2) => net[n * (n + 1) + n - step],
            (PatchNet::Quad(net), _) => net[(n - step) * (n + 1)],
        };
        let mut forward: Vec<_> = (0..=n).map(at).collect();
        let start = forward[0];
        if !self.runs_forward(face, side) {
            forward.reverse();
        }
        BoundaryRow { start, forward }
    }
}

/// Control points of a side.
struct BoundaryRow {
    /// The corner where the side begins.
    start: DVec3,
    /// From the lower vertex of the edge.
    forward: Vec<DVec3>,
}

fn net_size(degree: usize, corners: usize) -> usize {
    if corners == 3 { MultiIndex::count(degree) } else { (degree + 1) * (degree + 1) }
}

/// All edges, sorted, and the edge of each side of each face.
fn edges(faces: &[Polygon<usize>]) -> (Vec<[usize; 2]>, Vec<Polygon<usize>>) {
    let of_face = |face: &Polygon<usize>| -> Vec<[usize; 2]> {
        let corners = face.corners();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]).collect()
    };
    let mut edges: Vec<_> = faces.iter().flat_map(of_face).collect();
    edges.sort_unstable();
    edges.dedup();
    assert!(edges.iter().all(|[a, b]| a != b), "a face names a vertex twice");
    let sides = faces.iter().map(|face| {
        let ids: Vec<_> = of_face(face)
            .iter()
            .map(|side| edges.binary_search(side).expect("invariant: a side has an edge"))
            .collect();
        Polygon::new(&ids).expect("invariant: as many sides as corners")
    });
    let sides = sides.collect();
    (edges, sides)
}
