//! Solids from files or by name, and surfaces as files have them.

use std::path::Path;

use apatch::polyhedral::{
    Curvatures, Planarity, PolyhedralSurface, Polyhedron, PolyhedronError, Sampled,
};
use apatch::{Element, Tessellation};
use io::{
    CellData, CellValues, Grid, GridCell, InFile, ObjReadError, OffReadError, read_faces_file,
    read_off_file,
};
use thiserror::Error;

/// Why there is no solid.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SolidError {
    /// The OFF file is not readable.
    #[error(transparent)]
    Off(#[from] InFile<OffReadError>),
    /// The OBJ file is not readable.
    #[error(transparent)]
    Obj(#[from] InFile<ObjReadError>),
    /// The faces are not those of a solid.
    #[error("{name}: {problem} (faces and vertices from 0; coplanar faces were merged)")]
    Solid {
        /// The file.
        name: String,
        /// What is wrong.
        problem: PolyhedronError,
    },
    /// Neither a file of a known kind nor a known name.
    #[error("{name} is neither an .off or .obj file nor one of the solids {}", names())]
    Unknown {
        /// What was given.
        name: String,
    },
}

fn names() -> String {
    apatch::polyhedral::SOLID_NAMES.join(", ")
}

/// A solid by the name of an OFF or OBJ file, or by its own
/// ([`SOLID_NAMES`](apatch::polyhedral::SOLID_NAMES)).
///
/// Faces of files may have any number of corners. Coplanar neighbours become one face, faces with a
/// cut that leads to a hole get the hole.
///
/// # Errors
///
/// [`SolidError`].
pub fn solid(path: &Path, planarity: &Planarity) -> Result<Polyhedron, SolidError> {
    let name = path.display().to_string();
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let faces = match extension.as_deref() {
        Some("off") => read_off_file(path)?,
        Some("obj") => read_faces_file(path)?,
        _ => return Polyhedron::named(&name).ok_or(SolidError::Unknown { name }),
    };
    Polyhedron::from_polygons(faces.positions, &faces.faces, planarity)
        .map_err(|problem| SolidError::Solid { name, problem })
}

/// The triangles as an OBJ file has them.
#[must_use]
pub fn mesh_of(sampled: &Sampled) -> io::Tessellation {
    let Tessellation { positions, normals, triangles, .. } = sampled.mesh.clone();
    io::Tessellation { positions, normals, triangles }
}

/// The triangles with normals and curvatures at their points and these numbers for each cell:
/// `patch_kind` ([`apatch::PatchKind`]), `triangle` and `edge` (number in the hull, or -1 if the patch
/// is over the other one).
///
/// Point data: `mean_curvature` and `gauss_curvature`, zero on planar pieces. Those of a C1 surface
/// differ from patch to patch; a point that several share has the value of one of them.
#[must_use]
pub fn curvature_grid(surface: &PolyhedralSurface, sampled: &Sampled) -> Grid {
    let curvatures: Vec<Curvatures> = sampled
        .places
        .iter()
        .map(|place| {
            place.map_or_else(Curvatures::default, |(c, at)| surface.jet(c, at).curvatures())
        })
        .collect();
    let of_point =
        |value: fn(&Curvatures) -> f64| CellValues::Float64(curvatures.iter().map(value).collect());
    let mesh = &sampled.mesh;
    let of_cell = |value: &dyn Fn(&Element) -> i64| {
        CellValues::Int64(mesh.elements.iter().map(value).collect())
    };
    let id = |index: usize| i64::try_from(index).expect("invariant: ids fit 32 bits");
    let triangle = |element: &Element| match *element {
        Element::Face(face) => id(face.index()),
        Element::Edge(_) => -1,
    };
    let edge = |element: &Element| match *element {
        Element::Face(_) => -1,
        Element::Edge(edge) => id(edge.index()),
    };
    let kinds = mesh.kinds.iter().map(|&kind| i64::from(kind as u8)).collect();
    let named = |(name, values): (&str, CellValues)| CellData { name: name.to_owned(), values };
    Grid {
        points: mesh.positions.clone(),
        normals: mesh.normals.clone(),
        cells: mesh.triangles.iter().map(|&t| GridCell::Triangle(t)).collect(),
        point_data: [
            ("mean_curvature", of_point(|c| c.mean)),
            ("gauss_curvature", of_point(|c| c.gauss)),
        ]
        .map(named)
        .to_vec(),
        cell_data: [
            ("patch_kind", CellValues::Int64(kinds)),
            ("triangle", of_cell(&triangle)),
            ("edge", of_cell(&edge)),
        ]
        .map(named)
        .to_vec(),
    }
}
