//! The function anywhere in the hull, and rays in space against the surface.

use super::surface::{CellJet, PolyhedralSurface};
use crate::bernstein;
use crate::hierarchy::Hierarchy;
use crate::ray::{Ray, RayHit};
use crate::segment_polynomial::SegmentPolynomial;
use glam::DVec3;

/// Where a ray meets the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the cell with this place in [`Hull::cells`](super::Hull::cells).
    Cell(usize),
    /// In a triangle of the hull that is a planar piece of the surface.
    Flat(usize),
}

/// The tetrahedra and planar pieces of a surface in a tree of boxes.
#[derive(Clone, Debug)]
pub struct HullTree<'a> {
    surface: &'a PolyhedralSurface,
    places: Vec<Place>,
    tree: Hierarchy,
}

/// Largest negative barycentric coordinate of a point that counts as inside.
const INSIDE: f64 = -1e-12;

impl PolyhedralSurface {
    /// Prepares the tetrahedra for [`HullTree::locate`] and [`HullTree::cast`]; time `n log n`.
    #[must_use]
    pub fn tree(&self) -> HullTree<'_> {
        let hull = &self.hull;
        let flat = |t: &usize| hull.triangles[*t].apices == [None, None];
        let flats = (0..hull.triangles.len()).filter(flat).map(Place::Flat);
        let places: Vec<Place> = (0..hull.cells.len()).map(Place::Cell).chain(flats).collect();
        let boxes: Vec<_> = places
            .iter()
            .map(|place| match *place {
                Place::Cell(cell) => hull.tetrahedron(hull.cells[cell]).bounding_box(),
                Place::Flat(t) => {
                    let [a, b, c] = self.triangle(t);
                    [a.min(b).min(c), a.max(b).max(c)]
                }
            })
            .collect();
        HullTree { surface: self, tree: Hierarchy::new(&boxes), places }
    }

    fn triangle(&self, t: usize) -> [DVec3; 3] {
        self.hull.triangles[t].corners.map(|p| self.hull.points[p])
    }
}

impl HullTree<'_> {
    /// The cell that holds a point, and the function there; `None` outside of the hull. Where
    /// tetrahedra overlap, which the report tells, the one that holds the point deepest counts.
    #[must_use]
    pub fn locate(&self, p: DVec3) -> Option<(usize, CellJet)> {
        let mut best: Option<(f64, usize, [f64; 4])> = None;
        self.tree.at_point(p, 0.0, |index| {
            let Place::Cell(cell) = self.places[index] else { return false };
            let hull = &self.surface.hull;
            let at = hull.tetrahedron(hull.cells[cell]).barycentric(p);
            let depth = at.into_iter().fold(f64::INFINITY, f64::min);
            if depth >= INSIDE && best.is_none_or(|(known, ..)| depth > known) {
                best = Some((depth, cell, at));
            }
            false
        });
        best.map(|(_, cell, at)| (cell, self.surface.jet(cell, at)))
    }

    /// The nearest point where a ray meets the surface.
    #[must_use]
    pub fn cast(&self, ray: &Ray) -> Option<RayHit<Place>> {
        let mut best: Option<RayHit<Place>> = None;
        self.tree.along_ray(ray, |index| {
            let far = best.as_ref().map_or(f64::INFINITY, |b| b.distance);
            let hit = match self.places[index] {
                Place::Cell(cell) => self.cast_cell(ray, cell),
                Place::Flat(t) => {
                    ray.meets(self.surface.triangle(t)).map(|(distance, gradient)| {
                        let cell = Place::Flat(t);
                        RayHit { distance, point: ray.at(distance), gradient, cell }
                    })
                }
            };
            if let Some(hit) = hit.filter(|h| h.distance < far) {
                best = Some(hit);
            }
            best.as_ref().map_or(f64::INFINITY, |b| b.distance)
        });
        best
    }

    fn cast_cell(&self, ray: &Ray, cell: usize) -> Option<RayHit<Place>> {
        let surface = self.surface;
        let stretch = ray.inside(&surface.hull.tetrahedron(surface.hull.cells[cell]))?;
        let [from, to] = stretch.ends;
        let along = bernstein::along(surface.degree, surface.weights(cell), from, to);
        let polynomial = SegmentPolynomial::from_bernstein(surface.degree, &along);
        let s = polynomial.first_root(|_| true)?;
        let distance = stretch.part(s, s).distances[0];
        let gradient = surface.jet(cell, stretch.at(s)).gradient;
        Some(RayHit { distance, point: ray.at(distance), gradient, cell: Place::Cell(cell) })
    }
}
