//! Surfaces of flat and quadratic cells over shared points, as VTK unstructured grids.

use std::io::{Read, Write};
use std::path::Path;

use glam::DVec3;

use super::array::ArrayHead;
use super::document::{Document, RawArray};
use super::error::{VtuReadError, VtuWriteError};
use super::read::{cell_array, cell_data, check_count, document, numbers, points};
use super::write::{Connectivity, check_values, to_i64, write_values, write_whole};
use super::{CellData, Encoding};
use crate::in_file::{InFile, parse_file};

/// Name of the array of point normals.
const NORMALS: &str = "Normals";

/// A cell by the ids of its points.
///
/// Corners come first, counter-clockwise seen from outside; then the mid-side nodes, starting with
/// the side from the first corner to the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GridCell {
    /// `VTK_TRIANGLE` (5).
    Triangle([usize; 3]),
    /// `VTK_QUAD` (9).
    Quad([usize; 4]),
    /// `VTK_QUADRATIC_TRIANGLE` (22): the quadratic polynomial through six points.
    QuadraticTriangle([usize; 6]),
    /// `VTK_QUADRATIC_QUAD` (23): the serendipity element with eight points.
    QuadraticQuad([usize; 8]),
}

impl GridCell {
    /// The cell type number of VTK.
    #[must_use]
    pub const fn vtk_type(&self) -> u8 {
        match self {
            Self::Triangle(_) => 5,
            Self::Quad(_) => 9,
            Self::QuadraticTriangle(_) => 22,
            Self::QuadraticQuad(_) => 23,
        }
    }

    /// The ids of its points.
    #[must_use]
    pub const fn points(&self) -> &[usize] {
        match self {
            Self::Triangle(points) => points,
            Self::Quad(points) => points,
            Self::QuadraticTriangle(points) => points,
            Self::QuadraticQuad(points) => points,
        }
    }

    /// The same cell over other points.
    #[must_use]
    pub fn map(self, id: impl FnMut(usize) -> usize) -> Self {
        match self {
            Self::Triangle(points) => Self::Triangle(points.map(id)),
            Self::Quad(points) => Self::Quad(points.map(id)),
            Self::QuadraticTriangle(points) => Self::QuadraticTriangle(points.map(id)),
            Self::QuadraticQuad(points) => Self::QuadraticQuad(points.map(id)),
        }
    }

    fn new(vtk_type: i64, points: &[usize]) -> Option<Self> {
        match vtk_type {
            5 => points.try_into().ok().map(Self::Triangle),
            9 => points.try_into().ok().map(Self::Quad),
            22 => points.try_into().ok().map(Self::QuadraticTriangle),
            23 => points.try_into().ok().map(Self::QuadraticQuad),
            _ => None,
        }
    }
}

/// Cells over shared points, with numbers for points and cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Positions, each point once.
    pub points: Vec<DVec3>,
    /// A unit normal for each point, or zero where there is not exactly one; empty if there are no
    /// normals.
    pub normals: Vec<DVec3>,
    /// The cells.
    pub cells: Vec<GridCell>,
    /// Numbers for each point.
    pub point_data: Vec<CellData>,
    /// Numbers for each cell.
    pub cell_data: Vec<CellData>,
}

/// Writes a grid; [`read_grid`] returns it bit for bit.
///
/// The normals become the point array `Normals`. It is not declared as what viewers shade with,
/// because points on creases have none. Viewers show flat facets until their nonlinear subdivision
/// level is raised.
///
/// # Errors
///
/// [`VtuWriteError`]; everything but [`VtuWriteError::Io`] is found before anything is written.
pub fn write_grid(
    out: &mut dyn Write,
    grid: &Grid,
    encoding: Encoding,
) -> Result<(), VtuWriteError> {
    check(grid, encoding)?;
    let connectivity = Connectivity {
        points: grid.cells.iter().flat_map(GridCell::points).map(|&point| to_i64(point)).collect(),
        sizes: grid.cells.iter().map(|cell| cell.points().len()).collect(),
        types: grid.cells.iter().map(GridCell::vtk_type).collect(),
    };
    write_whole(out, encoding, &grid.points, &connectivity, |out, arrays| {
        if !(grid.normals.is_empty() && grid.point_data.is_empty()) {
            writeln!(out, "<PointData>")?;
            if !grid.normals.is_empty() {
                let count = 3 * grid.normals.len();
                let head = ArrayHead { name: NORMALS, components: 3, count, per_line: 3 };
                arrays.write(out, head, grid.normals.iter().flat_map(DVec3::to_array))?;
            }
            write_values(out, arrays, &grid.point_data)?;
            writeln!(out, "</PointData>")?;
        }
        if !grid.cell_data.is_empty() {
            writeln!(out, "<CellData>")?;
            write_values(out, arrays, &grid.cell_data)?;
            writeln!(out, "</CellData>")?;
        }
        Ok(())
    })?;
    Ok(())
}

fn check(grid: &Grid, encoding: Encoding) -> Result<(), VtuWriteError> {
    let count = grid.points.len();
    let missing = |(cell, points): (usize, &GridCell)| {
        let point = points.points().iter().find(|&&point| point >= count)?;
        Some(VtuWriteError::MissingPoint { cell, point: *point, count })
    };
    if let Some(error) = grid.cells.iter().enumerate().find_map(missing) {
        return Err(error);
    }
    if !grid.normals.is_empty() && grid.normals.len() != count {
        let normals = grid.normals.len();
        return Err(VtuWriteError::NormalCount { normals, points: count });
    }
    for (what, values) in [("position", &grid.points), ("normal", &grid.normals)] {
        if let Some(point) = values.iter().position(|value| !value.is_finite()) {
            let value = values[point];
            return Err(VtuWriteError::PointNotFinite { point, what, value });
        }
    }
    if let Some(data) = grid.point_data.iter().find(|data| data.name == NORMALS) {
        return Err(VtuWriteError::CellDataTwice { name: data.name.clone() });
    }
    check_values(&grid.point_data, "points", count, encoding)?;
    check_values(&grid.cell_data, "cells", grid.cells.len(), encoding)
}

/// Reads a grid of flat or quadratic triangles and quadrilaterals, in one piece.
///
/// Point and cell arrays with one component are kept, and point normals named `Normals`; other
/// arrays are left out. Encodings are understood as by [`read_vtu`](crate::read_vtu).
///
/// # Errors
///
/// [`VtuReadError`] with the first offending cell.
pub fn read_grid(input: &mut dyn Read) -> Result<Grid, VtuReadError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    from_bytes(&bytes)
}

/// Reads a grid from a file; see [`read_grid`].
///
/// # Errors
///
/// [`VtuReadError`], with the path.
pub fn read_grid_file(path: impl AsRef<Path>) -> Result<Grid, InFile<VtuReadError>> {
    parse_file(path.as_ref(), from_bytes)
}

fn from_bytes(bytes: &[u8]) -> Result<Grid, VtuReadError> {
    let document = document(bytes)?;
    let points = points(&document)?;
    let cells = cells(&document, points.len())?;
    for (cell, &point) in
        (0..).zip(&cells).flat_map(|(c, of)| of.points().iter().map(move |p| (c, p)))
    {
        let position = points[point];
        if !position.is_finite() {
            return Err(VtuReadError::NotFinite { cell, point, position });
        }
    }
    let (cell_data, _) = cell_data(&document)?;
    let is_normals = |array: &&RawArray<'_>| array.name == NORMALS && array.components == 3;
    let normals = document.point_data.iter().find(is_normals);
    let normals = normals.map(|array| normals_of(array, &document)).transpose()?;
    let point_data = point_data(&document)?;
    Ok(Grid { points, normals: normals.unwrap_or_default(), cells, point_data, cell_data })
}

fn normals_of(array: &RawArray<'_>, document: &Document<'_>) -> Result<Vec<DVec3>, VtuReadError> {
    let numbers = array.floats(document)?;
    check_count(array, "numbers", numbers.len(), 3 * document.point_count)?;
    let normals: Vec<_> =
        numbers.as_chunks::<3>().0.iter().copied().map(DVec3::from_array).collect();
    match normals.iter().position(|normal| !normal.is_finite()) {
        Some(point) => Err(array.error(format!("is not finite at point {point}"))),
        None => Ok(normals),
    }
}

fn point_data(document: &Document<'_>) -> Result<Vec<CellData>, VtuReadError> {
    let usable = |array: &&RawArray<'_>| array.is_number() && array.components == 1;
    let read = |array: &RawArray<'_>| {
        let values = numbers(array, document)?;
        check_count(array, "values", values.len(), document.point_count)?;
        Ok(CellData { name: array.name.clone(), values })
    };
    document.point_data.iter().filter(usable).map(read).collect()
}

fn cells(document: &Document<'_>, point_count: usize) -> Result<Vec<GridCell>, VtuReadError> {
    let array = cell_array(document, "types", "array 'types' in <Cells>")?;
    let types = array.integers(document)?;
    check_count(array, "values", types.len(), document.cell_count)?;
    let array = cell_array(document, "offsets", "array 'offsets' in <Cells>")?;
    let ends = array.integers(document)?;
    check_count(array, "values", ends.len(), document.cell_count)?;
    let array = cell_array(document, "connectivity", "array 'connectivity' in <Cells>")?;
    let ids = array.integers(document)?;
    let announced = ends.last().copied().unwrap_or(0);
    if i64::try_from(ids.len()) != Ok(announced) {
        let found = ids.len();
        let problem =
            format!("has {found} point ids where {announced} are announced; the file is damaged");
        return Err(array.error(problem));
    }
    let mut cells = Vec::with_capacity(ends.len());
    let mut start = 0;
    for (cell, (end, vtk_type)) in ends.into_iter().zip(types).enumerate() {
        let range = usize::try_from(start).ok().zip(usize::try_from(end).ok());
        let ids = range.and_then(|(start, end)| ids.get(start..end)).unwrap_or_default();
        cells.push(one_cell(cell, vtk_type, ids, point_count)?);
        start = end;
    }
    Ok(cells)
}

fn one_cell(
    cell: usize,
    vtk_type: i64,
    ids: &[i64],
    count: usize,
) -> Result<GridCell, VtuReadError> {
    let mut points = [0; 8];
    if ids.len() > points.len() {
        return Err(VtuReadError::GridCell { cell, vtk_type, points: ids.len() });
    }
    for (slot, &point) in points.iter_mut().zip(ids) {
        let id = usize::try_from(point).ok().filter(|&id| id < count);
        *slot = id.ok_or(VtuReadError::MissingPoint { cell, point, count })?;
    }
    let refused = VtuReadError::GridCell { cell, vtk_type, points: ids.len() };
    GridCell::new(vtk_type, &points[..ids.len()]).ok_or(refused)
}
