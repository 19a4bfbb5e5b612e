//! Surfaces as files have them: cells and samples.

use std::cell::Cell;

use basemesh::FaceId;
use basemesh::glam::DVec3;
use io::{ChordError, ChordTessellation, CurvedMesh, FacePoint, Grid, Polygon, Polygons, Samples};
use nagata::{Continuity, NagataSurface, NormalId, Patch};

/// The mesh and the normals of a surface, normals by id.
#[must_use]
pub fn polygons(surface: &NagataSurface) -> Polygons {
    let mesh = surface.mesh();
    let expected = "invariant: a face has three or four corners";
    let face = |face| {
        let corners: Vec<usize> = mesh.corners(face).iter().map(|v| v.index()).collect();
        Polygon::new(&corners).expect(expected)
    };
    let normals = |face| {
        let sides = mesh.sides(face);
        let ids = sides.map(|s| surface.normals().id(mesh, face, s.corner).map(NormalId::index));
        Polygon::new(&ids.collect::<Vec<_>>()).expect(expected)
    };
    Polygons {
        positions: mesh.positions().as_slice().to_vec(),
        normals: surface.normals().normals().to_vec(),
        faces: mesh.faces().map(face).collect(),
        corner_normals: mesh.faces().map(normals).collect(),
    }
}

/// Points and normals at a regular lattice with this many steps along each edge; see [`Samples`].
///
/// # Panics
///
/// If `divisions` is zero.
#[must_use]
pub fn samples(surface: &NagataSurface, divisions: usize) -> Samples {
    let patch = patches(surface);
    Samples::new(&polygons(surface), divisions, |face, at| {
        let patch = patch(face);
        (point(&patch, at), normal(&patch, at).unwrap_or(DVec3::ZERO))
    })
}

/// A surface as quadratic cells over shared points.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvedGrid {
    /// The cells; those of one face follow each other, in face order.
    pub grid: Grid,
    /// Number of cells of each face.
    pub cells_of_face: Vec<usize>,
    /// Largest distance between cells and surface, measured as in [`Samples::quadratic_gap`]. Unit:
    /// length.
    pub gap: f64,
}

/// The cells of a surface.
///
/// A C0 surface becomes one cell for each face, which is its patch exactly (the gap is round-off).
/// The patches of a G1 surface, which are no polynomials, become `divisions²` cells through points
/// on them.
///
/// # Panics
///
/// If `divisions` is zero.
#[must_use]
pub fn curved_grid(surface: &NagataSurface, divisions: usize) -> CurvedGrid {
    let divisions = match surface.settings().continuity {
        Continuity::Position => 1,
        Continuity::TangentPlane(_) => divisions,
    };
    let samples = samples(surface, 2 * divisions);
    let (grid, cells_of_face) = samples.quadratic_grid();
    let patch = patches(surface);
    let gap = samples.quadratic_gap(|face, at| point(&patch(face), at));
    CurvedGrid { grid, cells_of_face, gap }
}

/// The largest distance between flat triangles through samples and the surface; see
/// [`Samples::flat_gap`].
#[must_use]
pub fn flat_gap(surface: &NagataSurface, samples: &Samples) -> f64 {
    let patch = patches(surface);
    samples.flat_gap(|face, at| point(&patch(face), at))
}

/// A surface as one curved element for each face, of any order, and the largest distance between the
/// two, measured as in [`CurvedMesh::gap`]: round-off for C0 patches from order 2 on.
///
/// # Panics
///
/// If `order` is zero.
#[must_use]
pub fn curved_mesh(surface: &NagataSurface, order: usize) -> (CurvedMesh, f64) {
    let curved = samples(surface, order).curved_mesh();
    let patch = patches(surface);
    let is_quad = |face: &FaceId| surface.mesh().corners(*face).len() == 4;
    let (quads, triangles): (Vec<_>, Vec<_>) = surface.mesh().faces().partition(is_quad);
    let gap = curved.gap(|element, at| {
        let faces = if matches!(at, FacePoint::Quad(_)) { &quads } else { &triangles };
        point(&patch(faces[element].index()), at)
    });
    (curved, gap)
}

/// Flat triangles within a distance of the surface; see [`tessellate_within`](io::tessellate_within).
///
/// # Errors
///
/// [`ChordError`].
pub fn chord_tessellation(
    surface: &NagataSurface,
    tolerance: f64,
) -> Result<ChordTessellation, ChordError> {
    let patch = patches(surface);
    io::tessellate_within(&polygons(surface), tolerance, |face, at| {
        let patch = patch(face);
        (point(&patch, at), normal(&patch, at).unwrap_or(DVec3::ZERO))
    })
}

/// The patch of a face, which is made once as long as the same face is asked for.
fn patches(surface: &NagataSurface) -> impl Fn(usize) -> Patch {
    let last: Cell<Option<(usize, Patch)>> = Cell::new(None);
    move |face| match last.get() {
        Some((known, patch)) if known == face => patch,
        _ => {
            let patch = surface.patch(FaceId::new(face));
            last.set(Some((face, patch)));
            patch
        }
    }
}

fn point(patch: &Patch, at: FacePoint) -> DVec3 {
    match (patch, at) {
        (Patch::Triangle(patch), FacePoint::Triangle(at)) => patch.point(at),
        (Patch::TangentPlane(patch), FacePoint::Triangle(at)) => patch.point(at),
        (Patch::Quad(patch), FacePoint::Quad(at)) => patch.point(at),
        _ => unreachable!("invariant: a patch has as many corners as its face"),
    }
}

fn normal(patch: &Patch, at: FacePoint) -> Option<DVec3> {
    match (patch, at) {
        (Patch::Triangle(patch), FacePoint::Triangle(at)) => patch.normal(at),
        (Patch::TangentPlane(patch), FacePoint::Triangle(at)) => patch.normal(at),
        (Patch::Quad(patch), FacePoint::Quad(at)) => patch.normal(at),
        _ => unreachable!("invariant: a patch has as many corners as its face"),
    }
}
