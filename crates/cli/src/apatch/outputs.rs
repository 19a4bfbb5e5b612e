//! The files of a surface.

use smoothpatch::apatch::Tessellation;
use smoothpatch::apatch::rational::RationalSurface;
use smoothpatch::apatch_surface::{RationalFigures, grid, triangles};
use smoothpatch::io::{Encoding, write_grid, write_obj_tessellation};

use crate::output_files::{Format, OutputFiles, Written, write_file};

/// What was written.
pub(crate) struct Outputs {
    pub(crate) files: Vec<Written>,
    /// Number of flat triangles.
    pub(crate) triangles: usize,
    /// Points of the triangles that are on the mesh instead of the surface.
    pub(crate) missing: usize,
}

impl Outputs {
    /// Writes the surface in all formats asked for, with `density` steps along each side of a face.
    pub(crate) fn write(
        files: &OutputFiles,
        surface: &RationalSurface,
        figures: Option<&RationalFigures>,
        density: usize,
    ) -> anyhow::Result<Self> {
        let mesh: Tessellation = surface.tessellate(density, density.div_ceil(2));
        let mut written = Vec::new();
        for (format, path) in &files.surfaces {
            written.push(match format {
                Format::Vtu => {
                    let grid = grid(surface, &mesh, figures);
                    write_file(path, |out| Ok(write_grid(out, &grid, Encoding::default())?))?
                }
                Format::Obj => {
                    let triangles = triangles(&mesh);
                    write_file(path, |out| Ok(write_obj_tessellation(out, &triangles)?))?
                }
            });
        }
        Ok(Self { files: written, triangles: mesh.triangles.len(), missing: mesh.missing })
    }
}
