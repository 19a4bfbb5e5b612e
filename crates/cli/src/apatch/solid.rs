//! `smoothpatch apatch` with `--scheme c1-cubic` or `c2-quintic`: solids with planar faces.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{anyhow, bail};
use clap::Args;
use serde::Serialize;
use smoothpatch::apatch::polyhedral::{
    Finding, HullSettings, Joints, Planarity, PolyhedralSurface, Report, Sampled, Scheme, Settings,
    ShapeControl,
};
use smoothpatch::io::{
    CreasedTessellation, Encoding, write_glb, write_grid, write_obj_creased, write_ply, write_stl,
};
use smoothpatch::solid_surface::{curvature_grid, mesh_of, solid, write_weights};

use super::tension::Tension;
use crate::exit::{Outcome, complain};
use crate::output_files::{Format, OutputFiles, TriangleFormat, Written, extension, write_file};
use crate::progress::WorkLine;
use crate::stdout::print;
use crate::table::{Table, bytes, degrees, length};

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
    for (format, path) in &files.surfaces {
        if matches!(format, Format::Step | Format::Msh) {
            bail!(
                "-o {}: A-patches are written as flat triangles: .vtu, .obj, .ply, .stl or .glb",
                path.display()
            );
        }
    }
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
    let start = Instant::now();
    let joints = surface.joints();
    let sampled = surface.sample(order.density, order.density.div_ceil(2));
    let measured = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let mut written = write(files, &surface, &sampled)?;
    if let Some(path) = &order.options.weights {
        written.push(write_file(path, |out| {
            write_weights(out, &surface).map_err(std::io::Error::other)
        })?);
    }
    if let Some(path) = &files.report {
        let text = serde_json::to_string_pretty(&ReportFile {
            program: concat!("smoothpatch ", env!("CARGO_PKG_VERSION")),
            solid: order.solid,
            settings: &settings,
            faces: solid.facets().len(),
            edges: solid.edge_count(),
            euler_characteristic: solid.euler_characteristic(),
            volume: solid.signed_volume(),
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
    if !order.quiet {
        let seconds = [built, measured, start.elapsed().as_secs_f64()];
        print(&summary(order, &surface, joints, &sampled, &written, seconds))?;
        for warning in warnings(&surface, &sampled) {
            complain(&format!("warning: {warning}"));
        }
    }
    Ok(Outcome::Success)
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

/// What was asked for, what was done and measured, and what was written.
#[derive(Serialize)]
struct ReportFile<'a> {
    program: &'static str,
    solid: &'a Path,
    settings: &'a Settings,
    faces: usize,
    edges: usize,
    euler_characteristic: isize,
    volume: f64,
    surface_volume: f64,
    construction: &'a Report,
    joints: Joints,
    triangles: usize,
    flipped_triangles: usize,
    points_not_on_surface: usize,
    files: &'a [Written],
}

/// `seconds`: building, measuring, writing.
fn summary(
    order: &Order<'_>,
    surface: &PolyhedralSurface,
    joints: Joints,
    sampled: &Sampled,
    written: &[Written],
    seconds: [f64; 3],
) -> String {
    let report = surface.report();
    let mut table = Table::default();
    let [convex, concave, straight] = report.edges;
    table.row("triangles of the hull", surface.hull().triangles.len());
    table.row("edges by kind", format!("{convex} convex, {concave} concave, {straight} straight"));
    let (faces, edges) = (report.face_tetrahedra, report.edge_tetrahedra);
    table.row("tetrahedra", format!("{faces} over triangles, {edges} over edges"));
    table.row("hulls tried", report.hulls);
    table.row("findings", report.findings.len());
    let [bad, rays] = report.bad_rays;
    table.row("bad rays", format!("{bad} of {rays}"));
    let [value, gradient] = [joints.value_jump, joints.gradient_jump].map(length);
    table.row("C1 residual", format!("{value} in value, {gradient} in gradient"));
    if order.scheme == Scheme::C2Quintic {
        table.row("C2 residual", length(joints.hessian_jump));
    }
    table.row("angle at joints", degrees(joints.normal_angle.to_degrees()));
    table.row("volume", format!("{:.6e}", sampled.mesh.signed_volume()));
    table.gap();
    for (stage, seconds) in ["build", "measure", "write"].into_iter().zip(seconds) {
        table.row(stage, format!("{seconds:.3} s"));
    }
    table.gap();
    for file in written {
        table.row("wrote", format!("{} ({})", file.file.display(), bytes(file.bytes)));
    }
    table.row("", format!("{} flat triangles", sampled.mesh.triangles.len()));
    let kind = match order.scheme {
        Scheme::C1Cubic => "C1 cubic A-patches",
        Scheme::C2Quintic => "C2 quintic A-patches",
    };
    format!("{}, {kind}\n{table}", order.solid.display())
}

/// One sentence for each kind of fault; none for a good result.
fn warnings(surface: &PolyhedralSurface, sampled: &Sampled) -> Vec<String> {
    let report = surface.report();
    let mut warnings = Vec::new();
    if let Some(first) = report.findings.first() {
        warnings.push(format!(
            "the tetrahedra do not fit together in {} places; first: {}",
            report.findings.len(),
            describe(first)
        ));
    }
    if report.bad_rays[0] > 0 {
        let [bad, all] = report.bad_rays;
        warnings.push(format!("{bad} of {all} rays do not meet the surface exactly once"));
    }
    if report.fairness.is_some_and(|f| !f.accurate) {
        warnings
            .push("some weights have the wrong sign; the surface is smooth, see bad rays".into());
    }
    let flipped = sampled.mesh.flipped_facets();
    if flipped > 0 {
        warnings.push(format!("{flipped} triangles look the wrong way; try another --density"));
    }
    warnings
}

fn describe(finding: &Finding) -> String {
    match finding {
        Finding::Overlap { at: [a, b], .. } => format!("overlap of those at {a:?} and {b:?}"),
        Finding::Wedge { at: [a, b], .. } => format!("order of those at {a:?} and {b:?}"),
        other => format!("{other:?}"),
    }
}
