//! Triangle meshes from files of other programs: read, put in order, refused where that is not safe.

mod error;
mod orientation;
mod ply;
mod polygon_soup;
mod repair;
mod stl;
mod triangulate;

use std::path::Path;

use basemesh::{FaceMap, TriMesh};
use glam::DVec3;

use crate::in_file::{InFile, parse_file};

pub use error::MeshFileError;
pub use polygon_soup::PolygonSoup;
pub use repair::{Repairs, repair};

/// File formats of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// STL, text or binary.
    Stl,
    /// PLY, text or binary.
    Ply,
    /// OFF, text.
    Off,
}

impl MeshFormat {
    /// The endings of file names.
    pub const EXTENSIONS: [&str; 4] = ["obj", "stl", "ply", "off"];

    /// The format with this ending, in small or capital letters.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            "off" => Some(Self::Off),
            _ => None,
        }
    }

    /// The format that contents show: PLY and OFF begin with their names, and binary STL has the length
    /// that its number of triangles says.
    fn from_contents(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"ply") {
            Some(Self::Ply)
        } else if bytes.starts_with(b"OFF") {
            Some(Self::Off)
        } else if stl::is_stl(bytes) {
            Some(Self::Stl)
        } else {
            None
        }
    }
}

/// A triangle mesh from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// The mesh.
    pub mesh: TriMesh,
    /// The format it was in.
    pub format: MeshFormat,
    /// What was done to make it a mesh.
    pub repairs: Repairs,
    /// Normals at the corners of each face, if the file has any.
    pub corner_normals: Option<FaceMap<[Option<DVec3>; 3]>>,
    /// Names of groups of faces; one without a name if the file has none.
    pub groups: Vec<String>,
    /// The group of each face.
    pub group_of: FaceMap<usize>,
}

/// Reads a mesh in any of the formats of [`MeshFormat`]; the contents decide where they are clear,
/// otherwise the ending of the name.
///
/// Polygons are cut into triangles. Equal vertices are merged, faces that collapse by that or stand twice
/// are dropped, faces are turned so that neighbours agree, closed meshes so that they enclose a positive
/// volume, and unused vertices are dropped; all this is counted in [`MeshFile::repairs`]. Coordinates keep
/// their bits.
///
/// # Errors
///
/// [`MeshFileError`] with the path: damaged contents, coordinates that are not finite, edges with more than
/// two faces, faces that cannot agree, faces without area.
pub fn read_mesh_file(path: impl AsRef<Path>) -> Result<MeshFile, InFile<MeshFileError>> {
    let path = path.as_ref();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let named = MeshFormat::from_extension(&extension);
    parse_file(path, |bytes| read_mesh(bytes, named))
}

/// Reads a mesh from the contents of a file; see [`read_mesh_file`]. `named` is the format that the name
/// of the file says.
///
/// # Errors
///
/// [`MeshFileError`].
pub fn read_mesh(bytes: &[u8], named: Option<MeshFormat>) -> Result<MeshFile, MeshFileError> {
    let format = MeshFormat::from_contents(bytes).or(named).ok_or(MeshFileError::UnknownFormat)?;
    let soup = match format {
        MeshFormat::Obj => crate::obj::read_soup(bytes)?,
        MeshFormat::Off => PolygonSoup::from(crate::off::read_off(&mut &bytes[..])?),
        MeshFormat::Stl => stl::parse(bytes)?,
        MeshFormat::Ply => ply::parse(bytes)?,
    };
    repair(soup, format)
}
