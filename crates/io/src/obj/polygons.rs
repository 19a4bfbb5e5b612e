//! Reading triangles and quadrilaterals with the normals at their corners.

use std::io::Read;
use std::path::Path;
use std::str::SplitWhitespace;

use glam::DVec3;

use super::error::ObjReadError;
use super::statements::{
    CornerIndices, Statement, corner, for_each_statement, from_one, numbers, position, resolve,
};
use crate::in_file::{InFile, parse_file};
use crate::polygon::Polygon;

/// Triangles and quadrilaterals over numbered vertices and normals, as a file has them; counted
/// from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygons {
    /// Positions of the vertices.
    pub positions: Vec<DVec3>,
    /// Normals of any length, in any number.
    pub normals: Vec<DVec3>,
    /// The vertices of each face, counter-clockwise seen from outside.
    pub faces: Vec<Polygon<usize>>,
    /// The normal at each corner of each face, if it has one.
    ///
    /// Corners of one vertex with the same normal are smooth there, others meet in a crease: the
    /// index tells, not the value.
    pub corner_normals: Vec<Polygon<Option<usize>>>,
}

impl Polygons {
    /// Whether every corner has a normal.
    #[must_use]
    pub fn has_normals(&self) -> bool {
        self.corner_normals.iter().all(|face| face.corners().iter().all(Option::is_some))
    }

    /// The same surface with every quadrilateral cut in two along its shorter diagonal; along the one
    /// from its first corner if they are equal.
    #[must_use]
    pub fn triangulated(&self) -> Self {
        let mut result = Self { faces: Vec::new(), corner_normals: Vec::new(), ..self.clone() };
        for (face, normals) in self.faces.iter().zip(&self.corner_normals) {
            let [a, b, c, d] = *face.corners() else {
                result.faces.push(*face);
                result.corner_normals.push(*normals);
                continue;
            };
            let length =
                |from: usize, to: usize| self.positions[from].distance_squared(self.positions[to]);
            let halves = if length(a, c) <= length(b, d) {
                [[0, 1, 2], [0, 2, 3]]
            } else {
                [[0, 1, 3], [1, 2, 3]]
            };
            for half in halves {
                result.faces.push(Polygon::triangle(half.map(|c| face.corners()[c])));
                result.corner_normals.push(Polygon::triangle(half.map(|c| normals.corners()[c])));
            }
        }
        result
    }
}

/// What to do with faces of more than four corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LargeFaces {
    /// An error.
    #[default]
    Refuse,
    /// Split into triangles around their first corner, which suits convex faces.
    Split,
}

/// Reads triangles and quadrilaterals with the normals at their corners.
///
/// Vertices and normals keep their order and their bits, faces their order and first corner. Texture
/// coordinates, groups, materials, lines and points are skipped; free-form surfaces and unknown
/// statements are refused. Edges may have any number of faces, vertices none. Lengths of normals are
/// not looked at.
///
/// # Errors
///
/// [`ObjReadError`] with the line and the first offending element.
pub fn read_polygons(
    input: &mut dyn Read,
    large_faces: LargeFaces,
) -> Result<Polygons, ObjReadError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    parse(&bytes, large_faces)
}

/// Reads triangles and quadrilaterals from a file; see [`read_polygons`].
///
/// # Errors
///
/// [`ObjReadError`], with the path.
pub fn read_polygons_file(
    path: impl AsRef<Path>,
    large_faces: LargeFaces,
) -> Result<Polygons, InFile<ObjReadError>> {
    parse_file(path.as_ref(), |bytes| parse(bytes, large_faces))
}

fn parse(bytes: &[u8], large_faces: LargeFaces) -> Result<Polygons, ObjReadError> {
    let mut parser = Parser::default();
    for_each_statement(bytes, |line, statement| match statement {
        Statement::Vertex(words) => parser.vertex(line, words),
        Statement::Normal(words) => parser.normal(line, words),
        Statement::Face(words) => parser.face(line, words, large_faces),
        Statement::Group(_) => Ok(()),
    })?;
    parser.finish()
}

/// A corner of a face: its vertex and its normal, from 0.
type Corner = (usize, Option<usize>);

#[derive(Default)]
struct Parser {
    polygons: Polygons,
    /// Faces read so far, those that were split once.
    face_count: usize,
    /// Line and number from 1 of each polygon's face.
    origins: Vec<[usize; 2]>,
}

impl Parser {
    fn vertex(&mut self, line: usize, words: SplitWhitespace<'_>) -> Result<(), ObjReadError> {
        let positions = &mut self.polygons.positions;
        positions.push(position(line, positions.len() + 1, words)?);
        Ok(())
    }

    fn normal(&mut self, line: usize, words: SplitWhitespace<'_>) -> Result<(), ObjReadError> {
        let normal = <[f64; 3]>::try_from(numbers(line, words)?).ok().map(DVec3::from_array);
        let normal = normal.filter(|n| n.is_finite()).ok_or(ObjReadError::Normal { line })?;
        self.polygons.normals.push(normal);
        Ok(())
    }

    fn face(
        &mut self,
        line: usize,
        words: SplitWhitespace<'_>,
        large_faces: LargeFaces,
    ) -> Result<(), ObjReadError> {
        self.face_count += 1;
        let face = self.face_count;
        let corners = words.map(|word| self.corner(line, word)).collect::<Result<Vec<_>, _>>()?;
        let mut vertices: Vec<_> = corners.iter().map(|&(vertex, _)| vertex).collect();
        vertices.sort_unstable();
        if let Some(pair) = vertices.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(ObjReadError::RepeatedVertex { line, face, vertex: pair[0] + 1 });
        }
        match (corners.len(), large_faces) {
            (3 | 4, _) => self.push(line, &corners),
            (5.., LargeFaces::Split) => {
                for pair in corners[1..].windows(2) {
                    self.push(line, &[corners[0], pair[0], pair[1]]);
                }
            }
            (corners, _) => return Err(ObjReadError::NotAPolygon { line, face, corners }),
        }
        Ok(())
    }

    fn push(&mut self, line: usize, corners: &[Corner]) {
        let vertices: Vec<_> = corners.iter().map(|&(vertex, _)| vertex).collect();
        let normals: Vec<_> = corners.iter().map(|&(_, normal)| normal).collect();
        let expected = "invariant: three or four corners";
        self.polygons.faces.push(Polygon::new(&vertices).expect(expected));
        self.polygons.corner_normals.push(Polygon::new(&normals).expect(expected));
        self.origins.push([line, self.face_count]);
    }

    fn corner(&self, line: usize, text: &str) -> Result<Corner, ObjReadError> {
        let CornerIndices { vertex: index, normal } = corner(line, text)?;
        let (face, count) = (self.face_count, self.polygons.positions.len());
        let vertex = resolve(index, count).ok_or(ObjReadError::MissingVertex {
            line,
            face,
            index,
            count,
        })?;
        let count = self.polygons.normals.len();
        let normal = normal.map(|index| {
            resolve(index, count).ok_or(ObjReadError::MissingNormal { line, face, index, count })
        });
        Ok((vertex, normal.transpose()?))
    }

    fn finish(self) -> Result<Polygons, ObjReadError> {
        let Self { polygons, origins, .. } = self;
        if polygons.faces.is_empty() {
            return Err(ObjReadError::NoFaces);
        }
        let corners = polygons.faces.iter().zip(&polygons.corner_normals);
        for ((vertices, normals), [line, face]) in corners.zip(origins) {
            let count = polygons.positions.len();
            if let Some(&vertex) = vertices.corners().iter().find(|&&vertex| vertex >= count) {
                let index = from_one(vertex);
                return Err(ObjReadError::MissingVertex { line, face, index, count });
            }
            let count = polygons.normals.len();
            if let Some(&normal) = normals.corners().iter().flatten().find(|&&n| n >= count) {
                let index = from_one(normal);
                return Err(ObjReadError::MissingNormal { line, face, index, count });
            }
        }
        Ok(polygons)
    }
}
