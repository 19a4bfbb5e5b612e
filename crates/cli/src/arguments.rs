//! The commands and what all of them share.

use clap::{Parser, Subcommand};

use crate::apatch::ApatchArguments;
use crate::check::CheckArguments;
use crate::fit::FitArguments;
use crate::join::JoinArguments;
use crate::nagata::NagataArguments;
use crate::query::QueryArguments;
use crate::render::RenderArguments;
use crate::shapes::ShapesArguments;

/// Fits implicit surfaces with G1 patches of degree 7, curves meshes with normals, and measures the
/// result.
#[derive(Parser)]
#[command(name = "smoothpatch", version, after_help = OVERVIEW)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    Fit(FitArguments),
    Check(CheckArguments),
    Nagata(NagataArguments),
    Apatch(ApatchArguments),
    Join(JoinArguments),
    Query(QueryArguments),
    Render(RenderArguments),
    Shapes(ShapesArguments),
}

/// Below the help of every command.
pub(crate) const EXIT_CODES: &str = "\
Exit codes:
  0  success
  1  `fit`: the tolerance is not met; all files are written
     `check`: a bound is exceeded, or the patches do not form a manifold
  2  the task cannot be done: one message on stderr says why, and no partial file is left";

const OVERVIEW: &str = "\
Examples:
  smoothpatch fit --shape torus --faces 600 -o torus.vtu
  smoothpatch check torus.vtu --shape torus --max-deviation 1e-5
  smoothpatch nagata mesh.obj -o curved.vtu
  smoothpatch apatch mesh.obj -o smooth.vtu
  smoothpatch render torus.vtu -o torus.png
  smoothpatch query mesh.obj --points points.csv
  smoothpatch shapes

Exit codes:
  0  success
  1  `fit`: the tolerance is not met; all files are written
     `check`: a bound is exceeded, or the patches do not form a manifold
  2  the task cannot be done: one message on stderr says why, and no partial file is left";
