//! The command line of smoothpatch: fit an implicit surface with G1 patches, check the result,
//! curve a mesh with normals.

mod apatch;
mod arguments;
mod check;
mod exit;
mod fit;
mod format_options;
mod formats;
mod join;
mod nagata;
mod output_files;
mod progress;
mod query;
mod render;
mod shapes;
mod stdout;
mod surface;
mod table;
mod threads;
mod values;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command};

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Fit(arguments) => fit::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Nagata(arguments) => nagata::run(&arguments),
        Command::Apatch(arguments) => apatch::run(&arguments),
        Command::Join(arguments) => join::run(&arguments),
        Command::Query(arguments) => query::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Shapes(arguments) => shapes::run(&arguments),
    };
    exit::code(result)
}
