//! Files that are written in the same way for every kind of surface.

use std::path::Path;

use smoothpatch::io::{
    CreasedTessellation, CurvedMesh, PatchSurface, write_glb, write_msh, write_obj_creased,
    write_ply, write_step, write_stl,
};

use crate::format_options::FormatOptions;
use crate::output_files::{Approximation, TriangleFormat, Written, write_file};

/// Writes patches as STEP.
pub(crate) fn step(
    path: &Path,
    patches: &PatchSurface,
    options: &FormatOptions,
) -> anyhow::Result<Written> {
    let options = options.step(path);
    write_file(path, |out| Ok(write_step(out, patches, &options).map(drop)?))
}

/// Writes curved elements for Gmsh; `gap` is their distance from the patches, if they are not exact.
pub(crate) fn msh(
    path: &Path,
    mesh: &CurvedMesh,
    gap: Option<f64>,
    options: &FormatOptions,
) -> anyhow::Result<Written> {
    let written = write_file(path, |out| Ok(write_msh(out, mesh, &options.msh())?))?;
    let count = mesh.counts().into_iter().sum();
    Ok(match gap {
        Some(gap) => written.holding(Approximation { kind: "curved elements", count, gap }),
        None => written,
    })
}

/// Writes flat triangles; `gap` is their distance from the patches.
pub(crate) fn triangles(
    path: &Path,
    format: TriangleFormat,
    triangles: &CreasedTessellation,
    gap: f64,
) -> anyhow::Result<Written> {
    let written = write_file(path, |out| {
        match format {
            TriangleFormat::Obj => write_obj_creased(out, triangles)?,
            TriangleFormat::Ply => write_ply(out, triangles)?,
            TriangleFormat::Stl => write_stl(out, triangles)?,
            TriangleFormat::Glb => write_glb(out, triangles)?,
        }
        Ok(())
    })?;
    let count = triangles.triangles.len();
    Ok(written.holding(Approximation { kind: "flat triangles", count, gap }))
}
