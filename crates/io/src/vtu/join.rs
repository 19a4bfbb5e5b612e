//! Several `.vtu` files as one surface (`.pvtu`), which names them and holds no numbers.

use std::io::{self, Write};
use std::path::Path;

use quick_xml::escape::escape;
use thiserror::Error;

use super::document::{Document, RawArray};
use super::error::VtuReadError;
use super::read::document;
use crate::in_file::{InFile, parse_file};

/// What a `.pvtu` file says about one of its pieces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VtuPiece {
    /// Number of points.
    pub points: usize,
    /// Number of cells.
    pub cells: usize,
    point_type: PieceArray,
    point_data: Vec<PieceArray>,
    cell_data: Vec<PieceArray>,
}

/// The head of an array.
#[derive(Clone, Debug, PartialEq, Eq)]
struct PieceArray {
    name: String,
    type_name: String,
    components: usize,
}

/// Why pieces were not joined. Nothing was written before the error, except for [`JoinError::Io`].
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum JoinError {
    /// The operating system failed.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// Nothing to join.
    #[error("there are no pieces to join")]
    NoPieces,
    /// Pieces have different arrays.
    #[error(
        "{piece} has {found} as {what} where {first} has {expected}; write all pieces in the same way"
    )]
    Arrays {
        /// The piece.
        piece: String,
        /// The first piece.
        first: String,
        /// Points, point data or cell data.
        what: &'static str,
        /// The arrays of the piece.
        found: String,
        /// The arrays of the first piece.
        expected: String,
    },
}

impl From<JoinError> for io::Error {
    fn from(error: JoinError) -> Self {
        match error {
            JoinError::Io(cause) => cause,
            other => Self::new(io::ErrorKind::InvalidInput, other),
        }
    }
}

/// Reads what joining needs to know about a piece.
///
/// # Errors
///
/// [`VtuReadError`], with the path, if it is no `.vtu` file with one piece.
pub fn read_piece_file(path: impl AsRef<Path>) -> Result<VtuPiece, InFile<VtuReadError>> {
    parse_file(path.as_ref(), |bytes| VtuPiece::new(&document(bytes)?))
}

impl VtuPiece {
    fn new(document: &Document<'_>) -> Result<Self, VtuReadError> {
        let heads = |arrays: &[RawArray<'_>]| arrays.iter().map(PieceArray::new).collect();
        let points = document.points.first();
        let points = points.ok_or(VtuReadError::Missing { what: "array in <Points>" })?;
        Ok(Self {
            points: document.point_count,
            cells: document.cell_count,
            point_type: PieceArray::new(points),
            point_data: heads(&document.point_data),
            cell_data: heads(&document.cell_data),
        })
    }
}

impl PieceArray {
    fn new(array: &RawArray<'_>) -> Self {
        let RawArray { name, type_name, components, .. } = array;
        Self { name: name.clone(), type_name: type_name.clone(), components: *components }
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let Self { name, type_name, components } = self;
        let (name, type_name) = (escape(name), escape(type_name));
        writeln!(
            out,
            r#"<PDataArray type="{type_name}" Name="{name}" NumberOfComponents="{components}"/>"#
        )
    }
}

/// Writes the file that joins pieces, each with its path relative to that file.
///
/// Points of different pieces are not the same point, whatever their positions: readers show the
/// surface as one, and merge points when they are asked to.
///
/// # Errors
///
/// [`JoinError`] if the pieces do not have the same arrays.
pub fn write_pvtu(out: &mut dyn Write, pieces: &[(String, VtuPiece)]) -> Result<(), JoinError> {
    let [(first, head), ..] = pieces else { return Err(JoinError::NoPieces) };
    for (piece, other) in pieces {
        let sections = [
            ("points", vec![head.point_type.clone()], vec![other.point_type.clone()]),
            ("point data", head.point_data.clone(), other.point_data.clone()),
            ("cell data", head.cell_data.clone(), other.cell_data.clone()),
        ];
        for (what, expected, found) in sections {
            if found != expected {
                let (piece, first) = (piece.clone(), first.clone());
                let (found, expected) = (listed(&found), listed(&expected));
                return Err(JoinError::Arrays { piece, first, what, found, expected });
            }
        }
    }
    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(
        out,
        r#"<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#
    )?;
    writeln!(out, r#"<PUnstructuredGrid GhostLevel="0">"#)?;
    let point_type = [head.point_type.clone()];
    let sections: [(&str, &[PieceArray]); 3] = [
        ("PPointData", &head.point_data),
        ("PCellData", &head.cell_data),
        ("PPoints", &point_type),
    ];
    for (section, arrays) in sections {
        writeln!(out, "<{section}>")?;
        arrays.iter().try_for_each(|array| array.write(out))?;
        writeln!(out, "</{section}>")?;
    }
    for (path, _) in pieces {
        writeln!(out, r#"<Piece Source="{}"/>"#, escape(path))?;
    }
    Ok(writeln!(out, "</PUnstructuredGrid>\n</VTKFile>")?)
}

fn listed(arrays: &[PieceArray]) -> String {
    if arrays.is_empty() {
        return "nothing".into();
    }
    let shown = |array: &PieceArray| {
        let PieceArray { name, type_name, components } = array;
        format!("'{name}' ({type_name}, {components} each)")
    };
    arrays.iter().map(shown).collect::<Vec<_>>().join(", ")
}
