//! Polygons as OFF (Object File Format), text variant.

use std::io::{self, Read};
use std::path::Path;

use glam::DVec3;
use thiserror::Error;

use crate::in_file::{InFile, parse_file};

/// Polygons of any size over numbered vertices, counted from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faces {
    /// Positions of the vertices.
    pub positions: Vec<DVec3>,
    /// The vertices of each face, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
}

/// Why an OFF file is not read. Lines count from 1, elements from 0 as in the format.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OffReadError {
    /// The operating system failed.
    #[error("cannot read: {0}")]
    Io(#[from] io::Error),
    /// The first word is not OFF.
    #[error("an OFF file begins with the word OFF, not with '{found}'")]
    Header {
        /// What stands there.
        found: String,
    },
    /// A word that is not a number of the kind that is needed.
    #[error("line {line}: '{text}' is not {expected}")]
    Number {
        /// Line in the file.
        line: usize,
        /// The word.
        text: String,
        /// What should be there.
        expected: &'static str,
    },
    /// The file ends too early, or a line is too short.
    #[error("line {line}: the line ends where {expected} should follow")]
    Short {
        /// Line in the file; the last one if the file ends.
        line: usize,
        /// What should be there.
        expected: &'static str,
    },
    /// A coordinate is infinite or not a number.
    #[error("line {line}: vertex {vertex} has the position {position}, which is not finite")]
    NotFinite {
        /// Line in the file.
        line: usize,
        /// The vertex.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// A face of fewer than three corners.
    #[error("line {line}: face {face} has {corners} corners; at least 3 are needed")]
    FewCorners {
        /// Line in the file.
        line: usize,
        /// The face.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("line {line}: face {face} uses vertex {vertex}, but there are only {count} vertices")]
    MissingVertex {
        /// Line in the file.
        line: usize,
        /// The face.
        face: usize,
        /// The vertex.
        vertex: usize,
        /// Number of vertices.
        count: usize,
    },
    /// No faces.
    #[error("there are no faces")]
    NoFaces,
}

/// Reads polygons of any size. Vertices keep their order and their bits, faces their order and first
/// corner; colours behind them are skipped, as are comments.
///
/// # Errors
///
/// [`OffReadError`] with the line.
pub fn read_off(input: &mut dyn Read) -> Result<Faces, OffReadError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    parse(&bytes)
}

/// Reads polygons of any size from a file; see [`read_off`].
///
/// # Errors
///
/// [`OffReadError`], with the path.
pub fn read_off_file(path: impl AsRef<Path>) -> Result<Faces, InFile<OffReadError>> {
    parse_file(path.as_ref(), parse)
}

/// A line with content: its number and its words.
type Line<'t> = (usize, Vec<&'t str>);

fn parse(bytes: &[u8]) -> Result<Faces, OffReadError> {
    let text = String::from_utf8_lossy(bytes);
    let content = |(number, line): (usize, &'_ str)| -> Option<(usize, Vec<String>)> {
        let words = line.split('#').next().unwrap_or_default().split_whitespace();
        let words: Vec<String> = words.map(str::to_owned).collect();
        (!words.is_empty()).then_some((number, words))
    };
    let lines: Vec<_> = (1..).zip(text.lines()).filter_map(content).collect();
    let mut lines: Vec<Line<'_>> =
        lines.iter().map(|(n, words)| (*n, words.iter().map(String::as_str).collect())).collect();
    header(&mut lines)?;
    let mut lines = lines.into_iter();
    let last = text.lines().count();
    let mut next =
        |expected: &'static str| lines.next().ok_or(OffReadError::Short { line: last, expected });
    let (line, words) = next("the numbers of vertices and faces")?;
    let [vertices, faces] = [0, 1].map(|k| count(line, &words, k, "a number of elements"));
    let (vertices, faces) = (vertices?, faces?);
    let mut read = Faces::default();
    for vertex in 0..vertices {
        let (line, words) = next("a vertex")?;
        read.positions.push(position(line, vertex, &words)?);
    }
    for face in 0..faces {
        let (line, words) = next("a face")?;
        read.faces.push(corners(line, face, &words, vertices)?);
    }
    if read.faces.is_empty() { Err(OffReadError::NoFaces) } else { Ok(read) }
}

/// Takes the word OFF away; the counts may stand on the same line.
fn header(lines: &mut Vec<Line<'_>>) -> Result<(), OffReadError> {
    let first = lines.first_mut().ok_or(OffReadError::NoFaces)?;
    if first.1[0] != "OFF" {
        return Err(OffReadError::Header { found: first.1[0].to_owned() });
    }
    first.1.remove(0);
    if first.1.is_empty() {
        lines.remove(0);
    }
    Ok(())
}

fn word<'t>(
    line: usize,
    words: &[&'t str],
    k: usize,
    expected: &'static str,
) -> Result<&'t str, OffReadError> {
    words.get(k).copied().ok_or(OffReadError::Short { line, expected })
}

fn count(
    line: usize,
    words: &[&str],
    k: usize,
    expected: &'static str,
) -> Result<usize, OffReadError> {
    let text = word(line, words, k, expected)?;
    text.parse().map_err(|_| OffReadError::Number { line, text: text.to_owned(), expected })
}

fn position(line: usize, vertex: usize, words: &[&str]) -> Result<DVec3, OffReadError> {
    let number = |k: usize| {
        let expected = "a coordinate";
        let text = word(line, words, k, expected)?;
        text.parse::<f64>().map_err(|_| OffReadError::Number {
            line,
            text: text.to_owned(),
            expected,
        })
    };
    let position = DVec3::new(number(0)?, number(1)?, number(2)?);
    if position.is_finite() {
        Ok(position)
    } else {
        Err(OffReadError::NotFinite { line, vertex, position })
    }
}

fn corners(
    line: usize,
    face: usize,
    words: &[&str],
    count_of_vertices: usize,
) -> Result<Vec<usize>, OffReadError> {
    let corners = count(line, words, 0, "a number of corners")?;
    if corners < 3 {
        return Err(OffReadError::FewCorners { line, face, corners });
    }
    if corners >= words.len() {
        return Err(OffReadError::Short { line, expected: "the number of a vertex" });
    }
    let vertices = (1..=corners).map(|k| count(line, words, k, "the number of a vertex"));
    let vertices = vertices.collect::<Result<Vec<_>, _>>()?;
    match vertices.iter().find(|&&v| v >= count_of_vertices) {
        Some(&vertex) => {
            let count = count_of_vertices;
            Err(OffReadError::MissingVertex { line, face, vertex, count })
        }
        None => Ok(vertices),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PYRAMID: &str = "OFF # a pyramid\n5 5 8\n1 1 0\n-1 1 0\n-1 -1 0\n1 -1 0\n\n0 0 1.5\n\
                           4 3 2 1 0\n3 0 1 4 0.1 0.2 0.3\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

    #[test]
    fn a_pyramid() {
        let faces = read_off(&mut PYRAMID.as_bytes()).expect("a solid");
        assert_eq!(faces.positions[4], DVec3::new(0.0, 0.0, 1.5));
        assert_eq!(faces.faces[0], [3, 2, 1, 0]);
        assert_eq!(faces.faces[1], [0, 1, 4], "the colour is skipped");
        let joined = PYRAMID.replace("OFF # a pyramid\n", "OFF ");
        assert_eq!(read_off(&mut joined.as_bytes()).expect("counts on the first line"), faces);
    }

    #[test]
    fn what_is_wrong_and_where() {
        for (from, to, message) in [
            ("OFF #", "PLY #", "an OFF file begins with the word OFF, not with 'PLY'"),
            ("-1 1 0", "-1 one 0", "line 4: 'one' is not a coordinate"),
            ("-1 1 0", "-1 inf 0", "line 4: vertex 1 has the position [-1, inf, 0], which is not"),
            ("3 1 2 4", "3 1 2 5", "line 11: face 2 uses vertex 5, but there are only 5 vertices"),
            ("3 1 2 4", "2 1 2", "line 11: face 2 has 2 corners"),
            ("3 1 2 4", "3 1 2", "line 11: the line ends where the number of a vertex"),
            ("3 3 0 4\n", "", "line 12: the line ends where a face should follow"),
            ("5 5 8", "5 0 0", "there are no faces"),
        ] {
            let text = PYRAMID.replacen(from, to, 1);
            let error = read_off(&mut text.as_bytes()).expect_err(to).to_string();
            assert!(error.starts_with(message), "{error}");
        }
    }
}
