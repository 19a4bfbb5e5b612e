//! PLY, text and binary, with numbers of any type.

use glam::DVec3;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

use super::error::MeshFileError;
use super::polygon_soup::PolygonSoup;

/// What is taken from any element: coordinates of a vertex, or the vertices of a face.
#[derive(Default)]
struct Record {
    position: [Option<f64>; 3],
    corners: Option<Vec<i64>>,
}

impl PropertyAccess for Record {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        match name {
            "x" | "y" | "z" => {
                let axis = ["x", "y", "z"].iter().position(|axis| *axis == name).unwrap_or(0);
                self.position[axis] = number(&value);
                found(self.position[axis].is_some())
            }
            "vertex_indices" | "vertex_index" => {
                self.corners = numbers(value);
                found(self.corners.is_some())
            }
            _ => PropertyAccessResult::Ignored,
        }
    }
}

fn found(set: bool) -> PropertyAccessResult {
    if set { PropertyAccessResult::Set } else { PropertyAccessResult::UnsupportedType }
}

fn number(value: &Property) -> Option<f64> {
    Some(match *value {
        Property::Char(v) => f64::from(v),
        Property::UChar(v) => f64::from(v),
        Property::Short(v) => f64::from(v),
        Property::UShort(v) => f64::from(v),
        Property::Int(v) => f64::from(v),
        Property::UInt(v) => f64::from(v),
        Property::Float(v) => f64::from(v),
        Property::Double(v) => v,
        _ => return None,
    })
}

fn numbers(value: Property) -> Option<Vec<i64>> {
    fn all<T: Into<i64>>(values: Vec<T>) -> Vec<i64> {
        values.into_iter().map(Into::into).collect()
    }
    Some(match value {
        Property::ListChar(v) => all(v),
        Property::ListUChar(v) => all(v),
        Property::ListShort(v) => all(v),
        Property::ListUShort(v) => all(v),
        Property::ListInt(v) => all(v),
        Property::ListUInt(v) => all(v),
        _ => return None,
    })
}

/// Vertices and faces; everything else is skipped.
pub(super) fn parse(bytes: &[u8]) -> Result<PolygonSoup, MeshFileError> {
    let parsed = Parser::<Record>::new().read_ply(&mut &*bytes);
    let mut payload = parsed.map_err(|error| MeshFileError::Ply(error.to_string()))?.payload;
    let mut take = |name: &str, missing| {
        payload.shift_remove(name).ok_or(MeshFileError::PlyWithout { missing })
    };
    let vertices = take("vertex", "element 'vertex'")?;
    let faces = take("face", "element 'face': a cloud of points is no mesh")?;
    let mut soup = PolygonSoup::default();
    for vertex in vertices {
        let [Some(x), Some(y), Some(z)] = vertex.position else {
            return Err(MeshFileError::PlyWithout { missing: "coordinates x, y and z" });
        };
        soup.positions.push(DVec3::new(x, y, z));
    }
    let count = soup.positions.len();
    for (face, record) in faces.into_iter().enumerate() {
        let missing = "list 'vertex_indices' or 'vertex_index'";
        let corners = record.corners.ok_or(MeshFileError::PlyWithout { missing })?;
        let corner = |vertex: i64| {
            usize::try_from(vertex).map_err(|_| MeshFileError::MissingVertex {
                face,
                vertex,
                count,
            })
        };
        soup.faces.push(corners.into_iter().map(corner).collect::<Result<_, _>>()?);
    }
    Ok(soup)
}
