//! What can be wrong with an OBJ file.

use std::io;

use basemesh::{MeshError, TopologyError};
use glam::DVec3;
use thiserror::Error;

/// Why an OBJ file is not a mesh. Lines, and indices that stand in the file, count from 1.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ObjReadError {
    /// The operating system failed.
    #[error("cannot read: {0}")]
    Io(#[from] io::Error),
    /// A statement that a mesh reader must not skip, or no OBJ statement at all.
    #[error(
        "line {line}: the statement '{keyword}' is not supported; a mesh consists of 'v' and 'f'"
    )]
    Statement {
        /// Line in the file.
        line: usize,
        /// First word of the line.
        keyword: String,
    },
    /// Something that should be a number.
    #[error("line {line}: '{text}' is not a number")]
    Number {
        /// Line in the file.
        line: usize,
        /// The word.
        text: String,
    },
    /// A vertex with too few or too many numbers.
    #[error("line {line}: a vertex has 3 coordinates (4 with weight, 6 with colour), not {count}")]
    CoordinateCount {
        /// Line in the file.
        line: usize,
        /// Numbers given.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("line {line}: vertex {vertex} has the position {position}, which is not finite")]
    NotFinite {
        /// Line in the file.
        line: usize,
        /// The vertex, from 1.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// A corner of a face that is not `v`, `v/vt`, `v//vn` or `v/vt/vn` with integers except 0.
    #[error(
        "line {line}: '{text}' is not a corner; expected v, v/vt, v//vn or v/vt/vn with integers \
         that are not zero"
    )]
    Corner {
        /// Line in the file.
        line: usize,
        /// The word.
        text: String,
    },
    /// A face names a vertex that does not exist.
    #[error("line {line}: face {face} uses vertex {index}, but there are only {count} vertices")]
    MissingVertex {
        /// Line in the file.
        line: usize,
        /// The face, from 1.
        face: usize,
        /// The vertex as written: from 1, or negative and relative to the last one.
        index: i64,
        /// Vertices in the file, or so far for a negative index.
        count: usize,
    },
    /// A face that is not a triangle.
    #[error(
        "line {line}: face {face} has {corners} corners; only triangles are read, so triangulate \
         the mesh before exporting it"
    )]
    NotATriangle {
        /// Line in the file.
        line: usize,
        /// The face, from 1.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// A face with fewer than three corners, or with more than are read.
    #[error(
        "line {line}: face {face} has {corners} corners; only triangles and quadrilaterals are \
         read, so split the faces before"
    )]
    NotAPolygon {
        /// Line in the file.
        line: usize,
        /// The face, from 1.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// A face uses a vertex twice.
    #[error("line {line}: face {face} uses vertex {vertex} more than once; remove or repair it")]
    RepeatedVertex {
        /// Line in the file.
        line: usize,
        /// The face, from 1.
        face: usize,
        /// The vertex, from 1.
        vertex: usize,
    },
    /// A normal that is not made of three finite numbers.
    #[error("line {line}: a normal has 3 finite numbers")]
    Normal {
        /// Line in the file.
        line: usize,
    },
    /// A corner names a normal that does not exist.
    #[error("line {line}: face {face} uses normal {index}, but there are only {count} normals")]
    MissingNormal {
        /// Line in the file.
        line: usize,
        /// The face, from 1.
        face: usize,
        /// The normal as written: from 1, or negative and relative to the last one.
        index: i64,
        /// Normals in the file, or so far for a negative index.
        count: usize,
    },
    /// No face in the whole file.
    #[error("there are no faces; is this an OBJ file?")]
    NoFaces,
    /// The faces are not an oriented manifold.
    #[error("line {line}: {cause} (vertices and faces counted from 0, in file order)")]
    Topology {
        /// Line of the face or vertex concerned.
        line: usize,
        /// What is wrong; its ids count from 0.
        cause: TopologyError,
    },
    /// Anything else that a mesh refuses; its ids count from 0.
    #[error("{0} (counted from 0, in file order)")]
    Mesh(MeshError),
}

/// Why an OBJ file was not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ObjWriteError {
    /// The operating system failed.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// A coordinate or normal is infinite or not a number.
    #[error("point {point} has the {what} {value}, which is not finite")]
    NotFinite {
        /// The point, from 0.
        point: usize,
        /// Position or normal.
        what: &'static str,
        /// Its value.
        value: DVec3,
    },
    /// There is not one normal per position.
    #[error("there are {positions} positions but {normals} normals")]
    NormalCount {
        /// Number of positions.
        positions: usize,
        /// Number of normals.
        normals: usize,
    },
}

impl From<ObjWriteError> for io::Error {
    fn from(error: ObjWriteError) -> Self {
        match error {
            ObjWriteError::Io(cause) => cause,
            other => Self::new(io::ErrorKind::InvalidInput, other),
        }
    }
}
