//! The files of a curved mesh.

use std::path::Path;

use anyhow::anyhow;
use smoothpatch::basemesh::{EdgeId, FaceId};
use smoothpatch::io::{
    CellData, CellValues, ChordTessellation, CreasedTessellation, Encoding, Grid, PatchSurface,
    write_grid,
};
use smoothpatch::nagata::{Continuity, NagataSurface};
use smoothpatch::nagata_surface::{
    CurvedGrid, ExactError, NagataFigures, chord_tessellation, curved_grid, curved_mesh, flat_gap,
    patch_surface, samples,
};

use super::NagataArguments;
use super::options::CellName;
use crate::formats;
use crate::output_files::{Approximation, Format, OutputFiles, Written, write_file};

/// Writes the surface in all formats asked for.
pub(crate) fn write(
    files: &OutputFiles,
    surface: &NagataSurface,
    figures: &NagataFigures,
    arguments: &NagataArguments,
) -> anyhow::Result<Vec<Written>> {
    let (cells, divisions) = (arguments.cells, arguments.divisions);
    let formats = &arguments.formats;
    let mut written = Vec::new();
    for (format, path) in &files.surfaces {
        written.push(match format {
            Format::Vtu => {
                let (grid, approximation) = grid(surface, figures, cells, divisions);
                let file =
                    write_file(path, |out| Ok(write_grid(out, &grid, Encoding::default())?))?;
                Written { approximation, ..file }
            }
            Format::Step => formats::step(path, &exact(surface, path)?, formats, arguments.quiet)?,
            Format::Msh => {
                let order = formats.order.unwrap_or(2);
                let (mesh, gap) = curved_mesh(surface, order);
                let gap = (!is_exact(surface) || order < 2).then_some(gap);
                formats::msh(path, &mesh, gap, formats)?
            }
            Format::Triangles(format) => {
                let (triangles, gap) = triangles(surface, divisions, formats.chord_tolerance)?;
                formats::triangles(path, *format, &triangles, gap)?
            }
        });
    }
    Ok(written)
}

/// Whether the patches are quadratic polynomials.
fn is_exact(surface: &NagataSurface) -> bool {
    surface.settings().continuity == Continuity::Position
}

/// Flat triangles, and how far they are from the patches.
fn triangles(
    surface: &NagataSurface,
    divisions: usize,
    chord_tolerance: Option<f64>,
) -> anyhow::Result<(CreasedTessellation, f64)> {
    if let Some(tolerance) = chord_tolerance {
        let length = tolerance * surface.mesh().diagonal();
        let ChordTessellation { tessellation, gap, .. } = chord_tessellation(surface, length)?;
        return Ok((tessellation, gap));
    }
    let samples = samples(surface, divisions);
    let gap = flat_gap(surface, &samples);
    Ok((samples.tessellation(), gap))
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
            let (kind, count) = ("quadratic cells", grid.cells.len());
            (
                grid,
                cells_of_face,
                (!is_exact(surface)).then_some(Approximation { kind, count, gap }),
            )
        }
        CellName::Flat => {
            let samples = samples(surface, divisions);
            let (grid, cells_of_face) = samples.flat_grid();
            let (kind, count) = ("flat triangles", grid.cells.len());
            let gap = flat_gap(surface, &samples);
            (grid, cells_of_face, Some(Approximation { kind, count, gap }))
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
