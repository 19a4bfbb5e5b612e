//! `smoothpatch apatch` with `--scheme c1-cubic` or `c2-quintic`: solids with planar faces.

mod summary;

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{anyhow, bail};
use clap::Args;
use serde::Serialize;
use smoothpatch::apatch::polyhedral::{
    HullSettings, Joints, Planarity, PolyhedralSurface, Polyhedron, Report, Sampled, Scheme,
    Settings, ShapeControl,
};
use smoothpatch::io::{
    CreasedTessellation, Encoding, write_glb, write_grid, write_obj_creased, write_ply, write_stl,
};
use smoothpatch::solid_surface::{curvature_grid, mesh_of, read_weights, solid, write_weights};

use super::tension::Tension;
use crate::exit::{Outcome, complain};
use crate::output_files::{Format, OutputFiles, TriangleFormat, Written, extension, write_file};
use crate::progress::WorkLine;
use crate::stdout::print;
use summary::{summary, warnings};

/// What only solids have.
#[derive(Args)]
#[group(skip)]
pub(crate) struct SolidOptions {
    /// How far the surface goes into corners of more than three edges, between 0 (cut off) and 1
    /// (the corner itself); only with the schemes for solids [default: as for a quadric]
    #[arg(long, value_name = "A", value_parser = crate::values::share)]
    cut: Option<f64>,

    /// Also write all tetrahedra with their weights, as JSON; only with the schemes for solids
    #[arg(long, value_name = "FILE.json")]
    weights: Option<PathBuf>,
}

impl SolidOptions {
    /// Whether any option of solids is given.
    pub(crate) fn is_used(&self) -> bool {
        self.cut.is_some() || self.weights.is_some()
    }
}

/// A solid to be rounded off.
pub(crate) struct Order<'a> {
    pub(crate) solid: &'a Path,
    pub(crate) scheme: Scheme,
    pub(crate) options: &'a SolidOptions,
    pub(crate) tension: &'a Tension,
    pub(crate) density: usize,
    pub(crate) quiet: bool,
}

impl Order<'_> {
    fn settings(&self) -> anyhow::Result<Settings> {
        let tension = self.tension.read()?;
        if self.scheme == Scheme::C2Quintic && (tension.tension != 0.0 || !tension.faces.is_empty())
        {
            bail!("--tension: the quintic is the fairest surface; use --scheme c1-cubic");
        }
        let shape = ShapeControl {
            tension: tension.tension,
            faces: tension.faces,
            ..ShapeControl::default()
        };
        let hull = HullSettings { alpha: self.options.cut, ..HullSettings::default() };
        Ok(Settings { scheme: self.scheme, hull, shape, ..Settings::default() })
    }
}

pub(crate) fn run(order: &Order<'_>, files: &OutputFiles) -> anyhow::Result<Outcome> {
    let settings = order.settings()?;
    if let Some(path) = &order.options.weights {
        if extension(path) != "json" {
            bail!("--weights {}: the name must end with .json", path.display());
        }
        OutputFiles::single(path).check_places()?;
        OutputFiles::single(path).check_distinct(vec![order.solid])?;
    }
    let start = Instant::now();
    let line = WorkLine::new(order.quiet, "build");
    let solid = solid(order.solid, &Planarity::default())?;
    let surface = PolyhedralSurface::new(&solid, &settings)
        .map_err(|error| anyhow!("{}: {error}", order.solid.display()))?;
    drop(line);
    let built = start.elapsed().as_secs_f64();
    let made = Made::new(&solid, &settings);
    let show = Show { name: order.solid, density: order.density, quiet: order.quiet, built };
    show.write(files, &surface, Some(made), order.options.weights.as_deref())
}

/// The surface in a file with tetrahedra and weights.
pub(crate) fn load(
    path: &Path,
    density: usize,
    quiet: bool,
    files: &OutputFiles,
) -> anyhow::Result<Outcome> {
    let start = Instant::now();
    let wrong = |error: &dyn std::fmt::Display| anyhow!("{}: {error}", path.display());
    let file = File::open(path).map_err(|error| wrong(&format!("cannot read: {error}")))?;
    let surface = read_weights(&mut BufReader::new(file)).map_err(|error| wrong(&error))?;
    let built = start.elapsed().as_secs_f64();
    Show { name: path, density, quiet, built }.write(files, &surface, None, None)
}

/// How a surface is shown.
struct Show<'a> {
    name: &'a Path,
    density: usize,
    quiet: bool,
    /// Seconds.
    built: f64,
}

impl Show<'_> {
    /// Measures the surface and writes all files.
    fn write(
        &self,
        files: &OutputFiles,
        surface: &PolyhedralSurface,
        made: Option<Made<'_>>,
        weights: Option<&Path>,
    ) -> anyhow::Result<Outcome> {
        let start = Instant::now();
        let joints = surface.joints();
        let sampled = surface.sample(self.density, self.density.div_ceil(2));
        let measured = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let mut written = write(files, surface, &sampled)?;
        if let Some(path) = weights {
            written.push(write_file(path, |out| {
                write_weights(out, surface).map_err(std::io::Error::other)
            })?);
        }
        if let Some(path) = &files.report {
            let text = serde_json::to_string_pretty(&ReportFile {
                program: concat!("smoothpatch ", env!("CARGO_PKG_VERSION")),
                input: self.name,
                made,
                surface_volume: sampled.mesh.signed_volume(),
                construction: surface.report(),
                joints,
                triangles: sampled.mesh.triangles.len(),
                flipped_triangles: sampled.mesh.flipped_facets(),
                points_not_on_surface: sampled.mesh.missing,
                files: &written,
            })? + "\n";
            written.push(write_file(path, |out| out.write_all(text.as_bytes()))?);
        }
        if !self.quiet {
            let seconds = [self.built, measured, start.elapsed().as_secs_f64()];
            print(&summary(self.name, surface, joints, &sampled, &written, seconds))?;
            for warning in warnings(surface, &sampled) {
                complain(&format!("warning: {warning}"));
            }
        }
        Ok(Outcome::Success)
    }
}

fn write(
    files: &OutputFiles,
    surface: &PolyhedralSurface,
    sampled: &Sampled,
) -> anyhow::Result<Vec<Written>> {
    let mut written = Vec::new();
    for (format, path) in &files.surfaces {
        written.push(match format {
            Format::Vtu => {
                let grid = curvature_grid(surface, sampled);
                write_file(path, |out| Ok(write_grid(out, &grid, Encoding::default())?))?
            }
            Format::Triangles(format) => write_triangles(path, *format, &mesh_of(sampled).into())?,
            // refused before
            Format::Step | Format::Msh => continue,
        });
    }
    Ok(written)
}

/// Writes flat triangles that lie on the surface with their corners.
pub(crate) fn write_triangles(
    path: &Path,
    format: TriangleFormat,
    triangles: &CreasedTessellation,
) -> anyhow::Result<Written> {
    write_file(path, |out| {
        match format {
            TriangleFormat::Obj => write_obj_creased(out, triangles)?,
            TriangleFormat::Ply => write_ply(out, triangles)?,
            TriangleFormat::Stl => write_stl(out, triangles)?,
            TriangleFormat::Glb => write_glb(out, triangles)?,
        }
        Ok(())
    })
}

/// The solid under a surface, and what was asked for.
#[derive(Serialize)]
struct Made<'a> {
    settings: &'a Settings,
    faces: usize,
    edges: usize,
    euler_characteristic: isize,
    volume: f64,
}

impl<'a> Made<'a> {
    fn new(solid: &Polyhedron, settings: &'a Settings) -> Self {
        Self {
            settings,
            faces: solid.facets().len(),
            edges: solid.edge_count(),
            euler_characteristic: solid.euler_characteristic(),
            volume: solid.signed_volume(),
        }
    }
}

/// What was done and measured, and what was written.
#[derive(Serialize)]
struct ReportFile<'a> {
    program: &'static str,
    #[serde(rename = "solid")]
    input: &'a Path,
    #[serde(flatten)]
    made: Option<Made<'a>>,
    surface_volume: f64,
    construction: &'a Report,
    joints: Joints,
    triangles: usize,
    flipped_triangles: usize,
    points_not_on_surface: usize,
    files: &'a [Written],
}
