//! From the contents of a file to a surface.

use apatch::rational::{Normals, RationalSurface, Settings, SurfaceError};
use basemesh::glam::DVec3;
use basemesh::{MeshError, TriMesh, VertexMap};
use implicit::ImplicitField;
use io::Polygons;
use thiserror::Error;

/// Where the normals come from: one for each vertex.
#[derive(Clone, Copy)]
pub enum NormalSource<'a> {
    /// The normals of the file, with their lengths.
    File,
    /// Estimated from the mesh.
    Estimate,
    /// The gradient of a field at the vertices. Quadrics are then reproduced.
    Field(&'a dyn ImplicitField),
}

impl std::fmt::Debug for NormalSource<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::File => "File",
            Self::Estimate => "Estimate",
            Self::Field(_) => "Field",
        })
    }
}

/// Why there is no surface. Faces and vertices count from 0 in file order.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RationalError {
    /// A face that is no triangle.
    #[error("face {face} is a quadrilateral; A-patches of this scheme need triangles")]
    Quadrilateral {
        /// The face.
        face: usize,
    },
    /// The faces are no mesh.
    #[error("{0} (counted from 0, in file order)")]
    Mesh(#[from] MeshError),
    /// Not a single corner has a normal.
    #[error(
        "the faces name no normals (`f 1//1 2//2 3//3`); estimate them from the mesh, or take those \
         of an implicit surface"
    )]
    NoNormals,
    /// No corner of a vertex has a normal.
    #[error("vertex {vertex} has no normal (counted from 0); estimate the normals from the mesh")]
    NoNormal {
        /// The vertex.
        vertex: usize,
    },
    /// A crease.
    #[error(
        "vertex {vertex} has several normals (counted from 0), {first} and {second}; a smooth \
         function has one gradient there: estimate the normals from the mesh"
    )]
    SeveralNormals {
        /// The vertex.
        vertex: usize,
        /// One of them.
        first: DVec3,
        /// Another one.
        second: DVec3,
    },
    /// The surface that was asked for does not exist.
    #[error("{0} (counted from 0, in file order)")]
    Surface(#[from] SurfaceError),
}

/// The rational A-patch surface over the triangles of a file.
///
/// # Errors
///
/// [`RationalError`]. Faults of single edges are told by [`report`](super::report).
pub fn rational_surface(
    polygons: &Polygons,
    source: NormalSource<'_>,
    settings: &Settings,
) -> Result<RationalSurface, RationalError> {
    let mesh = mesh(polygons)?;
    let normals = match source {
        NormalSource::File => Normals::Given(file_normals(polygons)?),
        NormalSource::Estimate => Normals::Estimated,
        NormalSource::Field(field) => {
            Normals::Given(mesh.positions().map(|_, &p| field.value_gradient(p).1))
        }
    };
    Ok(RationalSurface::new(mesh, normals, settings)?)
}

fn mesh(polygons: &Polygons) -> Result<TriMesh, RationalError> {
    let faces = polygons.faces.iter().enumerate().map(|(face, polygon)| match *polygon.corners() {
        [a, b, c] => Ok([a, b, c]),
        _ => Err(RationalError::Quadrilateral { face }),
    });
    let faces = faces.collect::<Result<Vec<_>, _>>()?;
    Ok(TriMesh::new(polygons.positions.clone(), &faces)?)
}

/// Normals of one vertex that differ by less than this part of their lengths are the same: files
/// round them.
const SAME_NORMAL: f64 = 1e-6;

/// The first normal of each vertex; all others must be the same.
fn file_normals(polygons: &Polygons) -> Result<VertexMap<DVec3>, RationalError> {
    let mut found: Vec<Option<DVec3>> = vec![None; polygons.positions.len()];
    for (face, normals) in polygons.faces.iter().zip(&polygons.corner_normals) {
        for (&vertex, normal) in face.corners().iter().zip(normals.corners()) {
            let Some(second) = normal.map(|id| polygons.normals[id]) else { continue };
            let first = *found[vertex].get_or_insert(second);
            if first.distance(second) > SAME_NORMAL * first.length().max(second.length()) {
                return Err(RationalError::SeveralNormals { vertex, first, second });
            }
        }
    }
    if found.iter().all(Option::is_none) {
        return Err(RationalError::NoNormals);
    }
    let normals = found
        .into_iter()
        .enumerate()
        .map(|(vertex, normal)| normal.ok_or(RationalError::NoNormal { vertex }));
    Ok(VertexMap::from_vec(normals.collect::<Result<_, _>>()?))
}
