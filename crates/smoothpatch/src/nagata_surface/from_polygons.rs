//! From the contents of a file to a surface.

use basemesh::glam::DVec3;
use implicit::ImplicitField;
use io::Polygons;
use nagata::{
    Apex, CornerNormals, MeshError, NagataSurface, NormalsError, PolygonMesh, SurfaceError, apexes,
};
use thiserror::Error;

/// Where the normals come from.
#[derive(Clone, Copy)]
pub enum NormalSource<'a> {
    /// The corner normals of the file. Corners without one have none, which suits the apexes of
    /// cones.
    File,
    /// Estimated from the mesh, separated at edges whose faces meet at this angle or more.
    /// Unit: radians.
    Estimate {
        /// The angle.
        crease_angle: f64,
    },
    /// The gradient of a field at the vertices: no creases. There is none where it vanishes.
    Field(&'a dyn ImplicitField),
}

impl std::fmt::Debug for NormalSource<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File => f.write_str("File"),
            Self::Estimate { crease_angle } => write!(f, "Estimate({crease_angle})"),
            Self::Field(_) => f.write_str("Field"),
        }
    }
}

/// Other normals at the sharp tips of a mesh, such as the apexes of cones.
#[derive(Clone, Copy, Debug)]
pub struct Tips {
    /// Tips are the vertices from whose mean normal all faces turn by more than this. Unit: radians.
    pub angle: f64,
    /// What they get.
    pub normals: Apex,
}

/// Why there is no surface. Faces, vertices and normals count from 0 in file order.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NagataError {
    /// The faces are no mesh.
    #[error("{0} (counted from 0, in file order)")]
    Mesh(#[from] MeshError),
    /// Not a single corner has a normal.
    #[error(
        "the faces name no normals (`f 1//1 2//2 3//3`); estimate them from the mesh, or take those \
         of an implicit surface"
    )]
    NoNormals,
    /// The normals are no use.
    #[error("{0} (counted from 0, in file order)")]
    Normals(#[from] NormalsError),
    /// The field has no gradient at any vertex.
    #[error("the gradient of the field vanishes, or is no number, at every vertex")]
    NoGradient,
    /// The surface that was asked for does not exist.
    #[error("{0} (counted from 0, in file order)")]
    Surface(#[from] SurfaceError),
}

/// The surface over the faces of a file.
///
/// # Errors
///
/// [`NagataError`]. Numerical trouble of single edges is told by [`report`](super::report).
pub fn from_polygons(
    polygons: &Polygons,
    source: NormalSource<'_>,
    settings: nagata::Settings,
) -> Result<NagataSurface, NagataError> {
    let (mesh, normals) = mesh_and_normals(polygons, source)?;
    Ok(NagataSurface::new(mesh, normals, settings)?)
}

/// The same with other normals at tips, and how many there are.
///
/// # Errors
///
/// As for [`from_polygons`].
pub fn from_polygons_with_tips(
    polygons: &Polygons,
    source: NormalSource<'_>,
    tips: Tips,
    settings: nagata::Settings,
) -> Result<(NagataSurface, usize), NagataError> {
    let (mesh, normals) = mesh_and_normals(polygons, source)?;
    let found = apexes(&mesh, tips.angle);
    let normals = normals.with_apexes(&mesh, &found, tips.normals);
    Ok((NagataSurface::new(mesh, normals, settings)?, found.len()))
}

fn mesh_and_normals(
    polygons: &Polygons,
    source: NormalSource<'_>,
) -> Result<(PolygonMesh, CornerNormals), NagataError> {
    let mesh = PolygonMesh::new(polygons.positions.clone(), &polygons.faces)?;
    let normals = match source {
        NormalSource::File => file_normals(&mesh, polygons)?,
        NormalSource::Estimate { crease_angle } => CornerNormals::estimated(&mesh, crease_angle),
        NormalSource::Field(field) => field_normals(&mesh, field)?,
    };
    Ok((mesh, normals))
}

fn file_normals(mesh: &PolygonMesh, polygons: &Polygons) -> Result<CornerNormals, NagataError> {
    let mut corners = polygons.corner_normals.iter().flat_map(io::Polygon::corners);
    if corners.all(Option::is_none) {
        return Err(NagataError::NoNormals);
    }
    let merged = CornerNormals::MERGE_ANGLE;
    Ok(CornerNormals::from_corners(mesh, &polygons.normals, &polygons.corner_normals, merged)?)
}

fn field_normals(
    mesh: &PolygonMesh,
    field: &dyn ImplicitField,
) -> Result<CornerNormals, NagataError> {
    let usable = |gradient: &DVec3| gradient.is_finite() && *gradient != DVec3::ZERO;
    let normals = CornerNormals::from_fn(mesh, |p| Some(field.value_gradient(p).1).filter(usable));
    if normals.normals().is_empty() { Err(NagataError::NoGradient) } else { Ok(normals) }
}
