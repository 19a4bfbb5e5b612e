//! Verification and upkeep of the workspace.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]

mod bench_report;
mod check;
mod fixtures;
mod interop;
mod schemes;
mod study;
mod table;
mod tidy;
mod verify;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Verification and upkeep of the workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Fits every scene in both methods, measures, and compares with bounds and golden numbers.
    Verify(verify::Options),
    /// Writes samples of every scheme and format and lets other programs judge them.
    Interop(interop::Options),
    /// Runs the benches and shows their figures beside targets and limits, and how costs grow.
    BenchReport(bench_report::Options),
    /// One fit, for bench-report.
    #[command(hide = true)]
    FitOnce(bench_report::OnceOptions),
    /// Checks tables of formulas, links in documents and the list of fixtures.
    Tidy,
    /// Writes the fixtures that are generated.
    Fixtures,
}

/// Success is exit code 0, a failed check 1, and a check that could not be made 2.
fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Verify(options) => verify::run(&options),
        Command::Interop(options) => interop::run(&options),
        Command::BenchReport(options) => bench_report::run(&options),
        Command::FitOnce(options) => bench_report::once(&options),
        Command::Tidy => tidy::run(),
        Command::Fixtures => fixtures::run().map(|()| true),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// The root of the workspace.
fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().expect("invariant: xtask is a folder of the workspace").to_owned()
}
