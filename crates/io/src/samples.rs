//! Surfaces of curved triangles and quadrilaterals, sampled without cracks and with sharp creases.

use bezier_core::Barycentric;
use glam::DVec3;

use crate::curved_mesh::CurvedMesh;
use crate::obj::Polygons;
use crate::patterns::Pattern;
use crate::shared_points::SharedPoints;
use crate::vtu::{Grid, GridCell};

/// A point of a face by its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FacePoint {
    /// On a triangle.
    Triangle(Barycentric),
    /// On a quadrilateral: 0 to 1 from its first corner to its second, and to its last one.
    Quad([f64; 2]),
}

/// A triangle mesh with a normal at each corner of each triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CreasedTessellation {
    /// Points on the surface, each once. The first ones are the vertices of the mesh, by id.
    pub positions: Vec<DVec3>,
    /// Unit normals; zero where the surface has none.
    pub normals: Vec<DVec3>,
    /// Points of each triangle, counter-clockwise seen from outside, in face order.
    pub triangles: Vec<[usize; 3]>,
    /// Normals at the corners of each triangle.
    pub triangle_normals: Vec<[usize; 3]>,
}

/// Points and normals of a surface at a regular lattice on each face.
#[derive(Debug)]
pub struct Samples {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// The position and the normal of each lattice point of each face, faces one after the other.
    ids: Vec<[usize; 2]>,
    is_quad: Vec<bool>,
    /// Of triangles and of quadrilaterals.
    patterns: [Pattern; 2],
}

impl Samples {
    /// Samples a surface over a mesh with `divisions` steps along each edge.
    ///
    /// `evaluate` returns the position and unit normal (or zero) of a point of a face. Vertices keep
    /// the positions of the mesh; a point inside an edge is taken from the first face at the edge,
    /// so neighbours use the same bits. Faces whose corners have the same normal (by index) at a
    /// vertex, or at both ends of an edge, share the normals of the samples there: the normalised
    /// sum of those of the faces. Values of normals in `mesh` are not used.
    ///
    /// # Panics
    ///
    /// If `divisions` is zero, or an index of the mesh does not exist.
    #[must_use]
    pub fn new(
        mesh: &Polygons,
        divisions: usize,
        mut evaluate: impl FnMut(usize, FacePoint) -> (DVec3, DVec3),
    ) -> Self {
        assert!(divisions >= 1, "a lattice needs at least one division");
        assert_eq!(mesh.faces.len(), mesh.corner_normals.len(), "normals for each face");
        let patterns = [Pattern::triangle(divisions), Pattern::quad(divisions)];
        let is_quad: Vec<_> = mesh.faces.iter().map(|face| face.corners().len() == 4).collect();
        let mut shared = SharedPoints::new(mesh, divisions);
        let mut ids = Vec::new();
        for (face, &is_quad) in is_quad.iter().enumerate() {
            for &(site, at) in &patterns[usize::from(is_quad)].points {
                ids.push(shared.add(face, site, evaluate(face, at)));
            }
        }
        let SharedPoints { positions, mut normals, .. } = shared;
        normals.iter_mut().for_each(|normal| *normal = normal.normalize_or_zero());
        Self { positions, normals, ids, is_quad, patterns }
    }

    /// The lattice on triangles and on quadrilaterals.
    pub(crate) fn patterns(&self) -> &[Pattern; 2] {
        &self.patterns
    }

    pub(crate) fn is_quad(&self, face: usize) -> bool {
        self.is_quad[face]
    }

    /// The position of a sample, by its ids.
    pub(crate) fn position(&self, [id, _]: [usize; 2]) -> DVec3 {
        self.positions[id]
    }

    /// The lattice points of each face, by their ranks: ids of position and normal.
    pub(crate) fn faces(&self) -> impl Iterator<Item = (&Pattern, &[[usize; 2]])> {
        let mut rest = &*self.ids;
        self.is_quad.iter().map(move |&is_quad| {
            let pattern = &self.patterns[usize::from(is_quad)];
            let (ids, following) = rest.split_at(pattern.points.len());
            rest = following;
            (pattern, ids)
        })
    }

    /// Flat triangles: `divisions²` for each triangle, twice as many for each quadrilateral.
    #[must_use]
    pub fn tessellation(&self) -> CreasedTessellation {
        let mut result = CreasedTessellation {
            positions: self.positions.clone(),
            normals: self.normals.clone(),
            ..CreasedTessellation::default()
        };
        for (pattern, ids) in self.faces() {
            for &corners in &pattern.triangles {
                result.triangles.push(corners.map(|rank| ids[rank][0]));
                result.triangle_normals.push(corners.map(|rank| ids[rank][1]));
            }
        }
        result
    }

    /// The same triangles as a grid over shared points, and how many cells each face has.
    #[must_use]
    pub fn flat_grid(&self) -> (Grid, Vec<usize>) {
        let cells =
            |pattern: &Pattern| pattern.triangles.iter().map(|&t| GridCell::Triangle(t)).collect();
        self.grid(self.patterns.each_ref().map(cells))
    }

    /// Quadratic triangles and quadrilaterals through the samples, two steps along each side, as a
    /// grid over shared points; and how many cells each face has.
    ///
    /// # Panics
    ///
    /// If the number of divisions is odd.
    #[must_use]
    pub fn quadratic_grid(&self) -> (Grid, Vec<usize>) {
        let [triangle, quad] = &self.patterns;
        let triangles = triangle.quadratic_triangles().into_iter();
        let quads = quad.quadratic_quads().into_iter();
        self.grid([
            triangles.map(GridCell::QuadraticTriangle).collect(),
            quads.map(GridCell::QuadraticQuad).collect(),
        ])
    }

    /// One curved element for each face, through all its samples: the order is the number of
    /// divisions.
    #[must_use]
    pub fn curved_mesh(&self) -> CurvedMesh {
        let mut mesh = CurvedMesh {
            order: self.patterns[0].divisions(),
            points: self.positions.clone(),
            ..CurvedMesh::default()
        };
        for ((_, ids), &is_quad) in self.faces().zip(&self.is_quad) {
            let nodes = if is_quad { &mut mesh.quads } else { &mut mesh.triangles };
            nodes.extend(ids.iter().map(|&[point, _]| point));
        }
        mesh
    }

    /// A grid with these cells on each triangle and on each quadrilateral, by ranks.
    ///
    /// Points that no cell uses are left out; the others keep their order. A point with several
    /// normals gets none.
    fn grid(&self, patterns: [Vec<GridCell>; 2]) -> (Grid, Vec<usize>) {
        let mut cells = Vec::new();
        let mut counts = Vec::with_capacity(self.is_quad.len());
        let mut normals = vec![PointNormal::Unused; self.positions.len()];
        for ((_, ids), &is_quad) in self.faces().zip(&self.is_quad) {
            let pattern = &patterns[usize::from(is_quad)];
            counts.push(pattern.len());
            for cell in pattern {
                cells.push(cell.map(|rank| {
                    let [point, normal] = ids[rank];
                    normals[point] = normals[point].and(normal);
                    point
                }));
            }
        }
        let mut new_ids = vec![usize::MAX; self.positions.len()];
        let mut grid = Grid::default();
        for (point, normal) in normals.into_iter().enumerate() {
            let normal = match normal {
                PointNormal::Unused => continue,
                PointNormal::One(id) => self.normals[id],
                PointNormal::Several => DVec3::ZERO,
            };
            new_ids[point] = grid.points.len();
            grid.points.push(self.positions[point]);
            grid.normals.push(normal);
        }
        grid.cells = cells.into_iter().map(|cell| cell.map(|point| new_ids[point])).collect();
        (grid, counts)
    }
}

/// What is known of the normal at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum PointNormal {
    Unused,
    One(usize),
    Several,
}

impl PointNormal {
    fn and(self, id: usize) -> Self {
        match self {
            Self::Unused => Self::One(id),
            Self::One(other) if other == id => self,
            _ => Self::Several,
        }
    }
}
