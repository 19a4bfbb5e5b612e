//! The files of a curved mesh.

use std::path::Path;

use anyhow::anyhow;
use smoothpatch::basemesh::{EdgeId, FaceId};
use smoothpatch::io::{
    CellData, CellValues, Encoding, Grid, PatchSurface, write_grid, write_obj_creased, write_step,
};
use smoothpatch::nagata::{Continuity, NagataSurface};
use smoothpatch::nagata_surface::{
    CurvedGrid, ExactError, NagataFigures, curved_grid, flat_gap, patch_surface, samples,
};

use super::NagataArguments;
use super::options::CellName;
use crate::output_files::{Format, OutputFiles, Written, write_file};

/// A file, and how far what it holds is from the patches if it does not hold them exactly.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenSurface {
    pub(crate) file: Written,
    pub(crate) approximation: Option<Approximation>,
}

/// What stands in a file instead of the patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Approximation {
    /// "flat triangles" or so.
    pub(crate) cells: &'static str,
    pub(crate) count: usize,
    /// Largest distance that was measured. Unit: length.
    pub(crate) gap: f64,
}

/// Writes the surface in all formats asked for.
pub(crate) fn write(
    files: &OutputFiles,
    surface: &NagataSurface,
    figures: &NagataFigures,
    arguments: &NagataArguments,
) -> anyhow::Result<Vec<WrittenSurface>> {
    let (cells, divisions) = (arguments.cells, arguments.divisions);
    let mut written = Vec::new();
    for (format, path) in &files.surfaces {
        written.push(match format {
            Format::Vtu => {
                let (grid, approximation) = grid(surface, figures, cells, divisions);
                let file =
                    write_file(path, |out| Ok(write_grid(out, &grid, Encoding::default())?))?;
                WrittenSurface { file, approximation }
            }
            Format::Step => {
                let patches = exact(surface, path)?;
                let options = arguments.formats.step(path);
                let file = write_file(path, |out| {
                    write_step(out, &patches, &options)?;
                    Ok(())
                })?;
                WrittenSurface { file, approximation: None }
            }
            Format::Obj => {
                let samples = samples(surface, divisions);
                let triangles = samples.tessellation();
                let file = write_file(path, |out| Ok(write_obj_creased(out, &triangles)?))?;
                let (count, gap) = (triangles.triangles.len(), flat_gap(surface, &samples));
                let cells = "flat triangles";
                WrittenSurface { file, approximation: Some(Approximation { cells, count, gap }) }
            }
        });
    }
    Ok(written)
}

/// The patches of a C0 surface for a file that holds them exactly.
fn exact(surface: &NagataSurface, path: &Path) -> anyhow::Result<PatchSurface> {
    patch_surface(surface).map_err(|error| {
        let hint = match error {
            ExactError::Rational => ", which is all that .step files hold; use --continuity c0",
            _ => "",
        };
        anyhow!("cannot write {}: {error}{hint}", path.display())
    })
}

fn grid(
    surface: &NagataSurface,
    figures: &NagataFigures,
    cells: CellName,
    divisions: usize,
) -> (Grid, Option<Approximation>) {
    let (mut grid, cells_of_face, approximation) = match cells {
        CellName::Quadratic => {
            let CurvedGrid { grid, cells_of_face, gap } = curved_grid(surface, divisions);
            let is_exact = surface.settings().continuity == Continuity::Position;
            let (cells, count) = ("quadratic cells", grid.cells.len());
            (grid, cells_of_face, (!is_exact).then_some(Approximation { cells, count, gap }))
        }
        CellName::Flat => {
            let samples = samples(surface, divisions);
            let (grid, cells_of_face) = samples.flat_grid();
            let (cells, count) = ("flat triangles", grid.cells.len());
            let gap = flat_gap(surface, &samples);
            (grid, cells_of_face, Some(Approximation { cells, count, gap }))
        }
    };
    let face_of: Vec<usize> = (0..)
        .zip(cells_of_face)
        .flat_map(|(face, count)| std::iter::repeat_n(face, count))
        .collect();
    grid.cell_data = cell_data(surface, figures, &face_of);
    (grid, approximation)
}

/// The figures of the face that each cell belongs to; for edges the largest of the face.
fn cell_data(surface: &NagataSurface, figures: &NagataFigures, face_of: &[usize]) -> Vec<CellData> {
    let mesh = surface.mesh();
    let floats = |value: &dyn Fn(FaceId) -> f64| {
        let of_face: Vec<f64> = mesh.faces().map(value).collect();
        CellValues::Float64(face_of.iter().map(|&face| of_face[face]).collect())
    };
    let largest = |face: FaceId, of_edge: &dyn Fn(EdgeId) -> f64| {
        mesh.sides(face).map(|side| of_edge(mesh.edge(side))).fold(0.0, f64::max)
    };
    let integer = |&face: &usize| i64::try_from(face).expect("invariant: face ids fit 32 bits");
    let folded = |&face: &usize| i64::from(figures.folded[FaceId::new(face)]);
    let kink = |edge| figures.kinks[edge].to_degrees();
    let mut data = vec![
        ("face", CellValues::Int64(face_of.iter().map(integer).collect())),
        ("folded", CellValues::Int64(face_of.iter().map(folded).collect())),
        ("edge_kink_deg", floats(&|face| largest(face, &kink))),
        ("edge_misfit", floats(&|face| largest(face, &|edge| figures.edges[edge].misfit))),
    ];
    if let Some(deviation) = &figures.deviation {
        let diagonal = mesh.diagonal();
        data.push(("deviation", floats(&|face| deviation[face].max / diagonal)));
        data.push(("normal_error_deg", floats(&|face| deviation[face].max_normal.to_degrees())));
    }
    data.into_iter().map(|(name, values)| CellData { name: name.to_owned(), values }).collect()
}
