//! What can be wrong with a scene.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::{Method, Scene};

/// Why a scene cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The operating system failed.
    #[error("cannot read: {0}")]
    Io(#[from] io::Error),
    /// The file is not UTF-8.
    #[error("is not a text file in UTF-8")]
    NotText,
    /// Not RON, or not the fields of a scene; names what is allowed.
    #[error("{line}:{column}: {message}")]
    Syntax {
        /// Line in the text, from 1.
        line: usize,
        /// Column in the line, from 1.
        column: usize,
        /// What was expected and what was found.
        message: String,
    },
    /// The scene cannot be expressed in RON.
    #[error("cannot be written: {message}")]
    NotWritable {
        /// Why not.
        message: String,
    },
    /// A version that this program does not know.
    #[error("version {found} is not supported; supported is version {}", Scene::VERSION)]
    Version {
        /// The version in the scene.
        found: u32,
    },
    /// Fewer faces than a closed mesh has.
    #[error("faces is {faces}; a closed mesh has at least 4")]
    TooFewFaces {
        /// Number of faces asked for.
        faces: usize,
    },
    /// The region has no volume, or is not finite.
    #[error(
        "region runs from {min} to {max} in {axis}; give two finite numbers, the smaller in 'min'"
    )]
    Region {
        /// Name of the axis.
        axis: &'static str,
        /// Its lower end.
        min: f64,
        /// Its upper end.
        max: f64,
    },
    /// A base mesh that other people will not have at this place.
    #[error("base_mesh is the absolute path {}; write it relative to the scene file", path.display())]
    AbsoluteBaseMesh {
        /// The path.
        path: PathBuf,
    },
    /// A constant of a formula, or its level, is infinite or not a number.
    #[error("the constant '{name}' is {value}; give a finite number")]
    Constant {
        /// Name of the constant.
        name: String,
        /// Its value.
        value: f64,
    },
    /// A bound that no result or every result satisfies.
    #[error("the bound {name} of {method:?} is {value}; give a finite number that is not negative")]
    Bound {
        /// The method.
        method: Method,
        /// Name of the bound.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// An empty or infinite interval.
    #[error(
        "the bound {name} of {method:?} is ({low}, {high}); give two finite numbers that are not \
         negative, the smaller first"
    )]
    BoundInterval {
        /// The method.
        method: Method,
        /// Name of the bound.
        name: &'static str,
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
}

impl From<ron::error::SpannedError> for SceneError {
    fn from(error: ron::error::SpannedError) -> Self {
        let ron::error::Position { line, col: column } = error.span.start;
        let message = match error.code {
            ron::Error::MissingStructField { field, outer } => {
                let owner = outer.unwrap_or_else(|| "the scene".to_owned());
                format!("the field `{field}` of `{owner}` is missing before this place")
            }
            other => lower_case_start(&other.to_string()),
        };
        Self::Syntax { line, column, message }
    }
}

impl From<ron::Error> for SceneError {
    fn from(error: ron::Error) -> Self {
        Self::NotWritable { message: lower_case_start(&error.to_string()) }
    }
}

/// Our messages do not start with a capital; `RON` keeps its capitals.
fn lower_case_start(message: &str) -> String {
    let mut chars = message.chars();
    match (chars.next(), chars.clone().next()) {
        (Some(first), Some(second)) if !second.is_uppercase() => {
            first.to_lowercase().chain(chars).collect()
        }
        _ => message.to_owned(),
    }
}
