//! The number of cells that gives a wanted number of triangles, and whether it shows the topology.

use implicit::{Aabb, BoundedField};

use super::error::PolygonizeError;
use super::{PolygonizeSettings, polygonize};
use crate::mesh::TriMesh;

/// Fewest cells along the longest side, so that holes and gaps of a few per cent of it are seen.
const FEWEST_CELLS: usize = 48;
/// Number of resolutions tried until a surface is seen, each twice the one before.
const FIRST_LOOKS: u32 = 3;
/// A mesh with fewer triangles says little about the area: a ball of one node has 8 triangles, 3 area
/// / size² can be a third of that or three times as much.
const RELIABLE_FACES: usize = 1000;
/// How often the grid is refined if two resolutions disagree, by the ratio between them: up to
/// four times the cells and sixteen times the triangles that were asked for.
const REFINEMENTS: usize = 4;
/// Ratio of the coarse resolution of a comparison to the fine one.
const COARSER: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// What two meshes of the same surface must have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TopologyCount {
    /// Cells along the longest side of the region.
    pub cells: usize,
    /// Vertices minus edges plus faces.
    pub euler_characteristic: i64,
    /// Number of connected components.
    pub components: usize,
}

/// A mesh with the outcome of the comparison of two resolutions.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Polygonization {
    /// The mesh at the finer resolution.
    pub mesh: TriMesh,
    /// Number of cells along the longest side of the region.
    pub cells: usize,
    /// Whether the Euler characteristic and the number of components are the same at both
    /// resolutions. If not, the mesh is closed and manifold, but parts of the surface may be too
    /// thin for the finest grid that was tried.
    pub confirmed: bool,
    /// What the mesh has.
    pub found: TopologyCount,
    /// What the mesh at the coarser resolution had; without surface both counts are zero.
    pub compared: TopologyCount,
}

/// The number of cells along the longest side for about `faces` triangles, at least 48.
///
/// Estimated from a mesh with 48 cells, since the number of triangles is proportional to the area
/// over the squared cell size: about 3 area / size². If there is no surface 96 and 192 cells are
/// tried, and if it has less than 1000 triangles a finer mesh is taken for the estimate.
///
/// # Errors
///
/// Those of [`polygonize`].
pub fn cells_for_faces(
    field: &dyn BoundedField,
    region: &Aabb,
    faces: usize,
) -> Result<usize, PolygonizeError> {
    Ok(first_look(field, region, faces)?.cells_for(faces))
}

/// A mesh with about `faces` triangles whose topology was compared with that of a coarser one.
///
/// The grid has at least 48 cells along the longest side of the region, so that the mesh can have
/// more triangles than were asked for. The comparison uses 0.7 times the cells. If the Euler
/// characteristic or the number of components differ, the grid is refined by that ratio and compared
/// with the one before, up to four times; the last outcome is reported.
///
/// # Errors
///
/// Those of [`polygonize`].
pub fn polygonize_to_faces(
    field: &dyn BoundedField,
    region: &Aabb,
    faces: usize,
) -> Result<Polygonization, PolygonizeError> {
    let first = first_look(field, region, faces)?;
    let mut cells = first.cells_for(faces);
    let mut mesh =
        if cells == first.cells { first.mesh } else { at_resolution(field, region, cells)? };
    let mut found = count(Some(&mesh), cells);
    let coarse_cells = times(cells, COARSER);
    let mut compared = count(seen(field, region, coarse_cells)?.as_ref(), coarse_cells);
    for _ in 0..REFINEMENTS {
        if agree(&found, &compared) {
            break;
        }
        compared = found;
        cells = times(cells, 1.0 / COARSER);
        mesh = at_resolution(field, region, cells)?;
        found = count(Some(&mesh), cells);
    }
    Ok(Polygonization { mesh, cells, confirmed: agree(&found, &compared), found, compared })
}

/// A mesh that tells how many cells are needed.
struct FirstLook {
    mesh: TriMesh,
    /// Number of cells of the mesh.
    cells: usize,
    /// The smallest number of cells that was tried and shows a surface.
    fewest: usize,
}

impl FirstLook {
    /// The number of cells for `faces` triangles, at least the fewest.
    fn cells_for(&self, faces: usize) -> usize {
        let ratio = faces as f64 / self.mesh.topology().face_count() as f64;
        self.fewest.max(times(self.cells, ratio.sqrt()))
    }
}

fn first_look(
    field: &dyn BoundedField,
    region: &Aabb,
    faces: usize,
) -> Result<FirstLook, PolygonizeError> {
    let mut cells = FEWEST_CELLS;
    let mut mesh = seen(field, region, cells)?;
    for _ in 1..FIRST_LOOKS {
        if mesh.is_none() {
            cells *= 2;
            mesh = seen(field, region, cells)?;
        }
    }
    // once more for the error
    let mesh = mesh.map_or_else(|| at_resolution(field, region, cells), Ok)?;
    let look = FirstLook { mesh, cells, fewest: cells };
    let enough = faces.min(RELIABLE_FACES);
    if look.mesh.topology().face_count() >= enough {
        return Ok(look);
    }
    let cells = look.cells_for(enough);
    Ok(FirstLook { mesh: at_resolution(field, region, cells)?, cells, ..look })
}

/// The integer next to a multiple; too many cells are refused by the grid.
#[expect(clippy::cast_possible_truncation, reason = "the conversion saturates")]
fn times(cells: usize, factor: f64) -> usize {
    (cells as f64 * factor).round() as usize
}

fn at_resolution(
    field: &dyn BoundedField,
    region: &Aabb,
    cells: usize,
) -> Result<TriMesh, PolygonizeError> {
    polygonize(field, region, &PolygonizeSettings::with_cells(cells))
}

/// The mesh, or nothing if the grid is too coarse to see a surface.
fn seen(
    field: &dyn BoundedField,
    region: &Aabb,
    cells: usize,
) -> Result<Option<TriMesh>, PolygonizeError> {
    match at_resolution(field, region, cells) {
        Err(PolygonizeError::NoSurface { .. }) => Ok(None),
        other => other.map(Some),
    }
}

fn count(mesh: Option<&TriMesh>, cells: usize) -> TopologyCount {
    let topology = mesh.map(TriMesh::topology);
    TopologyCount {
        cells,
        euler_characteristic: topology.map_or(0, crate::Topology::euler_characteristic),
        components: topology.map_or(0, crate::Topology::component_count),
    }
}

fn agree(a: &TopologyCount, b: &TopologyCount) -> bool {
    (a.euler_characteristic, a.components) == (b.euler_characteristic, b.components)
}
