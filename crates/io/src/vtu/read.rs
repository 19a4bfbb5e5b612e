//! From a file to patches.

use std::io::Read;
use std::path::Path;

use basemesh::{FaceId, FaceMap, Topology};
use bezier_core::BezierTriangle;
use glam::DVec3;

use super::appended;
use super::document::{self, Document, RawArray};
use super::error::VtuReadError;
use super::interpolation::Interpolation;
use super::{CellData, CellKind, CellValues, VtuSurface};
use crate::in_file::{InFile, parse_file};
use crate::lattice::Lattice;
use crate::node_order::node_order;

/// Reads a surface of patches with `P` control points, in one piece of Bézier or Lagrange triangles.
///
/// Files of [`write_vtu`](crate::write_vtu) with Bézier cells come back bit for bit, with the same
/// ids. In other files vertices are numbered in the order of their point ids, and neighbours are
/// cells that use the *same* points: merge points that merely coincide before (in ParaView: Clean to
/// Grid). Lagrange cells are converted to Bézier form, which amplifies the rounding of their points
/// (by up to 10 in degree 3, 412 in degree 7, 5e4 in degree 12); exact neighbours stay exact
/// neighbours.
///
/// Numbers may be text, base64, or appended (raw or base64), of either byte order; compressed data
/// and rational patches are refused. Bytes that are not such a file are refused with an error, never a
/// panic.
///
/// # Errors
///
/// [`VtuReadError`] with the first offending cell.
pub fn read_vtu<const P: usize>(input: &mut dyn Read) -> Result<VtuSurface<P>, VtuReadError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    from_bytes(&bytes)
}

/// Reads a surface from a file; see [`read_vtu`].
///
/// # Errors
///
/// [`VtuReadError`], with the path.
pub fn read_vtu_file<const P: usize>(
    path: impl AsRef<Path>,
) -> Result<VtuSurface<P>, InFile<VtuReadError>> {
    parse_file(path.as_ref(), from_bytes)
}

fn from_bytes<const P: usize>(bytes: &[u8]) -> Result<VtuSurface<P>, VtuReadError> {
    const { assert!(P >= 3, "a cell has three corners") };
    let document = document(bytes)?;
    refuse_rational(&document)?;
    let points = points(&document)?;
    let kind = cell_kind(&document)?;
    let cells = connectivity::<P>(&document, points.len())?;
    let corners = corner_vertices(&cells, points.len());
    let topology = Topology::from_faces(corners.vertex_count, &corners.faces)?;
    let nets = nets(&points, &cells)?;
    Lattice::new(&topology, BezierTriangle::<DVec3, P>::DEGREE).gather(&nets)?;
    let nets = match kind {
        CellKind::Bezier => nets,
        CellKind::Lagrange => Interpolation::new().control_points(&topology, &nets),
    };
    let (cell_data, skipped) = cell_data(&document)?;
    Ok(VtuSurface { topology, nets, cell_data, skipped })
}

/// The parts of a file.
pub(super) fn document(bytes: &[u8]) -> Result<Document<'_>, VtuReadError> {
    let (xml, appended) = appended::split(bytes)?;
    let text = std::str::from_utf8(xml).map_err(|error| not_text(xml, error))?;
    Ok(Document { appended, ..document::parse(text)? })
}

fn not_text(bytes: &[u8], error: std::str::Utf8Error) -> VtuReadError {
    let before = &bytes[..error.valid_up_to()];
    let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
    VtuReadError::Xml { line, message: "the bytes are not UTF-8".to_owned() }
}

fn refuse_rational(document: &Document<'_>) -> Result<(), VtuReadError> {
    let Some(name) = &document.rational_weights else { return Ok(()) };
    for array in document.point_data.iter().filter(|array| array.name == *name) {
        let weights = array.floats(document)?;
        if weights.iter().any(|weight| weight.to_bits() != 1.0_f64.to_bits()) {
            let what = "rational patches are";
            return Err(VtuReadError::Unsupported { what, instead: "polynomial patches" });
        }
    }
    Ok(())
}

pub(super) fn points(document: &Document<'_>) -> Result<Vec<DVec3>, VtuReadError> {
    let array =
        document.points.first().ok_or(VtuReadError::Missing { what: "array in <Points>" })?;
    let numbers = array.floats(document)?;
    let (points, rest) = numbers.as_chunks::<3>();
    if array.components != 3 || !rest.is_empty() {
        return Err(array.error("does not have three numbers for each point"));
    }
    check_count(array, "points", points.len(), document.point_count)?;
    Ok(points.iter().copied().map(DVec3::from_array).collect())
}

pub(super) fn check_count(
    array: &RawArray<'_>,
    of: &str,
    found: usize,
    expected: usize,
) -> Result<(), VtuReadError> {
    if found == expected {
        return Ok(());
    }
    Err(array
        .error(format!("has {found} {of} where {expected} are announced; the file is damaged")))
}

pub(super) fn cell_array<'d, 'a>(
    document: &'d Document<'a>,
    name: &'static str,
    what: &'static str,
) -> Result<&'d RawArray<'a>, VtuReadError> {
    let found = document.cells.iter().find(|array| array.name == name);
    found.ok_or(VtuReadError::Missing { what })
}

fn cell_kind(document: &Document<'_>) -> Result<CellKind, VtuReadError> {
    let array = cell_array(document, "types", "array 'types' in <Cells>")?;
    let types = array.integers(document)?;
    check_count(array, "values", types.len(), document.cell_count)?;
    let kind_of =
        |found: i64| CellKind::ALL.into_iter().find(|kind| i64::from(kind.vtk_type()) == found);
    let first = types.first().and_then(|&first| kind_of(first));
    let expected = match first {
        None => "76 or 69",
        Some(CellKind::Bezier) => "76 like cell 0",
        Some(CellKind::Lagrange) => "69 like cell 0",
    };
    match types.iter().position(|&found| kind_of(found).is_none_or(|kind| first != Some(kind))) {
        Some(cell) => Err(VtuReadError::CellType { cell, found: types[cell], expected }),
        // without cells the kind does not matter; the topology refuses them
        None => Ok(first.unwrap_or_default()),
    }
}

/// The point ids of each cell, in file order.
fn connectivity<const P: usize>(
    document: &Document<'_>,
    point_count: usize,
) -> Result<Vec<[usize; P]>, VtuReadError> {
    check_offsets::<P>(document)?;
    let array = cell_array(document, "connectivity", "array 'connectivity' in <Cells>")?;
    let ids = array.integers(document)?;
    let (cells, rest) = ids.as_chunks::<P>();
    if !rest.is_empty() || cells.len() != document.cell_count {
        let (found, cells) = (ids.len(), document.cell_count);
        let problem =
            format!("has {found} point ids for {cells} cells of {P} points; the file is damaged");
        return Err(array.error(problem));
    }
    let checked = |cell: usize, point: i64| {
        let id = usize::try_from(point).ok().filter(|&id| id < point_count);
        id.ok_or(VtuReadError::MissingPoint { cell, point, count: point_count })
    };
    let mut result = vec![[0; P]; cells.len()];
    for (cell, (target, source)) in result.iter_mut().zip(cells).enumerate() {
        for (slot, &point) in target.iter_mut().zip(source) {
            *slot = checked(cell, point)?;
        }
    }
    Ok(result)
}

fn check_offsets<const P: usize>(document: &Document<'_>) -> Result<(), VtuReadError> {
    let array = cell_array(document, "offsets", "array 'offsets' in <Cells>")?;
    let ends = array.integers(document)?;
    check_count(array, "values", ends.len(), document.cell_count)?;
    let mut start = 0_i64;
    for (cell, end) in ends.into_iter().enumerate() {
        let points = end.saturating_sub(start);
        if usize::try_from(points) != Ok(P) {
            let degree = BezierTriangle::<DVec3, P>::DEGREE;
            return Err(VtuReadError::PointsPerCell { cell, points, expected: P, degree });
        }
        start = end;
    }
    Ok(())
}

struct Corners {
    vertex_count: usize,
    faces: Vec<[usize; 3]>,
}

/// Numbers the points that are corners, in the order of their ids.
fn corner_vertices<const P: usize>(cells: &[[usize; P]], point_count: usize) -> Corners {
    let mut vertex_of = vec![None; point_count];
    for cell in cells {
        for &point in &cell[..3] {
            vertex_of[point] = Some(0);
        }
    }
    let mut vertex_count = 0;
    for vertex in vertex_of.iter_mut().flatten() {
        *vertex = vertex_count;
        vertex_count += 1;
    }
    let vertex = |point: usize| vertex_of[point].expect("invariant: every corner was numbered");
    let faces = cells.iter().map(|cell| [0, 1, 2].map(|corner| vertex(cell[corner]))).collect();
    Corners { vertex_count, faces }
}

fn nets<const P: usize>(
    points: &[DVec3],
    cells: &[[usize; P]],
) -> Result<FaceMap<BezierTriangle<DVec3, P>>, VtuReadError> {
    let order = node_order(BezierTriangle::<DVec3, P>::DEGREE);
    FaceMap::try_from_fn(cells.len(), |face: FaceId| {
        let cell = face.index();
        let mut net = [DVec3::ZERO; P];
        for (&rank, &point) in order.iter().zip(&cells[cell]) {
            let position = points[point];
            if !position.is_finite() {
                return Err(VtuReadError::NotFinite { cell, point, position });
            }
            net[rank] = position;
        }
        Ok(BezierTriangle::new(net))
    })
}

pub(super) fn cell_data(
    document: &Document<'_>,
) -> Result<(Vec<CellData>, Vec<String>), VtuReadError> {
    let mut kept = Vec::new();
    let mut skipped: Vec<_> = document.point_data.iter().map(|a| a.name.clone()).collect();
    for array in &document.cell_data {
        if !array.is_number() || array.components != 1 {
            skipped.push(array.name.clone());
            continue;
        }
        let values = numbers(array, document)?;
        check_count(array, "values", values.len(), document.cell_count)?;
        kept.push(CellData { name: array.name.clone(), values });
    }
    Ok((kept, skipped))
}

pub(super) fn numbers(
    array: &RawArray<'_>,
    document: &Document<'_>,
) -> Result<CellValues, VtuReadError> {
    if array.is_float() {
        array.floats(document).map(CellValues::Float64)
    } else {
        array.integers(document).map(CellValues::Int64)
    }
}
