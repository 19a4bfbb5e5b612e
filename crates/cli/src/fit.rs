//! `smoothpatch fit`: from a surface to files.

mod mesh_task;
mod outputs;
mod report_file;
mod scene_task;
mod summary;
mod task;
mod warnings;

use std::path::PathBuf;
use std::time::Instant;

use clap::{ArgGroup, Args, ValueEnum};
use smoothpatch::implicit::Aabb;
use smoothpatch::io::CellKind;
use smoothpatch::measure::{Certificate, USUAL_CUTS, certify};
use smoothpatch::{Method, Report};

use crate::arguments::EXIT_CODES;
use crate::exit::{Outcome, complain};
use crate::format_options::FormatOptions;
use crate::progress;
use crate::stdout::print;
use crate::surface::{SURFACE, SurfaceArguments};
use crate::threads::ThreadArguments;
use crate::values;
use mesh_task::{MeshOptions, MeshReport};
use outputs::Outputs;
use report_file::ReportFile;
use task::{Input, Task};

/// Fit a surface with G1 patches, measure the result and write it
///
/// The surface is the set of points where a function of x, y and z is zero; the function is negative
/// inside. It comes from a scene file, has a name, or is typed as a formula. All its components in
/// the region are fitted; it must be closed there.
#[derive(Args)]
#[command(
    group = ArgGroup::new(SURFACE).required(true),
    after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"),
)]
pub(crate) struct FitArguments {
    /// A scene file (RON), or a mesh of triangles or polygons (OBJ, STL, PLY, OFF)
    #[arg(id = "scene", value_name = "SCENE.ron|MESH", group = SURFACE)]
    input: Option<PathBuf>,

    #[command(flatten)]
    surface: SurfaceArguments,

    /// The box to look in: two opposite corners [default: that of the scene or shape; searched for
    /// a formula]
    #[arg(long, value_name = "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX", allow_hyphen_values = true)]
    #[arg(value_parser = values::region)]
    region: Option<Aabb>,

    /// About how many patches to make, an even number [default: that of the scene, or 2000]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::faces)]
    faces: Option<usize>,

    /// The accuracy instead of a number of patches: the largest distance to the surface, in
    /// diagonals of its bounding box; as few patches as that takes. The number of faces of a scene
    /// is not used then
    #[arg(long, value_name = "DISTANCE", conflicts_with_all = ["faces", "base_mesh"])]
    #[arg(value_parser = values::positive, allow_hyphen_values = true)]
    tolerance: Option<f64>,

    /// The distance of --tolerance is a length
    #[arg(long, requires = "tolerance")]
    absolute: bool,

    /// The largest angle between the normals of patches and surface, in degrees; without
    /// --tolerance, that is 1e-4 of the diagonal. With either of them it is never more than 10
    #[arg(long, value_name = "DEG", conflicts_with_all = ["faces", "base_mesh"])]
    #[arg(value_parser = values::angle, allow_hyphen_values = true)]
    normal_tolerance: Option<f64>,

    /// Also prove an upper bound of the distance from the patches to the surface by interval
    /// arithmetic, some times the measured deviation or more; takes up to ten milliseconds a patch
    #[arg(long)]
    certify: bool,

    /// A closed triangle mesh (OBJ) with its vertices on the surface; its faces become the patches
    #[arg(long, value_name = "FILE.obj", conflicts_with = "region")]
    base_mesh: Option<PathBuf>,

    /// How free control points are chosen; both methods are exactly G1
    #[arg(long, value_enum, default_value_t = MethodName::Refined)]
    method: MethodName,

    /// Where to write: .vtu or .step for the patches, .msh for curved elements, .obj, .ply, .stl or
    /// .glb for flat triangles; can be repeated
    #[arg(short, long = "output", value_name = "FILE", required = true)]
    outputs: Vec<PathBuf>,

    /// Also write the patches as they are before they are joined: without gaps, but with kinks along
    /// the edges. `smoothpatch render --compare` sets both side by side
    #[arg(long, value_name = "FILE.vtu")]
    before_join: Option<PathBuf>,

    /// Kind of cells in .vtu files; both hold the patches exactly, up to rounding for `lagrange`
    #[arg(long, value_enum, default_value_t = CellName::Bezier)]
    cells: CellName,

    /// Each patch becomes N² triangles in files of flat triangles
    #[arg(long, value_name = "N", default_value = "8", value_parser = values::divisions)]
    divisions: usize,

    #[command(flatten)]
    mesh_options: MeshOptions,

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
  smoothpatch fit fixtures/scenes/torus.ron -o torus.vtu
  smoothpatch fit --shape double-torus --tolerance 1e-6 -o double-torus.vtu
  smoothpatch fit --shape deccube --faces 5000 -o deccube.vtu -o deccube.obj --report deccube.json
  smoothpatch fit --formula \"x^4 + y^4 + z^4 - r^4\" --constant r=2 --faces 400 -o cube.vtu
  smoothpatch fit --formula \"x^4 + y^4 + z^4 - 5*(x^2 + y^2 + z^2)\" --level -11.8 \\
      --region -3,-3,-3,3,3,3 --faces 1600 --method published -o tangle.vtu
  smoothpatch fit --shape torus --base-mesh torus.obj -o torus.vtu";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MethodName {
    /// Full order of approximation
    Refined,
    /// The scheme of Tong and Kim (2009)
    Published,
}

impl From<MethodName> for Method {
    fn from(name: MethodName) -> Self {
        match name {
            MethodName::Refined => Self::Refined,
            MethodName::Published => Self::Published,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CellName {
    /// Control points of Bézier triangles
    Bezier,
    /// Points on the patches, for viewers without Bézier cells
    Lagrange,
}

impl From<CellName> for CellKind {
    fn from(name: CellName) -> Self {
        match name {
            CellName::Bezier => Self::Bezier,
            CellName::Lagrange => Self::Lagrange,
        }
    }
}

/// Everything that was measured.
pub(crate) struct Measured<'a> {
    report: &'a Report,
    mesh: Option<&'a MeshReport>,
    certificate: Option<&'a Certificate>,
}

pub(crate) fn run(arguments: &FitArguments) -> anyhow::Result<Outcome> {
    let outputs = Outputs::new(arguments)?;
    outputs.check_places()?;
    // before the search for a region, which works with all threads there are
    arguments.threads.apply()?;
    let task = Task::new(arguments)?;
    outputs.check_distinct(task.files_read())?;

    let mut progress = progress::listener(arguments.quiet);
    let surface = task.fit(&mut *progress)?;
    let diagonal = surface.mesh.diagonal();
    let (report, faces) = task.report(&surface, &mut *progress);
    let certificate = match &task.input {
        Input::Scene(scene) if arguments.certify => {
            let goal = 2.0 * report.deviation.max * diagonal;
            Some(certify(&surface.patches.nets, &*scene.field, goal, USUAL_CUTS, diagonal))
        }
        _ => None,
    };
    let mesh_report = match &task.input {
        Input::Mesh(mesh) => Some(mesh.report(&surface)),
        Input::Scene(_) => None,
    };
    let measured =
        Measured { report: &report, mesh: mesh_report.as_ref(), certificate: certificate.as_ref() };
    drop(progress);

    let start = Instant::now();
    let mut written = outputs.write(&surface, &faces)?;
    if let Ok(source) = task.source(diagonal) {
        written.extend(outputs.write_before_join(surface.mesh.topology(), || {
            surface.before_join(&*source, &task.settings)
        })?);
    } else if arguments.before_join.is_some() {
        complain("warning: --before-join is not written for meshes with sharp edges");
    }
    if let Some(path) = &arguments.report {
        written.push(ReportFile::new(&task, &measured, &written).write(path)?);
    }
    if !arguments.quiet {
        let seconds = start.elapsed().as_secs_f64();
        print(&summary::summary(&task, &measured, &written, seconds))?;
        for warning in warnings::warnings(&report, &surface, &faces) {
            complain(&format!("warning: {warning}"));
        }
    }
    let met = report.adaptation.is_none_or(|adaptation| adaptation.met);
    Ok(if met { Outcome::Success } else { Outcome::NotGoodEnough })
}
