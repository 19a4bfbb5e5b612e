//! From the description of a scene to something that can be fitted.

use std::path::Path;

use basemesh::TriMesh;
use implicit::{Aabb, Formula, FormulaError, ImplicitSurface, Level, NamedShape};
use io::{InFile, ObjReadError, Scene, SceneSurface};
use thiserror::Error;

/// Why a scene means nothing.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ResolveError {
    /// No shape has this name.
    #[error("there is no shape named `{name}`; known shapes: {known}")]
    UnknownShape {
        /// The name.
        name: String,
        /// All names, separated by commas.
        known: String,
    },
    /// The formula cannot be understood.
    #[error("{0}")]
    Formula(#[from] FormulaError),
    /// The base mesh cannot be read.
    #[error(transparent)]
    BaseMesh(#[from] InFile<ObjReadError>),
}

/// The field of a named shape, or of a formula.
///
/// # Errors
///
/// [`ResolveError`] with the known names, or with a caret under the place in the formula.
pub fn field_of(surface: &SceneSurface) -> Result<Box<dyn ImplicitSurface>, ResolveError> {
    match surface {
        SceneSurface::Shape(name) => Ok(shape(name)?.field()),
        SceneSurface::Formula { text, constants, level } => {
            let constants: Vec<(&str, f64)> =
                constants.iter().map(|(name, &value)| (name.as_str(), value)).collect();
            let field = Formula::parse_with(text, &constants)?;
            Ok(Box::new(Level { field, level: *level }))
        }
    }
}

/// The box that a scene names, or that of its shape; `None` if it must be searched for.
///
/// # Errors
///
/// [`ResolveError::UnknownShape`].
pub fn region_of(scene: &Scene) -> Result<Option<Aabb>, ResolveError> {
    if let Some(region) = &scene.region {
        let [min, max] = region.corners();
        return Ok(Some(Aabb { min, max }));
    }
    match &scene.surface {
        SceneSurface::Shape(name) => Ok(Some(shape(name)?.region)),
        SceneSurface::Formula { .. } => Ok(None),
    }
}

/// The base mesh that a scene names, if any; its path is relative to the scene file.
///
/// # Errors
///
/// [`ResolveError::BaseMesh`].
pub fn base_mesh_of(scene: &Scene, scene_file: &Path) -> Result<Option<TriMesh>, ResolveError> {
    scene
        .base_mesh_beside(scene_file)
        .map(|path| io::read_obj_file(path).map_err(ResolveError::from))
        .transpose()
}

fn shape(name: &str) -> Result<&'static NamedShape, ResolveError> {
    NamedShape::find(name).ok_or_else(|| {
        let names: Vec<&str> = implicit::catalogue().iter().map(|shape| shape.name).collect();
        ResolveError::UnknownShape { name: name.to_owned(), known: names.join(", ") }
    })
}

impl From<io::Method> for crate::Method {
    fn from(method: io::Method) -> Self {
        match method {
            io::Method::Published => Self::Published,
            io::Method::Refined => Self::Refined,
        }
    }
}
