//! `cargo xtask interop`: samples of every scheme and format, judged by programs that read them.

mod fitted;
mod meshes;
mod nagata;
pub(crate) mod python;
mod samples;

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args;

use python::Environment;
use samples::Samples;

/// The programs of `xtask/interop`, dearest first.
const CHECKS: [&str; 4] = ["check_occ.py", "check_gmsh.py", "check_vtk.py", "check_meshio.py"];

#[derive(Args)]
pub(crate) struct Options {
    /// The Python that makes the environment.
    #[arg(long, value_name = "PATH", default_value = "python3")]
    python: PathBuf,
    /// Where the environment and the samples go; by default target/interop.
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// Only write the samples.
    #[arg(long)]
    samples_only: bool,
}

/// Returns whether all readers agree; `true` with a line that says so if there is no Python or no
/// network.
pub(crate) fn run(options: &Options) -> Result<bool> {
    let folder = options.folder.clone().unwrap_or_else(|| target().join("interop"));
    let start = Instant::now();
    let samples = write_samples(&folder.join("samples"))?;
    println!("{} samples written in {:.1} s", samples.count(), start.elapsed().as_secs_f64());
    if options.samples_only {
        return Ok(true);
    }
    let scripts = crate::root().join("xtask/interop");
    let start = Instant::now();
    let environment = match Environment::make(
        &options.python,
        &folder.join("venv"),
        &scripts.join("requirements.txt"),
    )? {
        Ok(environment) => environment,
        Err(missing) => {
            println!("interop skipped: {missing}");
            return Ok(true);
        }
    };
    println!("environment ready after {:.1} s", start.elapsed().as_secs_f64());
    let scripts = CHECKS.map(|name| scripts.join(name));
    environment.check(&scripts, &folder.join("samples"))
}

/// Where the build goes.
fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| crate::root().join("target"), PathBuf::from)
}

fn write_samples(folder: &Path) -> Result<Samples> {
    let mut samples = Samples::new(folder)?;
    fitted::write(&mut samples).context("samples of fitted surfaces")?;
    nagata::write(&mut samples).context("samples of curved meshes")?;
    meshes::write(&mut samples).context("samples of fitted meshes")?;
    samples.finish()?;
    Ok(samples)
}
