//! The files of a surface.

use smoothpatch::apatch::rational::RationalSurface;
use smoothpatch::apatch::{Element, Tessellation};
use smoothpatch::apatch_surface::{RationalFigures, flat_gap, grid, triangles};
use smoothpatch::io::{Encoding, write_grid};

use crate::formats;
use crate::output_files::{Approximation, Format, OutputFiles, Written, write_file};

/// What was written.
pub(crate) struct Outputs {
    pub(crate) files: Vec<Written>,
    /// Points of the triangles that are on the mesh instead of the surface.
    pub(crate) missing: usize,
    /// The face or edge of each triangle that looks the wrong way.
    pub(crate) flipped: Vec<Element>,
}

impl Outputs {
    /// Writes the surface in all formats asked for, with `density` steps along each side of a face.
    pub(crate) fn write(
        files: &OutputFiles,
        surface: &RationalSurface,
        figures: Option<&RationalFigures>,
        density: usize,
    ) -> anyhow::Result<Self> {
        let across = density.div_ceil(2);
        let mesh: Tessellation = surface.tessellate(density, across);
        let gap = flat_gap(surface, density, across);
        let (kind, count) = ("flat triangles", mesh.triangles.len());
        let mut written = Vec::new();
        for (format, path) in &files.surfaces {
            written.push(match format {
                Format::Vtu => {
                    let grid = grid(surface, &mesh, figures);
                    write_file(path, |out| Ok(write_grid(out, &grid, Encoding::default())?))?
                        .holding(Approximation { kind, count, gap })
                }
                Format::Triangles(format) => {
                    formats::triangles(path, *format, &triangles(&mesh), gap)?
                }
                // refused with the names of the files
                Format::Step | Format::Msh => continue,
            });
        }
        let flipped = mesh.flipped().map(|triangle| mesh.elements[triangle]).collect();
        Ok(Self { files: written, missing: mesh.missing, flipped })
    }
}
