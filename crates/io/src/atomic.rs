//! Files that are there whole or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};
use thiserror::Error;

const BUFFER_BYTES: usize = 1 << 18;

/// Why a file was not written. Whatever was at its place before is still there.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// There is no directory to put the file in.
    #[error("cannot write {}: there is no directory {}; create it first", path.display(), directory.display())]
    MissingDirectory {
        /// The file to be written.
        path: PathBuf,
        /// The missing directory.
        directory: PathBuf,
    },
    /// Something that is not a file has this name.
    #[error("cannot write {}: it exists and is not a regular file; choose another name", path.display())]
    NotAFile {
        /// The file to be written.
        path: PathBuf,
    },
    /// Writing failed, in the operating system or in the function that makes the contents.
    #[error("cannot write {}: {cause}", path.display())]
    Failed {
        /// The file to be written.
        path: PathBuf,
        /// The reason.
        cause: io::Error,
    },
}

/// Creates or replaces the file at `path` with what `contents` writes.
///
/// Everything goes through a buffer into a temporary file in the same directory, which takes the
/// name `path` in one step when it is complete and on the disk. If `contents` or the operating
/// system fails, nothing is left behind and a file that was there before is untouched. A symbolic
/// link at `path` is replaced, not followed. New files get the usual permissions of the user,
/// replaced files keep theirs.
///
/// # Errors
///
/// [`WriteError`], always with the path.
pub fn write_atomically(
    path: impl AsRef<Path>,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !directory.is_dir() {
        let (path, directory) = (path.to_owned(), directory.to_owned());
        return Err(WriteError::MissingDirectory { path, directory });
    }
    let replaced = fs::metadata(path).ok();
    if replaced.as_ref().is_some_and(|existing| !existing.is_file()) {
        return Err(WriteError::NotAFile { path: path.to_owned() });
    }
    fill_and_rename(path, directory, replaced, contents)
        .map_err(|cause| WriteError::Failed { path: path.to_owned(), cause })
}

fn fill_and_rename(
    path: &Path,
    directory: &Path,
    replaced: Option<fs::Metadata>,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // removes itself when dropped before it is renamed
    let file = temporary_in(directory)?;
    let mut buffer = BufWriter::with_capacity(BUFFER_BYTES, file);
    contents(&mut buffer)?;
    let file = buffer.into_inner().map_err(io::IntoInnerError::into_error)?;
    if let Some(existing) = replaced {
        file.as_file().set_permissions(existing.permissions())?;
    }
    file.as_file().sync_all()?;
    file.persist(path).map_err(|failure| failure.error)?;
    Ok(())
}

fn temporary_in(directory: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".unfinished-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // narrowed by the user's umask; the default would be a file that nobody else can read
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(directory)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(directory)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn creates_and_replaces() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.txt");
        for text in ["first", "second, longer"] {
            write_atomically(&path, |out| out.write_all(text.as_bytes())).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(names(directory.path()), ["a.txt"]);
    }

    #[test]
    fn failure_leaves_nothing_and_keeps_the_old_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.txt");
        let fail = |out: &mut dyn Write| {
            out.write_all(&vec![b'x'; 3 * BUFFER_BYTES])?;
            Err(io::Error::other("ran out of ideas"))
        };
        let error = write_atomically(&path, fail).unwrap_err();
        assert!(error.to_string().ends_with("a.txt: ran out of ideas"), "{error}");
        assert_eq!(names(directory.path()), [""; 0]);

        fs::write(&path, "old").unwrap();
        write_atomically(&path, fail).unwrap_err();
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(directory.path()), ["a.txt"]);
    }

    #[test]
    fn a_panic_leaves_nothing() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.txt");
        let outcome = std::panic::catch_unwind(|| {
            write_atomically(&path, |_| panic!("on purpose")).unwrap();
        });
        assert!(outcome.is_err());
        assert_eq!(names(directory.path()), [""; 0]);
    }

    #[test]
    fn bad_places_are_named() {
        let directory = tempfile::tempdir().unwrap();
        let missing = directory.path().join("no/such/a.txt");
        let message = write_atomically(&missing, |_| Ok(())).unwrap_err().to_string();
        assert!(message.ends_with("no/such; create it first"), "{message}");
        let message = write_atomically(directory.path(), |_| Ok(())).unwrap_err().to_string();
        assert!(message.contains("not a regular file"), "{message}");
    }

    #[cfg(unix)]
    #[test]
    fn permissions_of_a_replaced_file_stay() {
        use std::os::unix::fs::PermissionsExt;
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.txt");
        let mode = || fs::metadata(&path).unwrap().permissions().mode() & 0o777;
        write_atomically(&path, |_| Ok(())).unwrap();
        assert_ne!(mode() & 0o400, 0);
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        write_atomically(&path, |_| Ok(())).unwrap();
        assert_eq!(mode(), 0o640);
    }
}
