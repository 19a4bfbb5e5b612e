//! `cargo xtask verify --full`: how the errors fall when edges are halved, and what a face costs.

mod checks;
mod cost;
mod families;
mod interpolants;
mod levels;
mod lobatto;
mod present;
mod tolerance;

use anyhow::{Context, Result};
use clap::ValueEnum;
use serde::Serialize;

use cost::Cost;
use families::Family;
use levels::Level;
use tolerance::Scene;

use crate::check::{self, Check};

/// The levels of one family, coarse ones first.
#[derive(Debug, Serialize)]
struct Convergence {
    family: &'static str,
    formula: String,
    levels: Vec<Level>,
}

#[derive(Debug, Default, Serialize)]
struct Study {
    convergence: Vec<Convergence>,
    tolerance: Vec<Scene>,
    cost: Vec<Cost>,
    checks: Vec<Check>,
}

/// What can be run alone.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Part {
    /// Everything.
    All,
    /// How the errors fall when edges are halved.
    Convergence,
    /// Fits with an accuracy, against a sweep over numbers of faces.
    Tolerance,
    /// What a face costs.
    Cost,
    /// All resolutions of the schemes over given meshes.
    Schemes,
}

impl Part {
    pub(crate) fn has(self, other: Self) -> bool {
        self == Self::All || self == other
    }
}

/// Returns whether all orders, accuracies and costs are as promised.
pub(crate) fn run(part: Part) -> Result<bool> {
    let mut study = Study::default();
    if part.has(Part::Convergence) {
        study.convergence = convergence()?;
        study.checks.extend(study.convergence.iter().flat_map(checks::orders));
        study.checks.extend(checks::invariants(&study.convergence));
    }
    if part.has(Part::Tolerance) {
        for shape in tolerance::SHAPES {
            study.tolerance.push(tolerance::measure(shape).context(shape)?);
            let last = study.tolerance.last().map_or(&[][..], std::slice::from_ref);
            println!("\n{}", present::tolerance(last).text());
        }
        study.checks.extend(checks::tolerances(&study.tolerance));
    }
    if part.has(Part::Cost) {
        study.cost = cost::measure()?;
        println!("\ncost\n{}", present::cost(&study.cost).text());
        study.checks.extend(checks::costs(&study.cost));
    }
    if part == Part::Schemes {
        // in the second table of `verify`
        return Ok(true);
    }
    println!("\n{}", check::table(&study.checks).text());
    write(&study)?;
    Ok(study.checks.iter().all(|check| check.holds))
}

fn convergence() -> Result<Vec<Convergence>> {
    let measured = families::all()?.into_iter().map(|family| {
        let levels = family.meshes.iter().map(|mesh| levels::measure(&family, mesh.clone()));
        let levels = levels.collect::<Result<_>>().with_context(|| family.name)?;
        let Family { name, formula, .. } = family;
        let one = Convergence { family: name, formula, levels };
        println!("\n{name}: {}\n{}", one.formula, present::convergence(&one).text());
        Ok(one)
    });
    measured.collect()
}

/// Writes `study.json` and `study.md` to `target/verify`.
fn write(study: &Study) -> Result<()> {
    let folder = crate::root().join("target/verify");
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    std::fs::write(folder.join("study.json"), serde_json::to_string_pretty(study)? + "\n")?;
    std::fs::write(folder.join("study.md"), present::page(study))?;
    Ok(())
}
