//! STL, text and binary.

use glam::DVec3;

use super::error::MeshFileError;
use super::polygon_soup::PolygonSoup;

/// Bytes before the first triangle of a binary file: a title and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle: a normal, three corners, two bytes for nothing.
const RECORD: usize = 50;

/// Whether this is binary STL of the right length, or text that begins like it.
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    is_binary(bytes) || looks_like_text(bytes)
}

fn announced(bytes: &[u8]) -> Option<u32> {
    bytes.get(80..HEADER)?.try_into().ok().map(u32::from_le_bytes)
}

/// Titles of binary files may begin with "solid" too, so that the length decides.
fn is_binary(bytes: &[u8]) -> bool {
    announced(bytes)
        .is_some_and(|count| bytes.len() as u64 == HEADER as u64 + u64::from(count) * RECORD as u64)
}

fn looks_like_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1024)];
    let text = String::from_utf8_lossy(start);
    let mut words = text.split_whitespace();
    words.next().is_some_and(|word| word.eq_ignore_ascii_case("solid"))
        && text.to_ascii_lowercase().contains("facet")
}

/// Triangles without common vertices.
pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, MeshFileError> {
    let positions =
        if !is_binary(bytes) && looks_like_text(bytes) { text(bytes) } else { binary(bytes) }?;
    let faces = (0..positions.len() / 3).map(|t| vec![3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Ok(PolygonSoup { positions, faces, ..PolygonSoup::default() })
}

fn binary(bytes: &[u8]) -> Result<Vec<DVec3>, MeshFileError> {
    let short = |found| MeshFileError::StlShort { triangles: announced(bytes).unwrap_or(0), found };
    let triangles = announced(bytes).ok_or(short(0))? as usize;
    let (records, _) = bytes[HEADER..].as_chunks::<RECORD>();
    if records.len() < triangles {
        return Err(short(records.len()));
    }
    let mut positions = Vec::with_capacity(3 * triangles);
    for record in &records[..triangles] {
        let (numbers, _) = record[12..48].as_chunks::<4>();
        let numbers: Vec<f64> = numbers.iter().map(|b| f64::from(f32::from_le_bytes(*b))).collect();
        positions.extend(numbers.chunks_exact(3).map(DVec3::from_slice));
    }
    Ok(positions)
}

/// The words of a text file with their lines.
struct Words<'t>(Box<dyn Iterator<Item = (usize, &'t str)> + 't>);

impl<'t> Words<'t> {
    fn next(&mut self, expected: &'static str) -> Result<(usize, &'t str), MeshFileError> {
        self.0.next().ok_or(MeshFileError::StlEnd { expected })
    }

    fn keyword(&mut self, expected: &'static str) -> Result<(), MeshFileError> {
        let (line, word) = self.next(expected)?;
        if word.eq_ignore_ascii_case(expected) {
            return Ok(());
        }
        Err(MeshFileError::StlText { line, expected, found: word.to_owned() })
    }

    fn point(&mut self, expected: &'static str) -> Result<DVec3, MeshFileError> {
        let mut point = DVec3::ZERO;
        for axis in 0..3 {
            let (line, word) = self.next(expected)?;
            let found = || MeshFileError::StlText { line, expected, found: word.to_owned() };
            point[axis] = word.parse().map_err(|_| found())?;
        }
        Ok(point)
    }
}

fn text(bytes: &[u8]) -> Result<Vec<DVec3>, MeshFileError> {
    let text = String::from_utf8_lossy(bytes);
    let content = (1..).zip(text.lines()).filter(|(_, line)| {
        // names of solids may consist of any words
        let first = line.split_whitespace().next().unwrap_or_default();
        !first.eq_ignore_ascii_case("solid") && !first.eq_ignore_ascii_case("endsolid")
    });
    let mut words = Words(Box::new(
        content.flat_map(|(number, line)| line.split_whitespace().map(move |word| (number, word))),
    ));
    let mut positions = Vec::new();
    while let Some((line, word)) = words.0.next() {
        if !word.eq_ignore_ascii_case("facet") {
            let found = word.to_owned();
            return Err(MeshFileError::StlText { line, expected: "facet", found });
        }
        words.keyword("normal")?;
        words.point("a number of the normal")?;
        words.keyword("outer")?;
        words.keyword("loop")?;
        for _ in 0..3 {
            words.keyword("vertex")?;
            positions.push(words.point("a coordinate")?);
        }
        words.keyword("endloop")?;
        words.keyword("endfacet")?;
    }
    Ok(positions)
}
