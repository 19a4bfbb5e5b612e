//! `smoothpatch apatch`: from a triangle mesh with normals to a smooth implicit surface.

mod options;
mod outputs;
mod report_file;
mod solid;
mod summary;
mod task;
mod tension;
mod warnings;

use std::path::PathBuf;
use std::time::Instant;

use anyhow::bail;
use clap::Args;
use smoothpatch::apatch_surface::report;

use crate::arguments::EXIT_CODES;
use crate::exit::{Outcome, complain};
use crate::output_files::{Holds, OutputFiles};
use crate::progress::WorkLine;
use crate::stdout::print;
use crate::threads::ThreadArguments;
use crate::values;
use options::RationalOptions;
use outputs::Outputs;
use report_file::ReportFile;
use solid::SolidOptions;
use task::Task;

/// Make a smooth surface through the vertices of a triangle mesh, or inside a solid: A-patches
///
/// The surface is where a function, smooth over a hull of tetrahedra around the mesh, is zero. It
/// passes through the vertices with the given normals, one for each vertex. Where the tetrahedra of
/// neighbours overlap, they are repaired; what cannot be repaired is named. The mesh may be open.
///
/// With `--scheme c1-cubic` or `c2-quintic` a solid with planar faces of any size is rounded off. A
/// file of its tetrahedra, as `--weights` writes it, can be given instead of the mesh.
#[derive(Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
pub(crate) struct ApatchArguments {
    #[command(flatten)]
    options: RationalOptions,

    #[command(flatten)]
    solid: SolidOptions,

    /// Compare the patches with the surface of a scene file [default: that of --normals]
    #[arg(long, value_name = "SCENE.ron")]
    reference: Option<PathBuf>,

    /// Where to write: .vtu, .obj, .ply, .stl or .glb, always flat triangles, with normals except in
    /// .stl; can be repeated
    #[arg(short, long = "output", value_name = "FILE", required = true)]
    outputs: Vec<PathBuf>,

    /// N steps along each side of a face, and half as many across the patches over edges
    #[arg(long, value_name = "N", default_value = "8", value_parser = values::divisions)]
    density: usize,

    /// Also write everything that was done and measured, as JSON
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,

    #[command(flatten)]
    threads: ThreadArguments,

    /// Print nothing but errors, not even warnings
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  smoothpatch apatch fixtures/meshes/spot_triangulated.obj -o spot.vtu --report spot.json
  smoothpatch apatch fixtures/meshes/torus_20x10.obj --normals fixtures/scenes/torus.ron -o t.obj
  smoothpatch apatch part.obj --normals file --tension 0.5 -o part.vtu
  smoothpatch apatch fixtures/solids/frame.off --scheme c2-quintic -o frame.vtu
  smoothpatch apatch icosahedron --scheme c1-cubic --cut 0.7 -o round.obj --weights round.json
  smoothpatch apatch round.json --density 20 -o finer.obj
  smoothpatch apatch part.obj --tension faces.json --repair keep-mesh -o part.vtu -o part.obj

A file for --tension, for all faces and for single ones by number from 0:
  {\"tension\": 0.0, \"faces\": {\"12\": 2.5, \"13\": -0.5}}";

pub(crate) fn run(arguments: &ApatchArguments) -> anyhow::Result<Outcome> {
    let files =
        OutputFiles::new(Holds::Triangles, &arguments.outputs, arguments.report.as_deref())?;
    files.check_places()?;
    arguments.threads.apply()?;
    let reference = arguments.reference.as_deref();
    if arguments.options.is_saved() {
        arguments.options.refuse_choices(reference.is_some(), arguments.solid.is_used())?;
        files.check_distinct(arguments.options.files_read())?;
        let (path, density) = (&arguments.options.mesh, arguments.density);
        return solid::load(path, density, arguments.quiet, &files);
    }
    if let Some(scheme) = arguments.options.solid_scheme(reference.is_some())? {
        files.check_distinct(arguments.options.files_read())?;
        let order = solid::Order {
            solid: &arguments.options.mesh,
            scheme,
            options: &arguments.solid,
            tension: arguments.options.tension(),
            density: arguments.density,
            quiet: arguments.quiet,
        };
        return solid::run(&order, &files);
    }
    if arguments.solid.is_used() {
        bail!("--cut and --weights are for solids; add --scheme c1-cubic or c2-quintic");
    }
    arguments.options.refuse_solids()?;
    files.check_distinct(arguments.options.files_read().into_iter().chain(reference).collect())?;

    let start = Instant::now();
    let line = WorkLine::new(arguments.quiet, "build");
    let task = Task::new(&arguments.options, reference)?;
    drop(line);
    let built = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let line = WorkLine::new(arguments.quiet, "measure");
    let target = task.target();
    let (report, figures) = report(&task.surface, target.as_ref().map(|t| t as _));
    drop(line);
    let measured = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let line = WorkLine::new(arguments.quiet, "write");
    let mut outputs = Outputs::write(&files, &task.surface, figures.as_ref(), arguments.density)?;
    if let Some(path) = &files.report {
        let file = ReportFile::new(&task, &report, &outputs).write(path)?;
        outputs.files.push(file);
    }
    drop(line);
    if !arguments.quiet {
        let seconds = [built, measured, start.elapsed().as_secs_f64()];
        print(&summary::summary(&task, &report, &outputs, seconds))?;
        for warning in warnings::warnings(&report, &outputs) {
            complain(&format!("warning: {warning}"));
        }
    }
    Ok(Outcome::Success)
}
