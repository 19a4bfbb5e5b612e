//! The files that are written: checked before the long work, written whole or not at all.

use std::io::{self, Write};
use std::path::{Path, PathBuf, absolute};

use anyhow::bail;
use serde::Serialize;
use smoothpatch::G1Surface;
use smoothpatch::basemesh::FaceMap;
use smoothpatch::io::{
    CellData, CellKind, CellValues, VtuOptions, WriteError, tessellate, write_atomically,
    write_obj_tessellation, write_vtu,
};
use smoothpatch::measure::FaceDeviation;

use super::FitArguments;

/// What is written and where.
pub(crate) struct Outputs {
    surfaces: Vec<(Format, PathBuf)>,
    report: Option<PathBuf>,
    cells: CellKind,
    divisions: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Vtu,
    Obj,
}

/// A file that is complete.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Written {
    pub(crate) file: PathBuf,
    pub(crate) bytes: u64,
}

impl Outputs {
    /// What the options ask for; only names are looked at.
    pub(crate) fn new(arguments: &FitArguments) -> anyhow::Result<Self> {
        let surfaces = arguments
            .outputs
            .iter()
            .map(|path| Ok((format_of(path)?, path.clone())))
            .collect::<anyhow::Result<Vec<_>>>()?;
        if let Some(path) = &arguments.report
            && extension(path) != "json"
        {
            bail!("--report {}: the name of a report must end with .json", path.display());
        }
        let report = arguments.report.clone();
        let (cells, divisions) = (arguments.cells.into(), arguments.divisions);
        Ok(Self { surfaces, report, cells, divisions })
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.surfaces.iter().map(|(_, path)| path).chain(&self.report)
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

    /// Writes the surface in all formats asked for.
    pub(crate) fn write(
        &self,
        surface: &G1Surface,
        faces: &FaceMap<FaceDeviation>,
    ) -> anyhow::Result<Vec<Written>> {
        let (topology, nets) = (surface.mesh.topology(), &surface.patches.nets);
        let vtu = VtuOptions {
            cells: self.cells,
            cell_data: cell_data(faces, surface.mesh.diagonal()),
            ..VtuOptions::default()
        };
        let mut written = Vec::new();
        for (format, path) in &self.surfaces {
            written.push(match format {
                Format::Vtu => write_file(path, |out| Ok(write_vtu(out, topology, nets, &vtu)?))?,
                Format::Obj => {
                    let triangles = tessellate(topology, nets, self.divisions);
                    write_file(path, |out| Ok(write_obj_tessellation(out, &triangles)?))?
                }
            });
        }
        Ok(written)
    }
}

/// Writes one file whole, or leaves everything as it was.
pub(crate) fn write_file(
    path: &Path,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> anyhow::Result<Written> {
    write_atomically(path, contents)?;
    Ok(Written { file: path.to_owned(), bytes: path.metadata()?.len() })
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

fn format_of(path: &Path) -> anyhow::Result<Format> {
    match extension(path).as_str() {
        "vtu" => Ok(Format::Vtu),
        "obj" => Ok(Format::Obj),
        _ => bail!(
            "-o {}: the name must end with .vtu (patches) or .obj (triangles)",
            path.display()
        ),
    }
}

fn extension(path: &Path) -> String {
    path.extension().map(|text| text.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

fn cell_data(faces: &FaceMap<FaceDeviation>, diagonal: f64) -> Vec<CellData> {
    let floats = |value: &dyn Fn(&FaceDeviation) -> f64| {
        CellValues::Float64(faces.as_slice().iter().map(value).collect())
    };
    let folded = faces.as_slice().iter().map(|face| i64::from(face.folded)).collect();
    [
        ("deviation", floats(&|face| face.max / diagonal)),
        ("normal_error_deg", floats(&|face| face.max_normal.to_degrees())),
        ("folded", CellValues::Int64(folded)),
    ]
    .map(|(name, values)| CellData { name: name.to_owned(), values })
    .into()
}
