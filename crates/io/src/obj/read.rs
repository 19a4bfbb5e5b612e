//! Reading triangle meshes.
//!
//! Coordinates are parsed as f64 and rounded once, so a file written with shortest round-trip digits
//! comes back bit for bit.

use std::io::Read;
use std::path::Path;
use std::str::SplitWhitespace;

use basemesh::{MeshError, TopologyError, TriMesh};
use glam::DVec3;

use super::error::ObjReadError;
use super::statements::{
    CornerIndices, Statement, corner, for_each_statement, from_one, position, resolve,
};
use crate::in_file::{InFile, parse_file};

/// Reads a triangle mesh.
///
/// Vertices keep their order and their bits, faces keep their order and first corner. Texture
/// coordinates, normals, groups, materials, lines and points are skipped; polygons with more than
/// three corners, free-form surfaces and unknown statements are refused. Both kinds of line ends,
/// comments, continued lines and negative indices are understood.
///
/// # Errors
///
/// [`ObjReadError`] with the line and the first offending element.
pub fn read_obj(input: &mut dyn Read) -> Result<TriMesh, ObjReadError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    parse(&bytes)
}

/// Reads a triangle mesh from a file; see [`read_obj`].
///
/// # Errors
///
/// [`ObjReadError`], with the path.
pub fn read_obj_file(path: impl AsRef<Path>) -> Result<TriMesh, InFile<ObjReadError>> {
    parse_file(path.as_ref(), parse)
}

fn parse(bytes: &[u8]) -> Result<TriMesh, ObjReadError> {
    let mut parser = Parser::default();
    for_each_statement(bytes, |line, statement| match statement {
        Statement::Vertex(words) => parser.vertex(line, words),
        Statement::Normal(_) | Statement::Group(_) => Ok(()),
        Statement::Face(words) => parser.face(line, words),
    })?;
    parser.finish()
}

#[derive(Default)]
struct Parser {
    positions: Vec<DVec3>,
    position_lines: Vec<usize>,
    faces: Vec<[usize; 3]>,
    face_lines: Vec<usize>,
}

impl Parser {
    fn vertex(&mut self, line: usize, words: SplitWhitespace<'_>) -> Result<(), ObjReadError> {
        self.positions.push(position(line, self.positions.len() + 1, words)?);
        self.position_lines.push(line);
        Ok(())
    }

    fn face(&mut self, line: usize, words: SplitWhitespace<'_>) -> Result<(), ObjReadError> {
        let corners = words.map(|word| self.corner(line, word)).collect::<Result<Vec<_>, _>>()?;
        let face = self.faces.len() + 1;
        let Ok(triangle) = <[usize; 3]>::try_from(corners.as_slice()) else {
            return Err(ObjReadError::NotATriangle { line, face, corners: corners.len() });
        };
        self.faces.push(triangle);
        self.face_lines.push(line);
        Ok(())
    }

    /// The vertex of a corner, from 0.
    fn corner(&self, line: usize, text: &str) -> Result<usize, ObjReadError> {
        let CornerIndices { vertex: index, .. } = corner(line, text)?;
        let (face, count) = (self.faces.len() + 1, self.positions.len());
        resolve(index, count).ok_or(ObjReadError::MissingVertex { line, face, index, count })
    }

    fn finish(self) -> Result<TriMesh, ObjReadError> {
        if self.faces.is_empty() {
            return Err(ObjReadError::NoFaces);
        }
        let count = self.positions.len();
        for (face, corners) in self.faces.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex >= count) {
                let (line, index) = (self.face_lines[face], from_one(vertex));
                return Err(ObjReadError::MissingVertex { line, face: face + 1, index, count });
            }
        }
        let Self { positions, position_lines, faces, face_lines } = self;
        TriMesh::new(positions, &faces).map_err(|error| match error {
            MeshError::Topology(cause) => {
                let line = line_of(&cause, &faces, &face_lines, &position_lines);
                ObjReadError::Topology { line, cause }
            }
            other => ObjReadError::Mesh(other),
        })
    }
}

/// The line of the element that an error is about; of the first such face if there are several.
fn line_of(
    error: &TopologyError,
    faces: &[[usize; 3]],
    face_lines: &[usize],
    position_lines: &[usize],
) -> usize {
    match *error {
        TopologyError::MissingVertex { face, .. }
        | TopologyError::DegenerateFace { face, .. }
        | TopologyError::InconsistentOrientation { first: face, .. } => face_lines[face],
        TopologyError::NonManifoldEdge { a, b, .. } => faces
            .iter()
            .position(|corners| corners.contains(&a) && corners.contains(&b))
            .map_or(1, |face| face_lines[face]),
        TopologyError::IsolatedVertex { vertex } | TopologyError::NonManifoldVertex { vertex } => {
            position_lines[vertex]
        }
        _ => 1,
    }
}
