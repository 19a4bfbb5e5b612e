//! The function anywhere in the hull, and rays against the surface.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

use super::base::BaseLayer;
use super::edge::EdgePatch;
use super::face::FacePatch;
use super::kinds::{Convexity, Side};
use super::points::{SurfacePoint, foot_of};
use super::surface::RationalSurface;
use crate::hierarchy::Hierarchy;
use crate::ray::{Ray, RayHit, Stretch};
use crate::segment_polynomial::SegmentPolynomial;
use crate::tetrahedron::{Tetrahedron, gradient};

/// A cell of the hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cell {
    /// The tetrahedron over a face; barycentric coordinates: its corners, the apex.
    Face(FaceId, Side),
    /// The tetrahedron over an edge; barycentric coordinates: right apex, ends, left apex.
    Edge(EdgeId, Side),
    /// A face that is part of the surface: no tetrahedron.
    Flat(FaceId),
}

/// The function at a point of the hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located {
    /// The tetrahedron that holds the point.
    pub cell: Cell,
    /// Barycentric coordinates in it.
    pub at: [f64; 4],
    /// Value of the function.
    pub value: f64,
    /// Gradient of the function.
    pub gradient: DVec3,
}

/// The tetrahedra of a surface in a tree of boxes.
#[derive(Clone, Debug)]
pub struct RationalHull<'a> {
    surface: &'a RationalSurface,
    cells: Vec<Cell>,
    tree: Hierarchy,
}

/// Largest negative barycentric coordinate of a point that counts as inside.
const INSIDE: f64 = -1e-12;
/// A root along the ray is a point of the surface if the transversal through it has its first root
/// there; this is the agreement asked for.
const SAME_ROOT: f64 = 1e-6;

impl RationalSurface {
    /// Prepares the tetrahedra for [`RationalHull::locate`] and [`RationalHull::cast`]; time
    /// `n log n`.
    #[must_use]
    pub fn hull(&self) -> RationalHull<'_> {
        let faces = self.faces.iter().flat_map(|(face, record)| {
            let sides = Side::BOTH.into_iter().filter(|s| record.sides[s.index()].is_some());
            let flat = (record.convexity == Convexity::Zero).then_some(Cell::Flat(face));
            sides.map(move |side| Cell::Face(face, side)).chain(flat)
        });
        let edges = self.edges.iter().flat_map(|(edge, record)| {
            let sides = Side::BOTH.into_iter().filter(|s| record.apices[s.index()].is_some());
            sides.map(move |side| Cell::Edge(edge, side))
        });
        let cells: Vec<Cell> = faces.chain(edges).collect();
        let boxes: Vec<_> = cells.iter().map(|&cell| self.cell_box(cell)).collect();
        RationalHull { surface: self, tree: Hierarchy::new(&boxes), cells }
    }

    fn cell_box(&self, cell: Cell) -> [DVec3; 2] {
        match (self.tetrahedron(cell), cell) {
            (Some(t), _) => t.bounding_box(),
            (None, Cell::Face(face, _) | Cell::Flat(face)) => {
                let [a, b, c] = self.mesh.triangle(face);
                [a.min(b).min(c), a.max(b).max(c)]
            }
            (None, Cell::Edge(edge, _)) => {
                let [a, b] =
                    self.mesh.topology().edge_vertices(edge).map(|v| self.mesh.position(v));
                [a.min(b), a.max(b)]
            }
        }
    }

    /// The tetrahedron of a cell.
    #[must_use]
    pub fn tetrahedron(&self, cell: Cell) -> Option<Tetrahedron> {
        match cell {
            Cell::Face(face, side) => self.face_tetrahedron(face, side),
            Cell::Edge(edge, side) => self.edge_tetrahedron(edge, side),
            Cell::Flat(_) => None,
        }
    }

    /// The patch of a cell with a tetrahedron.
    fn cell_patch(&self, cell: Cell) -> Option<CellPatch> {
        match cell {
            Cell::Face(face, side) => Some(CellPatch::Face(self.face(face), side)),
            Cell::Edge(edge, side) => Some(CellPatch::Edge(self.edge(edge), side)),
            Cell::Flat(_) => None,
        }
    }
}

/// The function on a cell.
enum CellPatch {
    Face(FacePatch, Side),
    Edge(EdgePatch, Side),
}

impl CellPatch {
    /// Value and derivatives at barycentric coordinates.
    fn jet(&self, at: [f64; 4]) -> Option<(f64, [f64; 4])> {
        match self {
            Self::Face(patch, side) => {
                Some(patch.sides[side.index()].as_ref()?.jet(&patch.base, at))
            }
            Self::Edge(patch, side) => {
                Some(patch.sides[side.index()].as_ref()?.jet(patch.weights, at))
            }
        }
    }

    /// The point of the surface on the transversal through barycentric coordinates, and how far along
    /// it those are.
    fn on_transversal(&self, at: [f64; 4]) -> Option<(SurfacePoint, f64)> {
        match self {
            Self::Face(patch, _) => {
                let (x, t) = foot_of(at);
                Some((patch.point(x)?, t))
            }
            Self::Edge(patch, _) => {
                let [right, i, j, left] = at;
                let (down, up) = (i + j, left + right);
                let y = if up > 0.0 { (left / up).clamp(0.0, 1.0) } else { 0.5 };
                Some((patch.point([i / down, y])?, up / (down + up)))
            }
        }
    }

    /// The function times its denominator: a polynomial of degree 5 at most.
    fn numerator(&self, at: [f64; 4]) -> f64 {
        let Some((value, _)) = self.jet(at) else { return f64::NAN };
        match self {
            Self::Face(patch, _) if !patch.base.is_split() => {
                value * BaseLayer::denominator([at[0], at[1], at[2]])
            }
            Self::Face(..) => value,
            Self::Edge(..) => value * (at[0] + at[3]),
        }
    }

    /// The stretch cut where it passes from one third of a split face to another.
    fn smooth_parts(&self, stretch: &Stretch) -> Vec<Stretch> {
        let mut cuts = vec![0.0, 1.0];
        if let Self::Face(patch, _) = self
            && patch.base.is_split()
        {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let difference = |end: usize| stretch.ends[end][a] - stretch.ends[end][b];
                let cut = difference(0) / (difference(0) - difference(1));
                if cut > 0.0 && cut < 1.0 {
                    cuts.push(cut);
                }
            }
            cuts.sort_by(f64::total_cmp);
        }
        cuts.windows(2).filter(|w| w[0] < w[1]).map(|w| stretch.part(w[0], w[1])).collect()
    }
}

impl RationalHull<'_> {
    /// The cells.
    #[must_use]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The function at a point; `None` outside of the hull. Where tetrahedra overlap (invalid edges),
    /// the one that holds the point deepest counts.
    #[must_use]
    pub fn locate(&self, p: DVec3) -> Option<Located> {
        let mut best: Option<(f64, Cell, [f64; 4])> = None;
        self.tree.at_point(p, 0.0, |index| {
            let cell = self.cells[index];
            let Some(tetrahedron) = self.surface.tetrahedron(cell) else { return false };
            let at = tetrahedron.barycentric(p);
            let depth = at.into_iter().fold(f64::INFINITY, f64::min);
            if depth >= INSIDE && best.is_none_or(|(known, ..)| depth > known) {
                best = Some((depth, cell, at));
            }
            false
        });
        let (_, cell, at) = best?;
        let (value, slopes) = self.surface.cell_patch(cell)?.jet(at)?;
        let gradients = self.surface.tetrahedron(cell)?.gradients();
        Some(Located { cell, at, value, gradient: gradient(slopes, &gradients) })
    }

    /// The nearest point where a ray meets the surface.
    ///
    /// Other roots of the function, which are not first on their transversals, are not part of the
    /// surface and are passed over.
    #[must_use]
    pub fn cast(&self, ray: &Ray) -> Option<RayHit<Cell>> {
        let mut best: Option<RayHit<Cell>> = None;
        self.tree.along_ray(ray, |index| {
            let far = best.as_ref().map_or(f64::INFINITY, |b| b.distance);
            if let Some(hit) = self.cast_cell(ray, self.cells[index]).filter(|h| h.distance < far) {
                best = Some(hit);
            }
            best.as_ref().map_or(f64::INFINITY, |b| b.distance)
        });
        best
    }

    fn cast_cell(&self, ray: &Ray, cell: Cell) -> Option<RayHit<Cell>> {
        if let Cell::Flat(face) = cell {
            return cast_triangle(ray, self.surface.mesh.triangle(face), cell);
        }
        let tetrahedron = self.surface.tetrahedron(cell)?;
        let stretch = ray.inside(&tetrahedron)?;
        let patch = self.surface.cell_patch(cell)?;
        for part in patch.smooth_parts(&stretch) {
            let polynomial = SegmentPolynomial::interpolating(|s| patch.numerator(part.at(s)));
            let on_surface = |s: f64| {
                let found = patch.on_transversal(part.at(s));
                found.is_some_and(|(point, t)| (point.t - t).abs() <= SAME_ROOT)
            };
            if let Some(s) = polynomial.first_root(on_surface) {
                let distance = part.part(s, s).distances[0];
                let (_, slopes) = patch.jet(part.at(s))?;
                let gradient = gradient(slopes, &tetrahedron.gradients());
                return Some(RayHit { distance, point: ray.at(distance), gradient, cell });
            }
        }
        None
    }
}

fn cast_triangle(ray: &Ray, [a, b, c]: [DVec3; 3], cell: Cell) -> Option<RayHit<Cell>> {
    let gradient = (b - a).cross(c - a);
    let distance = (a - ray.origin).dot(gradient) / ray.direction.dot(gradient);
    // also false where the ray is parallel to the plane
    if !(distance >= 0.0 && distance.is_finite()) {
        return None;
    }
    let (point, area) = (ray.at(distance), gradient.length_squared());
    let sees = |p: DVec3, q: DVec3| (q - p).cross(point - p).dot(gradient) >= INSIDE * area;
    (sees(a, b) && sees(b, c) && sees(c, a)).then_some(RayHit { distance, point, gradient, cell })
}
