//! Times and memory of fits of growing size, each in a process of its own.

use std::collections::BTreeMap;
use std::mem::size_of;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use clap::Args;
use serde::{Deserialize, Serialize};
use smoothpatch::bezier_core::SepticTriangle;
use smoothpatch::implicit::{NamedShape, Torus};
use smoothpatch::{G1Surface, Method, Settings, Silent, fit, fit_base_mesh};
use testkit::meshes::torus_grid;

use crate::table::Table;

#[derive(Args)]
pub(crate) struct OnceOptions {
    /// Faces of the base mesh.
    #[arg(long)]
    faces: usize,
    /// Takes a regular base mesh instead of making one.
    #[arg(long)]
    given: bool,
}

/// All fits, by what they start from.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Growth {
    /// From the function.
    whole: Vec<Once>,
    /// From a regular base mesh.
    given: Vec<Once>,
}

/// One fit of a torus.
#[derive(Debug, Serialize, Deserialize)]
struct Once {
    faces: usize,
    /// Seconds by stage, on one thread, in time that passed.
    stages: BTreeMap<String, f64>,
    /// Largest resident size beyond that before the fit, in bytes; where the system tells.
    peak: Option<f64>,
}

/// The fit that [`OnceOptions`] ask for; its figures go to standard output.
pub(super) fn once(options: &OnceOptions) -> Result<bool> {
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let once = one_thread.install(|| fit_once(options))?;
    println!("{}", serde_json::to_string(&once)?);
    Ok(true)
}

fn fit_once(options: &OnceOptions) -> Result<Once> {
    let settings = Settings::with_faces(options.faces).with_method(Method::Published);
    let (surface, before): (G1Surface, _) = if options.given {
        let field = Torus { major_radius: 2.0, minor_radius: 1.0 };
        // twice as many around as across, two triangles each
        let across = (options.faces as f64 / 4.0).sqrt().round();
        let across = format!("{across:.0}").parse::<usize>()?;
        let mesh = torus_grid([2.0, 1.0], 2 * across, across);
        let before = resident("VmRSS:");
        (fit_base_mesh(&field, mesh, &settings, &mut Silent)?, before)
    } else {
        let shape = NamedShape::find("torus").context("a shape of the catalogue")?;
        let before = resident("VmRSS:");
        (fit(&*shape.field(), &shape.region, &settings, &mut Silent)?, before)
    };
    let peak = resident("VmHWM:").zip(before).map(|(peak, before)| peak - before);
    let stages = surface.times.iter().map(|(stage, s)| (stage.to_string(), s)).collect();
    Ok(Once { faces: surface.mesh.topology().face_count(), stages, peak })
}

/// Linux: a size in bytes from the status of this process.
fn resident(name: &str) -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kilobytes: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

impl Growth {
    /// Fits with a thousand faces and ten times as many, again and again, up to `most`.
    pub(super) fn measure(most: usize) -> Result<Self> {
        ensure!(most >= 10_000, "growth shows from ten thousand faces on; ask for --faces 10000");
        let sizes = || (3..).map(|power| 10_usize.pow(power)).take_while(|&size| size <= most);
        Ok(Self {
            whole: sizes().map(|size| child(size, false)).collect::<Result<_>>()?,
            given: sizes().map(|size| child(size, true)).collect::<Result<_>>()?,
        })
    }

    /// Time a face by stage and its exponent, and memory.
    pub(super) fn table(&self) -> String {
        let sizes = self.whole.iter().map(|once| format!("{} faces", once.faces));
        let head: Vec<String> = std::iter::once("µs a face, one thread".to_owned())
            .chain(sizes)
            .chain(["exponent".to_owned()])
            .collect();
        let mut table = Table::new(&head.iter().map(String::as_str).collect::<Vec<_>>());
        for (from, runs) in [("", &self.whole), ("given mesh: ", &self.given)] {
            for stage in runs
                .iter()
                .flat_map(|once| once.stages.keys())
                .collect::<std::collections::BTreeSet<_>>()
            {
                let seconds = |once: &Once| once.stages.get(stage).copied().unwrap_or(f64::NAN);
                table.add(line(&format!("{from}{stage}"), runs, 1e6, &seconds));
            }
        }
        let mut memory = Table::new(&[
            "bytes a face",
            "patches at rest",
            "peak, from the function",
            "peak, given mesh",
        ]);
        for (whole, given) in self.whole.iter().zip(&self.given) {
            let peak = |once: &Once| {
                once.peak
                    .map_or_else(|| "-".into(), |peak| format!("{:.0}", peak / once.faces as f64))
            };
            memory.add(vec![
                format!("{} faces", whole.faces),
                size_of::<SepticTriangle>().to_string(),
                peak(whole),
                peak(given),
            ]);
        }
        table.text() + "\n" + &memory.text()
    }
}

fn line(name: &str, runs: &[Once], scale: f64, value: &dyn Fn(&Once) -> f64) -> Vec<String> {
    let per_face = |once: &Once| format!("{:.2}", scale * value(once) / once.faces as f64);
    let points = runs.iter().map(|once| [once.faces as f64, value(once)].map(f64::ln));
    std::iter::once(name.to_owned())
        .chain(runs.iter().map(per_face))
        .chain([format!("{:.2}", slope(points))])
        .collect()
}

/// Of the straight line that is closest to the points, in the sense of least squares.
fn slope(points: impl Iterator<Item = [f64; 2]> + Clone) -> f64 {
    let count = points.clone().count() as f64;
    let mean = |axis: usize| points.clone().map(|p| p[axis]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let product = |a: f64, b: f64| a * b;
    let above: f64 = points.clone().map(|[px, py]| product(px - x, py - y)).sum();
    let below: f64 = points.map(|[px, _]| product(px - x, px - x)).sum();
    above / below
}

fn child(faces: usize, given: bool) -> Result<Once> {
    let mut command = Command::new(std::env::current_exe()?);
    command.arg("fit-once").arg("--faces").arg(faces.to_string());
    if given {
        command.arg("--given");
    }
    let output = command.stderr(std::process::Stdio::inherit()).output()?;
    ensure!(output.status.success(), "a fit with {faces} faces failed");
    serde_json::from_slice(&output.stdout).context("figures of a fit")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slope_of_a_power() {
        let points = [1e3_f64, 1e4, 1e5].map(|n| [n.ln(), (3.0 * n.powf(1.5)).ln()]);
        assert!((slope(points.into_iter()) - 1.5).abs() < 1e-12);
    }
}
