//! Patch surfaces as VTK unstructured grids (`.vtu`), exact in both directions.
//!
//! Each patch is one cell: a Bézier triangle (type 76) whose points are the control points, or a
//! Lagrange triangle (type 69) whose points interpolate the patch at the regular lattice.

mod appended;
mod array;
mod decode;
mod document;
mod error;
mod grid;
mod interpolation;
mod join;
mod read;
mod write;

use basemesh::{FaceMap, Topology};
use bezier_core::BezierTriangle;
use glam::DVec3;

pub use error::{VtuReadError, VtuWriteError};
pub use grid::{Grid, GridCell, read_grid, read_grid_file, write_grid};
pub use join::{JoinError, VtuPiece, read_piece_file, write_pvtu};
pub use read::{read_vtu, read_vtu_file};
pub use write::write_vtu;

/// How patches are represented.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellKind {
    /// `VTK_BEZIER_TRIANGLE`: control points, exact. ParaView 5.8 or later.
    #[default]
    Bezier,
    /// `VTK_LAGRANGE_TRIANGLE`: points on the patch at the regular lattice, exact up to rounding.
    Lagrange,
}

impl CellKind {
    const ALL: [Self; 2] = [Self::Bezier, Self::Lagrange];

    /// The cell type number of VTK.
    #[must_use]
    pub const fn vtk_type(self) -> u8 {
        match self {
            Self::Bezier => 76,
            Self::Lagrange => 69,
        }
    }
}

/// How numbers are written. All keep every bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Base64 of little-endian numbers inside the XML, without compression.
    #[default]
    Binary,
    /// The bytes of little-endian numbers as they are, behind the XML: a quarter shorter. The file is
    /// no text any more.
    Appended,
    /// Decimal digits, the shortest that give the same number back.
    Ascii,
}

/// One number for each patch, in face order; in a [`Grid`] for each cell or point.
#[derive(Clone, Debug, PartialEq)]
pub struct CellData {
    /// Name under which viewers offer the numbers.
    pub name: String,
    /// The numbers.
    pub values: CellValues,
}

/// The numbers of a [`CellData`].
#[derive(Clone, Debug, PartialEq)]
pub enum CellValues {
    /// Measured quantities. NaN and infinities not with [`Encoding::Ascii`].
    Float64(Vec<f64>),
    /// Counts and ids.
    Int64(Vec<i64>),
}

impl CellValues {
    /// Number of values.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Float64(values) => values.len(),
            Self::Int64(values) => values.len(),
        }
    }

    /// No values at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// What to write.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VtuOptions {
    /// How patches are represented.
    pub cells: CellKind,
    /// How numbers are written.
    pub encoding: Encoding,
    /// Numbers to write beside the patches.
    pub cell_data: Vec<CellData>,
}

/// The contents of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct VtuSurface<const P: usize> {
    /// Connectivity of the patch corners. Vertices are numbered in the order of their point ids.
    pub topology: Topology,
    /// One patch per face, in cell order.
    pub nets: FaceMap<BezierTriangle<DVec3, P>>,
    /// Numbers given for each patch.
    pub cell_data: Vec<CellData>,
    /// Names of arrays that are neither one number for each patch nor part of the geometry, and
    /// were left out.
    pub skipped: Vec<String>,
}
