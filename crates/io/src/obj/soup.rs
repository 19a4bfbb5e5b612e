//! Reading faces of any size with normals and groups.

use std::str::SplitWhitespace;

use glam::DVec3;

use super::error::ObjReadError;
use super::statements::{
    CornerIndices, Statement, corner, for_each_statement, from_one, numbers, position, resolve,
};
use crate::mesh_file::PolygonSoup;

/// Faces of any number of corners with the normals and groups of the file. A group is what follows `g`
/// or `o`.
///
/// # Errors
///
/// [`ObjReadError`] with the line and the first offending element.
pub(crate) fn read_soup(bytes: &[u8]) -> Result<PolygonSoup, ObjReadError> {
    let mut reader = Reader::default();
    for_each_statement(bytes, |line, statement| match statement {
        Statement::Vertex(words) => {
            let vertex = reader.soup.positions.len() + 1;
            reader.soup.positions.push(position(line, vertex, words)?);
            Ok(())
        }
        Statement::Normal(words) => {
            let normal = <[f64; 3]>::try_from(numbers(line, words)?).ok().map(DVec3::from_array);
            reader.normals.push(normal.ok_or(ObjReadError::Normal { line })?);
            Ok(())
        }
        Statement::Group(words) => {
            reader.group(words);
            Ok(())
        }
        Statement::Face(words) => reader.face(line, words),
    })?;
    reader.finish()
}

#[derive(Default)]
struct Reader {
    soup: PolygonSoup,
    normals: Vec<DVec3>,
    corners: Vec<Vec<CornerIndices>>,
    lines: Vec<usize>,
    group: usize,
}

impl Reader {
    fn group(&mut self, words: SplitWhitespace<'_>) {
        let name = words.collect::<Vec<_>>().join(" ");
        let groups = &mut self.soup.groups;
        self.group = groups.iter().position(|known| *known == name).unwrap_or_else(|| {
            groups.push(name);
            groups.len() - 1
        });
    }

    fn face(&mut self, line: usize, words: SplitWhitespace<'_>) -> Result<(), ObjReadError> {
        let face = self.lines.len() + 1;
        let (vertices, normals) = (self.soup.positions.len(), self.normals.len());
        // relative indices count from here
        let absolute = |text: &str| -> Result<CornerIndices, ObjReadError> {
            let CornerIndices { vertex: index, normal } = corner(line, text)?;
            let missing = ObjReadError::MissingVertex { line, face, index, count: vertices };
            let vertex = from_one(resolve(index, vertices).ok_or(missing)?);
            let normal = normal.map(|index| {
                let missing = ObjReadError::MissingNormal { line, face, index, count: normals };
                resolve(index, normals).map(from_one).ok_or(missing)
            });
            Ok(CornerIndices { vertex, normal: normal.transpose()? })
        };
        let corners = words.map(absolute).collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            return Err(ObjReadError::NotAPolygon { line, face, corners: corners.len() });
        }
        if self.soup.groups.is_empty() {
            self.soup.groups.push(String::new());
        }
        self.soup.group_of.push(self.group);
        self.corners.push(corners);
        self.lines.push(line);
        Ok(())
    }

    /// Looks the corners up, which may be vertices and normals that follow their faces.
    fn finish(mut self) -> Result<PolygonSoup, ObjReadError> {
        if self.lines.is_empty() {
            return Err(ObjReadError::NoFaces);
        }
        let has_normals = self.corners.iter().flatten().any(|corner| corner.normal.is_some());
        for (k, (corners, &line)) in self.corners.iter().zip(&self.lines).enumerate() {
            let face = k + 1;
            let count = self.soup.positions.len();
            let vertex = |corner: &CornerIndices| {
                let missing =
                    ObjReadError::MissingVertex { line, face, index: corner.vertex, count };
                resolve(corner.vertex, count).filter(|&v| v < count).ok_or(missing)
            };
            self.soup.faces.push(corners.iter().map(vertex).collect::<Result<_, _>>()?);
            let count = self.normals.len();
            let normal = |corner: &CornerIndices| -> Result<Option<DVec3>, ObjReadError> {
                let Some(index) = corner.normal else { return Ok(None) };
                let missing = ObjReadError::MissingNormal { line, face, index, count };
                let at = resolve(index, count).filter(|&n| n < count).ok_or(missing)?;
                Ok(Some(self.normals[at]))
            };
            if has_normals {
                let normals = corners.iter().map(normal).collect::<Result<_, _>>()?;
                self.soup.corner_normals.push(normals);
            }
        }
        Ok(self.soup)
    }
}
