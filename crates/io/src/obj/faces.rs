//! Reading faces of any size, without normals.

use std::io::Read;
use std::path::Path;

use super::error::ObjReadError;
use super::statements::{Statement, corner, for_each_statement, from_one, position, resolve};
use crate::in_file::{InFile, parse_file};
use crate::off::Faces;

/// Reads faces of any number of corners, such as those of solids. Normals and texture coordinates are
/// skipped, and a face may use a vertex several times, as where a cut leads to a hole.
///
/// # Errors
///
/// [`ObjReadError`] with the line and the first offending element.
pub fn read_faces(input: &mut dyn Read) -> Result<Faces, ObjReadError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    parse(&bytes)
}

/// Reads faces of any number of corners from a file; see [`read_faces`].
///
/// # Errors
///
/// [`ObjReadError`], with the path.
pub fn read_faces_file(path: impl AsRef<Path>) -> Result<Faces, InFile<ObjReadError>> {
    parse_file(path.as_ref(), parse)
}

fn parse(bytes: &[u8]) -> Result<Faces, ObjReadError> {
    let mut read = Faces::default();
    let mut lines = Vec::new();
    for_each_statement(bytes, |line, statement| {
        match statement {
            Statement::Vertex(words) => {
                read.positions.push(position(line, read.positions.len() + 1, words)?);
            }
            Statement::Normal(_) | Statement::Group(_) => {}
            Statement::Face(words) => {
                let (face, count) = (read.faces.len() + 1, read.positions.len());
                let vertex = |text| {
                    let index = corner(line, text)?.vertex;
                    let missing = ObjReadError::MissingVertex { line, face, index, count };
                    resolve(index, count).ok_or(missing)
                };
                let corners = words.map(vertex).collect::<Result<Vec<_>, _>>()?;
                if corners.len() < 3 {
                    let corners = corners.len();
                    return Err(ObjReadError::NotAPolygon { line, face, corners });
                }
                read.faces.push(corners);
                lines.push(line);
            }
        }
        Ok(())
    })?;
    if read.faces.is_empty() {
        return Err(ObjReadError::NoFaces);
    }
    // positive indices may be those of vertices that follow
    let count = read.positions.len();
    for (face, (corners, &line)) in read.faces.iter().zip(&lines).enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v >= count) {
            let (face, index) = (face + 1, from_one(vertex));
            return Err(ObjReadError::MissingVertex { line, face, index, count });
        }
    }
    Ok(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pentagon_and_what_is_wrong() {
        let text =
            "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1 5//1\nv 0 1 0\n";
        let faces = read_faces(&mut text.as_bytes()).expect("a face");
        assert_eq!((faces.positions.len(), &faces.faces[0]), (5, &vec![0, 1, 2, 3, 4]));
        for (from, to, message) in [
            ("5//1", "7//1", "line 6: face 1 uses vertex 7, but there are only 5 vertices"),
            (" 3//1 4//1 5//1", "", "line 6: face 1 has 2 corners"),
            ("f ", "p ", "there are no faces"),
        ] {
            let error = read_faces(&mut text.replace(from, to).as_bytes()).expect_err(to);
            assert!(error.to_string().starts_with(message), "{error}");
        }
    }
}
