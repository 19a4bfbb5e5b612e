//! From an implicit function to a closed triangle mesh.
//!
//! The steps, one module each:
//!
//! 1. [`grid`](self): cubic cells cover the region, shifted so that no grid plane falls on a plane
//!    of symmetry;
//! 2. `survey`: boxes whose enclosure excludes zero are discarded, halving from the whole grid down
//!    to blocks of 4 x 4 x 4 cells; the nodes of the blocks that remain are sampled;
//! 3. `block`: a block with both signs keeps its signs, which grid edges the surface crosses, and
//!    where; nothing is kept of the others;
//! 4. `cases`: marching cubes with a table traced from contours on the faces of a cell;
//! 5. `stitch`: every crossed grid edge becomes one vertex and the cells are filled with triangles.
//!
//! Why the result is always a closed oriented manifold, whatever the signs are: the contours on the
//! face of a cell depend on the four signs of that face only, so that both cells agree; each crossed
//! edge lies on one contour loop of each of its four cells, so that its triangles form one fan; and
//! no diagonal of a loop joins two points of one face, so that no other cell can contain it.

mod batch;
mod block;
mod boundary;
mod cases;
mod contour;
mod crossing;
mod error;
mod follow;
mod grid;
mod morton;
mod nodes;
mod resolution;
mod stitch;
mod survey;

pub use error::PolygonizeError;
pub use resolution::{Polygonization, TopologyCount, cells_for_faces, polygonize_to_faces};

use implicit::{Aabb, BoundedField};

use crate::mesh::TriMesh;
use grid::Grid;

/// How finely [`polygonize`] looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PolygonizeSettings {
    /// Number of cubic cells along the longest side of the region, 1 to 2²⁰.
    pub cells: usize,
}

impl PolygonizeSettings {
    /// Settings with this number of cells along the longest side of the region.
    ///
    /// Parts of the surface thinner than a cell can be missed; the number of triangles grows with
    /// the square of `cells`.
    #[must_use]
    pub fn with_cells(cells: usize) -> Self {
        Self { cells }
    }
}

/// The zero set of `field` in `region` as a closed, oriented, manifold mesh: all its components,
/// with triangles counter-clockwise seen from the side where the field is positive.
///
/// Vertices lie on grid edges whose ends have different signs (zero counts as outside). They are
/// placed by linear interpolation and one step with the parabola through a third value; they lie on
/// the surface up to the fourth order in the cell size (the third on edges almost tangent to it), but
/// stay away from the grid nodes by 2⁻¹⁶ of a cell so that no triangle collapses. Parts of the surface that pass between the nodes of the grid
/// are not seen.
///
/// The result is a pure function of the arguments, the same bit for bit with any number of threads.
/// Time and memory are linear in the number of triangles if the enclosures of the field are useful;
/// if they are not ([`implicit::Interval::ENTIRE`]) every node is sampled, which takes time
/// proportional to `cells` cubed, but still memory proportional to the result.
///
/// The grid reaches beyond the region by up to 1.3 cells on each side, and that is where the field
/// must be defined and where the surface must be closed.
///
/// # Errors
///
/// [`PolygonizeError`]: no surface in the region, a surface that leaves it, a field value at a grid
/// node that is not finite (nodes in discarded boxes are not looked at), or unusable arguments.
pub fn polygonize(
    field: &dyn BoundedField,
    region: &Aabb,
    settings: &PolygonizeSettings,
) -> Result<TriMesh, PolygonizeError> {
    let grid = Grid::new(region, settings.cells)?;
    let mut survey = survey::survey(field, &grid)?;
    follow::follow_crossed_faces(field, &grid, &mut survey)?;
    if survey.blocks.is_empty() {
        let values = survey.values;
        return Err(PolygonizeError::NoSurface { region: *region, min: values.lo, max: values.hi });
    }
    if let Some(exit) = boundary::find_exit(&grid, &survey.blocks) {
        let (suggested, closes) =
            boundary::suggest_region(field, region, settings.cells, exit.sides);
        return Err(PolygonizeError::LeavesRegion { at: exit.at, suggested, closes });
    }
    stitch::stitch(&grid, survey.blocks)
}
