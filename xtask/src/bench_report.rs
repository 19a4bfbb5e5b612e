//! `cargo xtask bench-report`: what the benches measured beside the limits of the machine and the
//! targets, how times and memory grow with the number of faces, and what changed since another report.

mod compare;
mod decimation;
mod growth;
mod measured;
mod peers;
mod rows;
mod scenes;

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use clap::Args;
use serde::{Deserialize, Serialize};

use decimation::Decimation;
use growth::Growth;
pub(crate) use growth::OnceOptions;
use measured::Measurements;
use rows::Row;
use scenes::Scene;

use crate::root;

#[derive(Args)]
pub(crate) struct Options {
    /// Uses the results that `cargo bench` left instead of running it.
    #[arg(long)]
    saved: bool,
    /// Most faces of the fits that show the growth, from a thousand on in steps of ten.
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    faces: usize,
    /// Where to keep the report; by default target/bench-report.json.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// An earlier report: says what got slower or faster by more than the noise.
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// Also measures other programs at equal accuracy, installed below the target folder; minutes.
    #[arg(long)]
    peers: bool,
}

/// What is kept.
#[derive(Debug, Serialize, Deserialize)]
struct Report {
    measurements: Measurements,
    growth: Growth,
    #[serde(default)]
    scenes: Vec<Scene>,
    #[serde(default)]
    decimation: Option<Decimation>,
}

/// The benches of the table: package, bench, filter, features.
const BENCHES: [[&str; 4]; 8] = [
    ["bezier-core", "calibration", "", "simd"],
    ["bezier-core", "evaluate", "septic|shared_fit", "simd"],
    ["hermite-sqp", "curves", "solve", ""],
    ["implicit", "project", "project/shape", ""],
    ["basemesh", "polygonize", "deccube", ""],
    ["basemesh", "simplify", "simplify", ""],
    ["nagata", "nagata", "nothing shared", "simd"],
    ["smoothpatch", "fit", "", ""],
];

/// False if something got slower than in the report that this one is compared with.
pub(crate) fn run(options: &Options) -> Result<bool> {
    if !options.saved {
        BENCHES.iter().try_for_each(run_bench)?;
    }
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    let measurements = Measurements::read(&target.join("criterion"))?;
    let growth = Growth::measure(options.faces)?;
    let scenes = scenes::measure()?;
    let decimation = decimation::measure()?;
    println!("{}", Row::table(&measurements));
    println!("{}", growth.table());
    println!("{}", scenes::table(&scenes));
    println!("{}", decimation.line());
    if options.peers {
        println!("{}", peers::run(&target.join("peers"))?);
    }
    let report = Report { measurements, growth, scenes, decimation: Some(decimation) };
    let path = options.json.clone().unwrap_or_else(|| target.join("bench-report.json"));
    std::fs::write(&path, serde_json::to_string_pretty(&report)?)
        .with_context(|| path.display().to_string())?;
    println!("kept in {}", path.display());
    let Some(earlier) = &options.against else { return Ok(true) };
    let text = std::fs::read_to_string(earlier).with_context(|| earlier.display().to_string())?;
    let earlier: Report = serde_json::from_str(&text).context("not a report of this command")?;
    let (text, slower) = compare::compare(&earlier.measurements, &report.measurements);
    println!("{text}");
    Ok(slower == 0)
}

/// One fit whose figures go to standard output, in a process of its own for its memory.
pub(crate) fn once(options: &OnceOptions) -> Result<bool> {
    growth::once(options)
}

fn run_bench([package, bench, filter, features]: &[&str; 4]) -> Result<()> {
    let mut cargo = Command::new("cargo");
    cargo.args(["bench", "--quiet", "--package", package, "--bench", bench]).current_dir(root());
    if !features.is_empty() {
        cargo.args(["--features", features]);
    }
    cargo.arg("--").arg("--noplot");
    if !filter.is_empty() {
        cargo.arg(filter);
    }
    eprintln!("{package}: {bench}");
    let status = cargo.stdout(std::process::Stdio::null()).status()?;
    ensure!(status.success(), "the bench {bench} of {package} failed");
    Ok(())
}
