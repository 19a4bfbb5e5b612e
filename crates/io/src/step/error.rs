//! Why a STEP file was not written.

use std::io;

use thiserror::Error;

use crate::patch_surface::PatchSurfaceError;

/// Why a STEP file was not written. Nothing was written before the error, except for
/// [`StepError::Io`].
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StepError {
    /// The operating system failed.
    #[error("cannot write: {0}")]
    Io(#[from] io::Error),
    /// A surface without faces has no shell.
    #[error("there are no faces to write")]
    NoFaces,
    /// A degree that readers refuse.
    #[error("the patches have degree {degree}; at most {limit} can be written")]
    Degree {
        /// The degree of the patches.
        degree: usize,
        /// The largest that is written.
        limit: usize,
    },
    /// An uncertainty that is no length.
    #[error("the uncertainty {value} is not a positive number")]
    Uncertainty {
        /// The value.
        value: f64,
    },
    /// The faces are no shells.
    #[error(transparent)]
    Surface(#[from] PatchSurfaceError),
}

impl From<StepError> for io::Error {
    fn from(error: StepError) -> Self {
        match error {
            StepError::Io(cause) => cause,
            other => Self::new(io::ErrorKind::InvalidInput, other),
        }
    }
}
