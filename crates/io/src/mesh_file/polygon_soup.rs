//! Polygons as a file has them.

use glam::DVec3;

use crate::off::Faces;

/// Polygons of any size over numbered vertices, with normals and groups; counted from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonSoup {
    /// Positions of the vertices.
    pub positions: Vec<DVec3>,
    /// The vertices of each face, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
    /// Normals at the corners of each face; empty if the file has none.
    pub corner_normals: Vec<Vec<Option<DVec3>>>,
    /// Names of groups of faces.
    pub groups: Vec<String>,
    /// The group of each face; empty if there are no groups.
    pub group_of: Vec<usize>,
}

impl From<Faces> for PolygonSoup {
    fn from(Faces { positions, faces }: Faces) -> Self {
        Self { positions, faces, ..Self::default() }
    }
}
