//! Why triangles were not written.

use std::io;

use glam::DVec3;
use thiserror::Error;

/// Why triangles were not written. Nothing was written before the error, except for
/// [`TrianglesError::Io`]. Triangles count from 0.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TrianglesError {
    /// The operating system failed.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// There are not three normals for each triangle.
    #[error("there are normals of {normals} triangles for {triangles} triangles")]
    NormalCount {
        /// Number of triangles.
        triangles: usize,
        /// Number of triangles with normals.
        normals: usize,
    },
    /// A triangle names something that does not exist.
    #[error("triangle {triangle} uses {what} {id}, which does not exist")]
    Missing {
        /// The triangle.
        triangle: usize,
        /// Position or normal.
        what: &'static str,
        /// Its number, from 0.
        id: usize,
    },
    /// A number is infinite or not a number.
    #[error("triangle {triangle} has the {what} {value}, which is not finite")]
    NotFinite {
        /// The triangle.
        triangle: usize,
        /// Position or normal.
        what: &'static str,
        /// Its value.
        value: DVec3,
    },
    /// A coordinate that the format cannot hold.
    #[error(
        "triangle {triangle} has the position {value}, too large for the 32 bits of the format"
    )]
    TooLarge {
        /// The triangle.
        triangle: usize,
        /// The position.
        value: DVec3,
    },
    /// More triangles or points than a 32-bit number counts.
    #[error("there are more points or triangles than the format can count; write them in parts")]
    TooMany,
    /// No triangles at all, in a format that wants some.
    #[error("there are no triangles to write")]
    Empty,
}

impl From<TrianglesError> for io::Error {
    fn from(error: TrianglesError) -> Self {
        match error {
            TrianglesError::Io(cause) => cause,
            other => Self::new(io::ErrorKind::InvalidInput, other),
        }
    }
}
