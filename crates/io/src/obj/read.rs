//! Reading the polygonal part of OBJ.
//!
//! Coordinates are parsed as f64 and rounded once, so a file written with shortest round-trip digits
//! comes back bit for bit.

use std::io::Read;
use std::path::Path;

use basemesh::{MeshError, TopologyError, TriMesh};
use glam::DVec3;

use super::error::ObjReadError;
use crate::in_file::{InFile, parse_file};

/// Statements that say nothing about the triangles of a mesh.
const SKIPPED: [&str; 20] = [
    "vt",
    "vn",
    "vp",
    "g",
    "o",
    "s",
    "mg",
    "l",
    "p",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "call",
];

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
    // names and comments may be in any encoding; statements are ASCII
    let text = String::from_utf8_lossy(bytes);
    let mut parser = Parser::default();
    let mut statement = String::new();
    let mut first_line = None;
    for (number, line) in (1..).zip(text.lines()) {
        let line_number = *first_line.get_or_insert(number);
        if let Some(continued) = line.strip_suffix('\\') {
            statement.push_str(continued);
            statement.push(' ');
            continue;
        }
        statement.push_str(line);
        parser.statement(line_number, &statement)?;
        statement.clear();
        first_line = None;
    }
    if let Some(line) = first_line {
        parser.statement(line, &statement)?;
    }
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
    fn statement(&mut self, line: usize, text: &str) -> Result<(), ObjReadError> {
        let text = text.split_once('#').map_or(text, |(before, _)| before);
        let mut words = text.split_whitespace();
        match words.next() {
            None => Ok(()),
            Some("v") => self.vertex(line, words),
            Some("f") => self.face(line, words),
            Some(skipped) if SKIPPED.contains(&skipped) => Ok(()),
            Some(other) => Err(ObjReadError::Statement { line, keyword: other.to_owned() }),
        }
    }

    fn vertex<'t>(
        &mut self,
        line: usize,
        words: impl Iterator<Item = &'t str>,
    ) -> Result<(), ObjReadError> {
        let number = |text: &str| {
            let text = text.to_owned();
            text.parse::<f64>().map_err(|_| ObjReadError::Number { line, text })
        };
        let numbers = words.map(number).collect::<Result<Vec<_>, _>>()?;
        let count = numbers.len();
        if !matches!(count, 3 | 4 | 6 | 7) {
            return Err(ObjReadError::CoordinateCount { line, count });
        }
        let position = DVec3::new(numbers[0], numbers[1], numbers[2]);
        if !position.is_finite() {
            let vertex = self.positions.len() + 1;
            return Err(ObjReadError::NotFinite { line, vertex, position });
        }
        self.positions.push(position);
        self.position_lines.push(line);
        Ok(())
    }

    fn face<'t>(
        &mut self,
        line: usize,
        words: impl Iterator<Item = &'t str>,
    ) -> Result<(), ObjReadError> {
        let corners = words.map(|word| self.corner(line, word)).collect::<Result<Vec<_>, _>>()?;
        let face = self.faces.len() + 1;
        let Ok(triangle) = <[usize; 3]>::try_from(corners.as_slice()) else {
            return Err(ObjReadError::NotATriangle { line, face, corners: corners.len() });
        };
        self.faces.push(triangle);
        self.face_lines.push(line);
        Ok(())
    }

    /// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`, from 0.
    fn corner(&self, line: usize, text: &str) -> Result<usize, ObjReadError> {
        let malformed = || ObjReadError::Corner { line, text: text.to_owned() };
        let mut parts = text.split('/');
        let index = parts.next().and_then(nonzero).ok_or_else(malformed)?;
        let others: Vec<&str> = parts.collect();
        // one part may be empty: `v//vn`
        let well_formed = match *others.as_slice() {
            [] => true,
            [texture] => nonzero(texture).is_some(),
            ["", normal] => nonzero(normal).is_some(),
            [texture, normal] => nonzero(texture).and(nonzero(normal)).is_some(),
            _ => false,
        };
        if !well_formed {
            return Err(malformed());
        }
        let count = self.positions.len();
        let missing =
            || ObjReadError::MissingVertex { line, face: self.faces.len() + 1, index, count };
        let magnitude = usize::try_from(index.unsigned_abs()).map_err(|_| missing())?;
        if index > 0 {
            return Ok(magnitude - 1);
        }
        count.checked_sub(magnitude).ok_or_else(missing)
    }

    fn finish(self) -> Result<TriMesh, ObjReadError> {
        if self.faces.is_empty() {
            return Err(ObjReadError::NoFaces);
        }
        let count = self.positions.len();
        for (face, corners) in self.faces.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex >= count) {
                let index = i64::try_from(vertex).unwrap_or(i64::MAX).saturating_add(1);
                let line = self.face_lines[face];
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

fn nonzero(text: &str) -> Option<i64> {
    text.parse().ok().filter(|&index| index != 0)
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
