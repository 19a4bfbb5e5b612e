//! An error together with the file it was found in.

use std::fmt::{self, Display};
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// What is wrong with the contents of a file, and which file it is.
#[derive(Clone, Debug, PartialEq, Error)]
pub struct InFile<E: Display> {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: E,
}

impl<E: Display> Display for InFile<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.problem)
    }
}

/// Reads the file at `path` whole and hands its bytes to `parse`; whatever goes wrong names the
/// file.
pub(crate) fn parse_file<T, E: Display + From<io::Error>>(
    path: &Path,
    parse: impl FnOnce(&[u8]) -> Result<T, E>,
) -> Result<T, InFile<E>> {
    std::fs::read(path)
        .map_err(E::from)
        .and_then(|bytes| parse(&bytes))
        .map_err(|problem| InFile { path: path.to_owned(), problem })
}
