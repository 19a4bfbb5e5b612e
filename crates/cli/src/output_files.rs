//! The files that are written: checked before the long work, written whole or not at all.

use std::io::{self, Write};
use std::path::{Path, PathBuf, absolute};

use anyhow::bail;
use serde::Serialize;
use smoothpatch::io::{WriteError, write_atomically};

use crate::table::{Table, bytes, of_diagonal};

/// Where results go.
pub(crate) struct OutputFiles {
    pub(crate) surfaces: Vec<(Format, PathBuf)>,
    pub(crate) report: Option<PathBuf>,
    /// Patches of an earlier stage.
    pub(crate) before_join: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Vtu,
    Step,
    Msh,
    Triangles(TriangleFormat),
}

/// What the formats of a command can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
    /// Polynomial patches, or flat triangles.
    Patches,
    /// Flat triangles only: the surface has no polynomial patches.
    Triangles,
}

/// A format of flat triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TriangleFormat {
    Obj,
    Ply,
    Stl,
    Glb,
}

/// A file that is complete.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Written {
    pub(crate) file: PathBuf,
    pub(crate) bytes: u64,
    /// What stands in the file instead of the patches, if it does not hold them exactly.
    #[serde(flatten)]
    pub(crate) approximation: Option<Approximation>,
}

/// What stands in a file instead of the patches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Approximation {
    /// "flat triangles" or so.
    #[serde(skip)]
    pub(crate) kind: &'static str,
    /// Number of them.
    #[serde(rename = "cells")]
    pub(crate) count: usize,
    /// Largest distance from the patches that was measured. Unit: length.
    #[serde(rename = "sampling_deviation")]
    pub(crate) gap: f64,
}

impl Written {
    /// The same file, with what it holds.
    pub(crate) fn holding(self, approximation: Approximation) -> Self {
        Self { approximation: Some(approximation), ..self }
    }

    /// Lines of the table.
    pub(crate) fn rows(&self, table: &mut Table, diagonal: f64) {
        table.row("wrote", format!("{} ({})", self.file.display(), bytes(self.bytes)));
        if let Some(Approximation { kind, count, gap }) = self.approximation {
            table.row(
                "",
                format!("{count} {kind}, {} from the patches", of_diagonal(gap / diagonal)),
            );
        }
    }
}

impl OutputFiles {
    /// What the options ask for; only names are looked at.
    pub(crate) fn new(
        holds: Holds,
        surfaces: &[PathBuf],
        report: Option<&Path>,
    ) -> anyhow::Result<Self> {
        let surfaces = surfaces
            .iter()
            .map(|path| Ok((format_of(path, holds)?, path.clone())))
            .collect::<anyhow::Result<Vec<_>>>()?;
        if let Some(path) = report
            && extension(path) != "json"
        {
            bail!("--report {}: the name of a report must end with .json", path.display());
        }
        Ok(Self { surfaces, report: report.map(Path::to_owned), before_join: None })
    }

    /// Also the patches before they are joined.
    pub(crate) fn with_before_join(self, path: Option<&Path>) -> anyhow::Result<Self> {
        if let Some(path) = path
            && extension(path) != "vtu"
        {
            bail!("--before-join {}: the name must end with .vtu", path.display());
        }
        Ok(Self { before_join: path.map(Path::to_owned), ..self })
    }

    /// One table, which is written by name alone.
    pub(crate) fn table(path: &Path) -> anyhow::Result<Self> {
        if extension(path) != "csv" {
            bail!("-o {}: the name of a table must end with .csv", path.display());
        }
        Ok(Self::single(path))
    }

    /// One file of another kind.
    pub(crate) fn single(path: &Path) -> Self {
        Self { surfaces: Vec::new(), report: Some(path.to_owned()), before_join: None }
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.surfaces.iter().map(|(_, path)| path).chain(&self.report).chain(&self.before_join)
    }

    /// Checks that every file can be written.
    pub(crate) fn check_places(&self) -> anyhow::Result<()> {
        Ok(self.files().try_for_each(|path| try_to_write(path))?)
    }

    /// Checks that every file is written once and is no input.
    pub(crate) fn check_distinct(&self, inputs: Vec<&Path>) -> anyhow::Result<()> {
        let mut taken = inputs.into_iter().map(absolute).collect::<Result<Vec<_>, _>>()?;
        let inputs = taken.len();
        for path in self.files() {
            let place = absolute(path)?;
            match taken.iter().position(|other| *other == place) {
                Some(at) if at < inputs => {
                    bail!("{} is read; it would be overwritten with a result", path.display())
                }
                Some(_) => bail!("{} would be written twice", path.display()),
                None => {}
            }
            taken.push(place);
        }
        Ok(())
    }
}

/// Writes one file whole, or leaves everything as it was.
pub(crate) fn write_file(
    path: &Path,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> anyhow::Result<Written> {
    write_atomically(path, contents)?;
    Ok(Written { file: path.to_owned(), bytes: path.metadata()?.len(), approximation: None })
}

/// Everything that writing does before and after the contents are made.
fn try_to_write(path: &Path) -> Result<(), WriteError> {
    let mut open = false;
    let outcome = write_atomically(path, |_| {
        open = true;
        Err(io::Error::other("only a trial"))
    });
    if open { Ok(()) } else { outcome }
}

fn format_of(path: &Path, holds: Holds) -> anyhow::Result<Format> {
    let (name, patches) = (path.display(), holds == Holds::Patches);
    match extension(path).as_str() {
        "vtu" => Ok(Format::Vtu),
        "step" | "stp" if patches => Ok(Format::Step),
        "msh" if patches => Ok(Format::Msh),
        "step" | "stp" | "msh" => bail!("-o {name}: {NO_POLYNOMIALS}"),
        "obj" => Ok(Format::Triangles(TriangleFormat::Obj)),
        "ply" => Ok(Format::Triangles(TriangleFormat::Ply)),
        "stl" => Ok(Format::Triangles(TriangleFormat::Stl)),
        "glb" => Ok(Format::Triangles(TriangleFormat::Glb)),
        _ if patches => bail!(
            "-o {name}: the name must end with .vtu, .step or .msh (patches), or with .obj, .ply, \
             .stl or .glb (triangles)"
        ),
        _ => bail!("-o {name}: the name must end with .vtu, .obj, .ply, .stl or .glb"),
    }
}

const NO_POLYNOMIALS: &str = "files of this kind hold polynomial patches, which A-patches are not; use \
                              .vtu, .obj, .ply, .stl or .glb";

pub(crate) fn extension(path: &Path) -> String {
    path.extension().map(|text| text.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}
