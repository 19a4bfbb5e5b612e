//! The tension of each face: a number, or a file.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use smoothpatch::apatch::rational::ShapeControl;

use crate::output_files::extension;
use crate::values::finite;

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Tension {
    Uniform(f64),
    File(PathBuf),
}

impl Tension {
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        match extension(Path::new(text)).as_str() {
            "ron" | "json" => Ok(Self::File(text.into())),
            _ => match finite(text) {
                Ok(tension) if tension >= -1.0 => Ok(Self::Uniform(tension)),
                Ok(_) => Err("a tension is at least -1".into()),
                Err(_) => {
                    Err("give a number from -1 on, or the name of a .ron or .json file".into())
                }
            },
        }
    }

    pub(crate) fn file(&self) -> Option<&Path> {
        match self {
            Self::Uniform(_) => None,
            Self::File(path) => Some(path),
        }
    }

    pub(crate) fn read(&self) -> anyhow::Result<ShapeControl> {
        let path = match self {
            Self::Uniform(tension) => return Ok(ShapeControl::uniform(*tension)),
            Self::File(path) => path,
        };
        let name = path.display();
        let text =
            std::fs::read_to_string(path).map_err(|e| anyhow!("{name}: cannot read: {e}"))?;
        if extension(path) == "json" {
            serde_json::from_str(&text).map_err(|error| anyhow!("{name}: {error}"))
        } else {
            ron::from_str(&text).map_err(|error| anyhow!("{name}: {error}"))
        }
    }
}
