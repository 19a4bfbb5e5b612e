//! What can be wrong with a patch surface or its file.

use std::io;

use basemesh::{FaceId, TopologyError};
use bezier_core::MultiIndex;
use glam::DVec3;
use thiserror::Error;

use crate::lattice::SharedPointError;

/// Why a patch surface was not written. Nothing was written before the error, except for
/// [`VtuWriteError::Io`].
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VtuWriteError {
    /// The operating system failed.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// There is not one patch per face.
    #[error("there are {patches} patches for {faces} faces")]
    PatchCount {
        /// Number of patches.
        patches: usize,
        /// Number of faces.
        faces: usize,
    },
    /// Two patches disagree about a point that is written once.
    #[error(transparent)]
    SharedPoint(#[from] SharedPointError),
    /// A coordinate is infinite or not a number.
    #[error(
        "point ({}, {}, {}) of face {face} is {position}, which is not finite",
        index.i, index.j, index.k
    )]
    NotFinite {
        /// The face.
        face: FaceId,
        /// The point in its patch.
        index: MultiIndex,
        /// The point.
        position: DVec3,
    },
    /// A name that XML or VTK cannot keep.
    #[error(
        "{name:?} cannot be the name of cell data; use at least one character, no control \
         characters, no space at the ends"
    )]
    CellDataName {
        /// The name.
        name: String,
    },
    /// The same name twice.
    #[error("there are two cell data with the name '{name}'")]
    CellDataTwice {
        /// The name.
        name: String,
    },
    /// There is not one value per patch, cell or point.
    #[error("the data '{name}' has {values} values for {cells} {of}")]
    CellDataCount {
        /// Name of the cell data.
        name: String,
        /// Number of values.
        values: usize,
        /// Number of elements.
        cells: usize,
        /// What the elements are.
        of: &'static str,
    },
    /// There is not one normal per point.
    #[error("there are {normals} normals for {points} points")]
    NormalCount {
        /// Number of normals.
        normals: usize,
        /// Number of points.
        points: usize,
    },
    /// A cell names a point that does not exist.
    #[error("cell {cell} uses point {point}, but there are only {count} points")]
    MissingPoint {
        /// The cell.
        cell: usize,
        /// The missing point.
        point: usize,
        /// Number of points.
        count: usize,
    },
    /// A coordinate of a grid is infinite or not a number.
    #[error("the {what} of point {point} is {value}, which is not finite")]
    PointNotFinite {
        /// The point.
        point: usize,
        /// Position or normal.
        what: &'static str,
        /// Its value.
        value: DVec3,
    },
    /// VTK cannot read this number as text.
    #[error("the data '{name}' is {value} at element {cell}; use the binary encoding")]
    CellDataNotFinite {
        /// Name of the cell data.
        name: String,
        /// The patch.
        cell: usize,
        /// Its value.
        value: f64,
    },
}

impl From<VtuWriteError> for io::Error {
    fn from(error: VtuWriteError) -> Self {
        match error {
            VtuWriteError::Io(cause) => cause,
            other => Self::new(io::ErrorKind::InvalidInput, other),
        }
    }
}

/// Why a file is not a patch surface. Cells, points and values count from 0, lines from 1.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VtuReadError {
    /// The operating system failed.
    #[error("cannot read: {0}")]
    Io(#[from] io::Error),
    /// Not well-formed XML in UTF-8.
    #[error("line {line}: {message}; the file is damaged or not a VTU file")]
    Xml {
        /// Line in the file.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// The file ends too early.
    #[error("the file ends inside <{element}>; it is truncated, so write it again")]
    Truncated {
        /// The innermost open element.
        element: String,
    },
    /// An element or attribute that must be there.
    #[error("there is no {what}; is this an unstructured grid of VTK?")]
    Missing {
        /// What is missing.
        what: &'static str,
    },
    /// An attribute with a value that makes no sense.
    #[error("the attribute {attribute}=\"{value}\" is not valid; expected {expected}")]
    Attribute {
        /// Name of the attribute.
        attribute: &'static str,
        /// Its value.
        value: String,
        /// What would be valid.
        expected: &'static str,
    },
    /// A legal file that is not read here.
    #[error("{what} not supported: re-save as {instead}")]
    Unsupported {
        /// What is not supported, with its verb.
        what: &'static str,
        /// How to save the file instead.
        instead: &'static str,
    },
    /// An array whose contents cannot be decoded.
    #[error("the array '{array}' {problem}")]
    Array {
        /// Name of the array.
        array: String,
        /// What is wrong with it.
        problem: String,
    },
    /// A cell that is not a patch, or not of the same kind as the first cell.
    #[error(
        "cell {cell} has type {found}; expected {expected} (76 is a Bézier triangle, 69 a Lagrange \
         triangle); extract the cells of one type first"
    )]
    CellType {
        /// The cell.
        cell: usize,
        /// Its type.
        found: i64,
        /// The type of the first cell, or both.
        expected: &'static str,
    },
    /// A cell of a grid that is no triangle or quadrilateral, flat or quadratic.
    #[error(
        "cell {cell} has type {vtk_type} and {points} points; expected 5 with 3 (triangle), 9 with \
         4 (quadrilateral), 22 with 6 or 23 with 8 (quadratic)"
    )]
    GridCell {
        /// The cell.
        cell: usize,
        /// Its type.
        vtk_type: i64,
        /// Its number of points.
        points: usize,
    },
    /// A cell of another degree.
    #[error(
        "cell {cell} has {points} points; expected {expected} (degree {degree}); read the file with \
         the degree it was written with"
    )]
    PointsPerCell {
        /// The cell.
        cell: usize,
        /// Its number of points, or a negative number if the offsets decrease.
        points: i64,
        /// Number of points of a patch of the degree asked for.
        expected: usize,
        /// The degree asked for.
        degree: usize,
    },
    /// A cell names a point that does not exist.
    #[error(
        "cell {cell} uses point {point}, but there are only {count} points; the file is damaged"
    )]
    MissingPoint {
        /// The cell.
        cell: usize,
        /// The missing point.
        point: i64,
        /// Number of points.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("cell {cell} uses point {point} at {position}, which is not finite; remove the cell")]
    NotFinite {
        /// The cell.
        cell: usize,
        /// The point.
        point: usize,
        /// Its position.
        position: DVec3,
    },
    /// Two cells share corners but not the points of the edge between them. Faces are cells.
    #[error(transparent)]
    SharedPoint(#[from] SharedPointError),
    /// The corners of the cells are not an oriented manifold. Faces are cells; vertices count the
    /// points that are corners, in the order of their ids.
    #[error("{0} (faces are cells; vertices are the corner points, in the order of their ids)")]
    Topology(#[from] TopologyError),
}
