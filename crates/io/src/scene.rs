//! Scenes: what to approximate, how finely, and how good the result must be.

mod bounds;
mod error;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::DVec3;
use ron::Options;
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};

pub use bounds::{Bounds, Method};
pub use error::SceneError;

use crate::in_file::{InFile, parse_file};

/// Fewest faces of a closed mesh.
const MIN_FACES: usize = 4;

/// One surface and the task to approximate it; the contents of a scene file.
///
/// ```ron
/// #![enable(implicit_some)]
/// (
///     version: 1,
///     name: "ball",
///     surface: Formula(text: "x^2 + y^2 + z^2 - r^2", constants: {"r": 1.5}),
///     region: (min: (-2, -2, -2), max: (2, 2, 2)),
///     faces: 320,
///     bounds: {Published: (euler: 2, g1_angle_deg: 1e-9)},
/// )
/// ```
///
/// Whether the shape or the formula means anything is not decided here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of this format; see [`Scene::VERSION`].
    pub version: u32,
    /// Name in tables and messages.
    pub name: String,
    /// The surface.
    pub surface: SceneSurface,
    /// The box to look for the surface in; by default that of the shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub region: Option<Region>,
    /// Number of patches aimed at; at least 4.
    pub faces: usize,
    /// A triangle mesh (OBJ) to start from instead of polygonizing, as a path relative to the scene
    /// file; see [`Scene::base_mesh_beside`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_mesh: Option<PathBuf>,
    /// What the result of each method must satisfy; nothing for methods that are not listed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub bounds: BTreeMap<Method, Bounds>,
}

/// The surface of a scene: the set where a function has the value `level`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum SceneSurface {
    /// A surface with a name, at level 0.
    Shape(String),
    /// A formula in `x`, `y`, `z`.
    Formula {
        /// The formula.
        text: String,
        /// Values of the other names in the formula.
        #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
        constants: BTreeMap<String, f64>,
        /// The value of the function on the surface; 0 if not given.
        #[serde(default)]
        level: f64,
    },
}

/// An axis-parallel box with positive extent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// Lower corner.
    pub min: [f64; 3],
    /// Upper corner.
    pub max: [f64; 3],
}

impl Region {
    /// Lower and upper corner.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 2] {
        [self.min.into(), self.max.into()]
    }
}

/// Only the version, whatever else there is.
#[derive(Deserialize)]
#[serde(rename = "Scene")]
struct VersionOnly {
    version: u32,
}

impl Scene {
    /// The version that is written, and the only one that is read.
    pub const VERSION: u32 = 1;

    /// Reads and checks a scene file.
    ///
    /// # Errors
    ///
    /// [`SceneError`], with the path.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, InFile<SceneError>> {
        parse_file(path.as_ref(), |bytes| match std::str::from_utf8(bytes) {
            Ok(text) => Self::parse(text),
            Err(_) => Err(SceneError::NotText),
        })
    }

    /// Reads and checks a scene from RON. `Some` may be left out.
    ///
    /// # Errors
    ///
    /// [`SceneError`]; with line and column unless it is a value that makes no sense.
    pub fn parse(text: &str) -> Result<Self, SceneError> {
        let options = Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
        // another version may have other fields, so it is looked at first
        if let Ok(VersionOnly { version }) = options.from_str(text)
            && version != Self::VERSION
        {
            return Err(SceneError::Version { found: version });
        }
        let scene: Self = options.from_str(text)?;
        scene.check()?;
        Ok(scene)
    }

    /// The scene as RON; [`Scene::parse`] gives it back bit for bit.
    ///
    /// # Errors
    ///
    /// [`SceneError`] if a value makes no sense.
    pub fn to_ron(&self) -> Result<String, SceneError> {
        self.check()?;
        let pretty = PrettyConfig::new().extensions(Extensions::IMPLICIT_SOME).new_line("\n");
        let mut text = Options::default().to_string_pretty(self, pretty)?;
        text.push('\n');
        Ok(text)
    }

    /// Where the base mesh is, for a scene read from `scene_file`.
    #[must_use]
    pub fn base_mesh_beside(&self, scene_file: &Path) -> Option<PathBuf> {
        let relative = self.base_mesh.as_ref()?;
        Some(scene_file.parent().unwrap_or(Path::new("")).join(relative))
    }

    fn check(&self) -> Result<(), SceneError> {
        if self.version != Self::VERSION {
            return Err(SceneError::Version { found: self.version });
        }
        if self.faces < MIN_FACES {
            return Err(SceneError::TooFewFaces { faces: self.faces });
        }
        if let Some(region) = &self.region {
            check_region(region)?;
        }
        if let Some(path) = self.base_mesh.as_ref().filter(|path| !path.is_relative()) {
            return Err(SceneError::AbsoluteBaseMesh { path: path.clone() });
        }
        if let SceneSurface::Formula { constants, level, .. } = &self.surface {
            let named = constants.iter().map(|(name, &value)| (name.as_str(), value));
            for (name, value) in named.chain([("level", *level)]) {
                if !value.is_finite() {
                    return Err(SceneError::Constant { name: name.to_owned(), value });
                }
            }
        }
        self.bounds.iter().try_for_each(|(&method, bounds)| bounds.check(method))
    }
}

fn check_region(region: &Region) -> Result<(), SceneError> {
    for ((axis, min), max) in ["x", "y", "z"].into_iter().zip(region.min).zip(region.max) {
        // the extent of two finite numbers may still be infinite
        if !(min.is_finite() && max.is_finite() && (max - min).is_finite() && min < max) {
            return Err(SceneError::Region { axis, min, max });
        }
    }
    Ok(())
}
