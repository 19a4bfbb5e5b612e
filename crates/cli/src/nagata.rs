//! `smoothpatch nagata`: from a mesh with normals to curved patches.

pub(crate) mod options;
mod outputs;
pub(crate) mod report_file;
mod summary;
pub(crate) mod task;
mod warnings;

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use smoothpatch::nagata_surface::report;

use crate::arguments::EXIT_CODES;
use crate::exit::{Outcome, complain};
use crate::format_options::FormatOptions;
use crate::output_files::{Holds, OutputFiles};
use crate::stdout::print;
use crate::threads::ThreadArguments;
use crate::values;
use options::{CellName, SurfaceOptions};
use report_file::ReportFile;
use task::Task;

/// Curve a mesh of triangles and quadrilaterals with its normals, measure the result and write it
///
/// Each face becomes a patch through its corners that is orthogonal to the normals there (Nagata
/// patches). Corners that share a normal are smooth, others meet in a sharp crease. With
/// `--continuity g1` neighbouring patches have common tangent planes; that takes triangles.
#[derive(Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
pub(crate) struct NagataArguments {
    #[command(flatten)]
    surface: SurfaceOptions,

    /// Compare the patches with the surface of a scene file [default: that of --normals]
    #[arg(long, value_name = "SCENE.ron")]
    reference: Option<PathBuf>,

    /// Where to write: .vtu or .msh for curved cells, .step for exact patches (C0 only), .obj, .ply,
    /// .stl or .glb for flat triangles; can be repeated
    #[arg(short, long = "output", value_name = "FILE", required = true)]
    outputs: Vec<PathBuf>,

    /// Kind of cells in .vtu files
    #[arg(long, value_enum, default_value_t = CellName::Quadratic)]
    cells: CellName,

    /// Each edge becomes N parts in files of flat triangles, and in .vtu files wherever cells are
    /// not exact
    #[arg(long, value_name = "N", default_value = "8", value_parser = values::divisions)]
    divisions: usize,

    #[command(flatten)]
    formats: FormatOptions,

    /// Also write everything that was measured, as JSON
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
  smoothpatch nagata fixtures/meshes/spot_triangulated.obj --crease-angle 90 --continuity g1 -o spot.obj
  smoothpatch nagata fixtures/meshes/spot_quadrangulated.obj --crease-angle 90 -o spot.vtu --report spot.json
  smoothpatch nagata part.obj --normals estimate --crease-angle 30 -o part.vtu -o part.obj
  smoothpatch nagata fixtures/meshes/torus_20x10.obj --normals fixtures/scenes/torus.ron -o t.vtu";

pub(crate) fn run(arguments: &NagataArguments) -> anyhow::Result<Outcome> {
    let files = OutputFiles::new(Holds::Patches, &arguments.outputs, arguments.report.as_deref())?;
    files.check_places()?;
    arguments.threads.apply()?;
    let reference = arguments.reference.as_deref();
    files.check_distinct(arguments.surface.files_read().into_iter().chain(reference).collect())?;

    let start = Instant::now();
    let task = Task::new(&arguments.surface, reference)?;
    let built = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let target = task.target();
    let (report, figures) = report(&task.surface, target.as_ref().map(|t| t as _));
    let measured = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let mut written = outputs::write(&files, &task.surface, &figures, arguments)?;
    if let Some(path) = &files.report {
        written.push(ReportFile::new(&task, &report, &written).write(path)?);
    }
    if !arguments.quiet {
        let seconds = [built, measured, start.elapsed().as_secs_f64()];
        print(&summary::summary(&task, &report, &written, seconds))?;
        for warning in warnings::warnings(&report, &task) {
            complain(&format!("warning: {warning}"));
        }
    }
    Ok(Outcome::Success)
}
