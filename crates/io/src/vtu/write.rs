//! From patches to a file.

use std::io::{self, Write};

use basemesh::{FaceMap, Topology};
use bezier_core::{BezierTriangle, MultiIndex};
use glam::DVec3;

use super::array::{ArrayHead, ArrayWriter};
use super::error::VtuWriteError;
use super::{CellData, CellKind, CellValues, Encoding, VtuOptions};
use crate::lattice::Lattice;
use crate::node_order::node_order;

/// Writes a patch surface; every coordinate keeps its bits with [`CellKind::Bezier`].
///
/// Points shared by several patches are written once: first the vertices, by id; then `degree - 1`
/// points for each edge, in the direction of its canonical half-edge; then the interior points of
/// each patch. Viewers show flat facets until their nonlinear subdivision level is raised.
///
/// Nothing is written if the input is refused.
///
/// # Errors
///
/// [`VtuWriteError`], among others if two patches disagree about a shared point in a single bit:
/// none of them is preferred.
pub fn write_vtu<const P: usize>(
    out: &mut dyn Write,
    topology: &Topology,
    nets: &FaceMap<BezierTriangle<DVec3, P>>,
    options: &VtuOptions,
) -> Result<(), VtuWriteError> {
    const { assert!(P >= 3, "a cell has three corners") };
    if nets.len() != topology.face_count() {
        let (patches, faces) = (nets.len(), topology.face_count());
        return Err(VtuWriteError::PatchCount { patches, faces });
    }
    check_values(&options.cell_data, "patches", nets.len(), options.encoding)?;
    let degree = BezierTriangle::<DVec3, P>::DEGREE;
    let lattice = Lattice::new(topology, degree);
    let mut points = lattice.gather(nets)?;
    if options.cells == CellKind::Lagrange {
        points = lattice.sample(nets);
    }
    check_finite(&points, &lattice, topology, degree)?;
    let cells = nets.len();
    let connectivity = Connectivity {
        points: connectivity(&lattice, topology, degree),
        sizes: vec![P; cells],
        types: vec![options.cells.vtk_type(); cells],
    };
    write_whole(out, options.encoding, &points, &connectivity, |out, arrays| {
        if options.cell_data.is_empty() {
            return Ok(());
        }
        writeln!(out, "<CellData>")?;
        write_values(out, arrays, &options.cell_data)?;
        writeln!(out, "</CellData>")
    })?;
    Ok(())
}

/// Checks numbers for each of `count` elements, which are called `of`.
pub(super) fn check_values(
    data: &[CellData],
    of: &'static str,
    count: usize,
    encoding: Encoding,
) -> Result<(), VtuWriteError> {
    for (at, CellData { name, values }) in data.iter().enumerate() {
        if name.trim() != name || name.is_empty() || name.chars().any(char::is_control) {
            return Err(VtuWriteError::CellDataName { name: name.clone() });
        }
        if data[..at].iter().any(|earlier| earlier.name == *name) {
            return Err(VtuWriteError::CellDataTwice { name: name.clone() });
        }
        if values.len() != count {
            let (name, values) = (name.clone(), values.len());
            return Err(VtuWriteError::CellDataCount { name, values, cells: count, of });
        }
        if let (Encoding::Ascii, CellValues::Float64(values)) = (encoding, values)
            && let Some(cell) = values.iter().position(|value| !value.is_finite())
        {
            let (name, value) = (name.clone(), values[cell]);
            return Err(VtuWriteError::CellDataNotFinite { name, cell, value });
        }
    }
    Ok(())
}

fn check_finite(
    points: &[DVec3],
    lattice: &Lattice<'_>,
    topology: &Topology,
    degree: usize,
) -> Result<(), VtuWriteError> {
    if points.iter().all(|point| point.is_finite()) {
        return Ok(());
    }
    for face in topology.faces() {
        for index in MultiIndex::all(degree) {
            let position = points[lattice.locate(face, index.rank()).0];
            if !position.is_finite() {
                return Err(VtuWriteError::NotFinite { face, index, position });
            }
        }
    }
    Ok(())
}

fn connectivity(lattice: &Lattice<'_>, topology: &Topology, degree: usize) -> Vec<i64> {
    let order = node_order(degree);
    let id = |face, rank| to_i64(lattice.locate(face, rank).0);
    topology.faces().flat_map(|face| order.iter().map(move |&rank| id(face, rank))).collect()
}

pub(super) fn to_i64(count: usize) -> i64 {
    i64::try_from(count).expect("invariant: memory holds fewer than 2^63 points")
}

/// The points of all cells one after the other, and the size and type of each cell.
pub(super) struct Connectivity {
    pub(super) points: Vec<i64>,
    pub(super) sizes: Vec<usize>,
    pub(super) types: Vec<u8>,
}

/// Writes a whole file; `data` writes the sections with data of points and cells.
pub(super) fn write_whole(
    out: &mut dyn Write,
    encoding: Encoding,
    points: &[DVec3],
    connectivity: &Connectivity,
    data: impl FnOnce(&mut dyn Write, &mut ArrayWriter) -> io::Result<()>,
) -> io::Result<()> {
    let cells = connectivity.sizes.len();
    let mut arrays = ArrayWriter::new(encoding);
    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(
        out,
        r#"<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#
    )?;
    writeln!(out, "<UnstructuredGrid>")?;
    writeln!(out, r#"<Piece NumberOfPoints="{}" NumberOfCells="{cells}">"#, points.len())?;
    data(out, &mut arrays)?;
    writeln!(out, "<Points>")?;
    let coordinates = points.iter().flat_map(DVec3::to_array);
    let head = ArrayHead { name: "Points", components: 3, count: 3 * points.len(), per_line: 3 };
    arrays.write(out, head, coordinates)?;
    writeln!(out, "</Points>\n<Cells>")?;
    write_cells(out, &mut arrays, connectivity)?;
    writeln!(out, "</Cells>\n</Piece>\n</UnstructuredGrid>")?;
    arrays.finish(out)?;
    writeln!(out, "</VTKFile>")
}

fn write_cells(
    out: &mut dyn Write,
    arrays: &mut ArrayWriter,
    Connectivity { points, sizes, types }: &Connectivity,
) -> io::Result<()> {
    let per_line = sizes.first().copied().unwrap_or(1);
    let head = ArrayHead { per_line, ..ArrayHead::scalars("connectivity", points.len()) };
    arrays.write(out, head, points.iter().copied())?;
    let ends = sizes.iter().scan(0, |end, size| {
        *end += size;
        Some(to_i64(*end))
    });
    arrays.write(out, ArrayHead::scalars("offsets", sizes.len()), ends)?;
    arrays.write(out, ArrayHead::scalars("types", types.len()), types.iter().copied())
}

pub(super) fn write_values(
    out: &mut dyn Write,
    arrays: &mut ArrayWriter,
    data: &[CellData],
) -> io::Result<()> {
    for CellData { name, values } in data {
        let head = ArrayHead::scalars(name, values.len());
        match values {
            CellValues::Float64(values) => arrays.write(out, head, values.iter().copied())?,
            CellValues::Int64(values) => arrays.write(out, head, values.iter().copied())?,
        }
    }
    Ok(())
}
