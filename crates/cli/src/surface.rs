//! Which surface is meant: a scene file, a named shape or a formula.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::Args;
use smoothpatch::io::{Scene, SceneSurface};

use crate::values;

/// The id of the group of options of which one names the surface.
pub(crate) const SURFACE: &str = "surface";

/// Number of faces if nobody says anything.
const DEFAULT_FACES: usize = 2000;

/// The options that name a surface without a scene file.
#[derive(Args)]
#[group(skip)]
pub(crate) struct SurfaceArguments {
    /// A named shape; `smoothpatch shapes` lists them
    #[arg(long, value_name = "NAME", group = SURFACE)]
    shape: Option<String>,

    /// A formula in x, y, z that is negative inside, such as "x^4 + y^4 + z^4 - 1"
    #[arg(long, value_name = "TEXT", group = SURFACE, allow_hyphen_values = true)]
    formula: Option<String>,

    /// The value of another name in the formula; can be repeated
    #[arg(long = "constant", value_name = "NAME=VALUE", requires = "formula")]
    #[arg(conflicts_with_all = ["scene", "shape"], value_parser = values::constant)]
    constants: Vec<(String, f64)>,

    /// The value of the formula on the surface [default: 0]
    #[arg(long, value_name = "C", requires = "formula", allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["scene", "shape"], value_parser = values::finite)]
    level: Option<f64>,
}

/// A scene, and the file it came from.
#[derive(Clone, Debug)]
pub(crate) struct ChosenScene {
    pub(crate) scene: Scene,
    /// `None` for a scene made from options.
    pub(crate) file: Option<PathBuf>,
}

impl SurfaceArguments {
    /// The scene in a file, or one with the surface that the options name; `None` if there is
    /// neither.
    pub(crate) fn scene(&self, file: Option<&Path>) -> anyhow::Result<Option<ChosenScene>> {
        if let Some(file) = file {
            let scene = Scene::read(file)?;
            return Ok(Some(ChosenScene { scene, file: Some(file.to_owned()) }));
        }
        let (name, surface) = match (&self.shape, &self.formula) {
            (Some(name), _) => (name.clone(), SceneSurface::Shape(name.clone())),
            (None, Some(text)) => ("formula".to_owned(), self.formula_surface(text)?),
            (None, None) => return Ok(None),
        };
        let scene = Scene {
            version: Scene::VERSION,
            name,
            surface,
            region: None,
            faces: DEFAULT_FACES,
            base_mesh: None,
            bounds: BTreeMap::new(),
        };
        Ok(Some(ChosenScene { scene, file: None }))
    }

    fn formula_surface(&self, text: &str) -> anyhow::Result<SceneSurface> {
        let mut constants = BTreeMap::new();
        for (name, value) in &self.constants {
            if constants.insert(name.clone(), *value).is_some() {
                bail!("the constant `{name}` is given twice");
            }
        }
        let level = self.level.unwrap_or(0.0);
        Ok(SceneSurface::Formula { text: text.to_owned(), constants, level })
    }
}
