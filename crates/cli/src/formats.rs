//! Files that are written in the same way for every kind of surface.

use std::path::Path;

use smoothpatch::io::{
    CreasedTessellation, CurvedMesh, PatchSurface, StepSize, step_size, write_glb, write_msh,
    write_obj_creased, write_ply, write_step, write_stl,
};

use crate::exit::complain;
use crate::format_options::FormatOptions;
use crate::output_files::{Approximation, TriangleFormat, Written, write_file};
use crate::table::bytes;

/// CAD programs read about a hundred patches of degree 7 in a second.
const MANY_PATCHES: usize = 10_000;

/// Seconds or minutes.
fn duration(seconds: u64) -> String {
    match seconds {
        0..120 => format!("about {} seconds", seconds.max(1)),
        _ => format!("about {} minutes", seconds.div_ceil(60)),
    }
}

/// Writes patches as STEP. With very many of them a warning says what that means.
pub(crate) fn step(
    path: &Path,
    patches: &PatchSurface,
    options: &FormatOptions,
    quiet: bool,
) -> anyhow::Result<Written> {
    let options = options.step(path);
    let count = patches.faces().len();
    if count > MANY_PATCHES && !quiet {
        let StepSize { faces, bytes: size, reading_seconds } = step_size(patches, options.faces);
        complain(&format!(
            "warning: {}: {count} patches become {faces} faces and about {}, which CAD programs \
             take {} to read; take fewer patches, or --step-faces degenerate for a third of that",
            path.display(),
            bytes(size),
            duration(reading_seconds)
        ));
    }
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
