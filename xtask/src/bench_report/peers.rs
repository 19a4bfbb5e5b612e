//! Other programs on the same work, at equal accuracy.

use std::mem::size_of;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use serde::Deserialize;
use smoothpatch::bezier_core::SepticTriangle;
use smoothpatch::implicit::NamedShape;
use smoothpatch::measure::deviation;
use smoothpatch::{Distance, FieldSource, Settings, Silent, Tolerance, fit_to_tolerance};

use crate::interop::python::Environment;
use crate::table::Table;

/// Surfaces and accuracies, over the diagonal, as in the script.
const SURFACES: [&str; 2] = ["sphere", "torus"];
const ACCURACIES: [f64; 3] = [1e-3, 1e-5, 1e-7];

/// What one program needed.
#[derive(Debug, Deserialize)]
struct Peer {
    work: String,
    tool: String,
    seconds: f64,
    primitives: usize,
    bytes: usize,
    error: Option<f64>,
    /// Follows from coarser runs.
    #[serde(default)]
    extrapolated: bool,
}

/// A table of what the programs of `xtask/peers` need and what we need, one thread each; or a line that
/// says what is missing.
pub(super) fn run(folder: &Path) -> Result<String> {
    let scripts = crate::root().join("xtask/peers");
    std::fs::create_dir_all(folder)?;
    let environment = Environment::make(
        Path::new("python3"),
        &folder.join("venv"),
        &scripts.join("requirements.txt"),
    )?;
    let environment = match environment {
        Ok(environment) => environment,
        Err(missing) => return Ok(format!("no peers: {missing}")),
    };
    let output = Command::new(environment.program())
        .arg("-B")
        .arg(scripts.join("measure.py"))
        .stderr(std::process::Stdio::inherit())
        .output()?;
    ensure!(output.status.success(), "xtask/peers/measure.py failed");
    let text = String::from_utf8(output.stdout)?;
    let mut peers = text
        .lines()
        .map(|line| serde_json::from_str(line).with_context(|| line.to_owned()))
        .collect::<Result<Vec<Peer>>>()?;
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    for shape in SURFACES {
        for accuracy in ACCURACIES {
            peers.push(one_thread.install(|| ours(shape, accuracy))?);
        }
    }
    // stable: ours comes last for each work
    peers.sort_by(|a, b| a.work.cmp(&b.work));
    Ok(table(&peers))
}

fn ours(name: &str, accuracy: f64) -> Result<Peer> {
    let shape = NamedShape::find(name).context("a shape of the catalogue")?;
    let field = shape.field();
    let asked = Tolerance { distance: Distance::Relative(accuracy), normal_deg: None };
    // the number of faces is not used
    let settings = Settings::with_faces(1000);
    let start = Instant::now();
    let surface = fit_to_tolerance(&*field, &shape.region, &asked, &settings, &mut Silent)?;
    let seconds = start.elapsed().as_secs_f64();
    let diagonal = surface.mesh.diagonal();
    let target = FieldSource::new(&*field, diagonal, settings.projection);
    let primitives = surface.mesh.topology().face_count();
    Ok(Peer {
        work: format!("{name} {accuracy:e}").replace("e-", "e-0"),
        tool: "smoothpatch, G1 degree 7".into(),
        seconds,
        primitives,
        bytes: primitives * size_of::<SepticTriangle>(),
        error: Some(deviation(&surface.patches.nets, &target, diagonal).0.max),
        extrapolated: false,
    })
}

fn table(peers: &[Peer]) -> String {
    let mut table = Table::new(&["work", "program", "seconds", "primitives", "bytes", "deviation"]);
    for peer in peers {
        let error = peer.error.map_or_else(|| "-".into(), |error| format!("{error:.1e}"));
        let note = if peer.extrapolated { " (extrapolated)" } else { "" };
        table.add(vec![
            peer.work.clone(),
            peer.tool.clone(),
            format!("{:.3}", peer.seconds),
            peer.primitives.to_string(),
            format!("{:.2e}", peer.bytes as f64),
            error + note,
        ]);
    }
    table.text()
}
