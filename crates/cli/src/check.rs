//! `smoothpatch check`: reads a result back and measures it anew.

mod bounds;
mod findings;

use std::path::PathBuf;

use anyhow::bail;
use clap::{ArgGroup, Args};
use smoothpatch::io::read_mesh_file;

use crate::arguments::EXIT_CODES;
use crate::exit::{Outcome, complain};
use crate::stdout::{print, print_json};
use crate::surface::{SURFACE, SurfaceArguments};
use crate::threads::ThreadArguments;
use crate::values;
use bounds::Bounds;
use findings::{Findings, Reading, Reference};

/// Read patches back from a file and measure them anew
///
/// Nothing but the file and the surface named here is used: topology, gaps and angles along all
/// edges, folds, and, if a surface is named, distance and normal angle to it.
#[derive(Args)]
#[command(
    group = ArgGroup::new(SURFACE),
    after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"),
)]
pub(crate) struct CheckArguments {
    /// Patches of degree 7, as written by `smoothpatch fit`
    #[arg(value_name = "FILE.vtu")]
    file: PathBuf,

    /// Compare with the surface of a scene file (RON)
    #[arg(long, value_name = "SCENE.ron", group = SURFACE)]
    scene: Option<PathBuf>,

    #[command(flatten)]
    surface: SurfaceArguments,

    /// Compare with a mesh (OBJ, STL, PLY, OFF): its vertices and triangles, in both directions
    #[arg(long, value_name = "MESH", group = SURFACE)]
    mesh: Option<PathBuf>,

    /// Edges along which the patches meet at more than this angle somewhere are creases: they are
    /// counted apart and are not part of the G1 angle
    #[arg(long, value_name = "DEG", value_parser = values::crease_angle)]
    #[arg(allow_hyphen_values = true)]
    crease_angle: Option<f64>,

    /// Print JSON
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    threads: ThreadArguments,

    #[command(flatten)]
    bounds: Bounds,
}

const EXAMPLES: &str = "\
Examples:
  smoothpatch check torus.vtu
  smoothpatch check torus.vtu --scene fixtures/scenes/torus.ron --max-deviation 1e-5 --euler 0
  smoothpatch check cube.vtu --formula \"x^4 + y^4 + z^4 - 16\" --max-normal-error 0.1 --json
  smoothpatch check torus.vtu --closed --max-g1-angle 1e-9 --max-folds 0
  smoothpatch check block.vtu --mesh block.obj --crease-angle 40 --max-deviation 1e-3";

pub(crate) fn run(arguments: &CheckArguments) -> anyhow::Result<Outcome> {
    let chosen = arguments.surface.scene(arguments.scene.as_deref())?;
    arguments.threads.apply()?;
    let field = match &chosen {
        Some(chosen) => Some(smoothpatch::scene::field_of(&chosen.scene.surface)?),
        None => None,
    };
    let mesh = match &arguments.mesh {
        Some(file) => Some(read_mesh_file(file)?.mesh),
        None => None,
    };
    if let (Some(_), Some(bound)) = (&mesh, arguments.bounds.not_for_meshes()) {
        bail!("{bound} has no meaning with --mesh, whose triangles are flat");
    }
    let reference = Reference {
        field: field.as_deref(),
        mesh: mesh.as_ref(),
        crease_angle: arguments.crease_angle.map(f64::to_radians),
    };
    let measured = match findings::read(&arguments.file)? {
        Reading::Patches(patches) => Ok(findings::measure(&patches, reference)),
        Reading::NoManifold(problem) => Err(problem),
    };
    let findings = Findings::new(&arguments.file, measured, &arguments.bounds);
    if arguments.json {
        print_json(&findings)?;
    } else {
        print(&findings.table())?;
    }
    for complaint in findings.complaints() {
        complain(&complaint);
    }
    Ok(if findings.passed() { Outcome::Success } else { Outcome::NotGoodEnough })
}
