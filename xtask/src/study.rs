//! `cargo xtask verify --full`: how the errors fall when edges are halved, and what a face costs.

mod checks;
mod cost;
mod families;
pub(crate) mod interpolants;
mod levels;
mod lobatto;
mod present;
mod tolerance;

use anyhow::{Context, Result};
use clap::ValueEnum;
use serde::Serialize;

pub(crate) use checks::name as variant_name;
use cost::Cost;
use families::Family;
pub(crate) use levels::{Errors, Level, Variant};
use tolerance::Scene;

use crate::check::{self, Check};

/// The levels of one family, coarse ones first.
#[derive(Debug, Serialize)]
pub(crate) struct Convergence {
    pub(crate) family: &'static str,
    pub(crate) formula: String,
    pub(crate) levels: Vec<Level>,
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

/// What a study has shown.
pub(crate) struct Verdict {
    /// Whether all orders, accuracies and costs are as promised.
    pub(crate) good: bool,
    /// Empty if that part was not run.
    pub(crate) convergence: Vec<Convergence>,
}

/// Runs parts of the study and writes them to `target/verify`.
pub(crate) fn run(part: Part) -> Result<Verdict> {
    let mut study = Study::default();
    if part.has(Part::Convergence) {
        study.convergence = convergence(usize::MAX)?;
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
        return Ok(Verdict { good: true, convergence: Vec::new() });
    }
    println!("\n{}", check::table(&study.checks).text());
    write(&study)?;
    let good = study.checks.iter().all(|check| check.holds);
    Ok(Verdict { good, convergence: study.convergence })
}

/// How the errors fall, on meshes of up to so many faces.
pub(crate) fn convergence(most_faces: usize) -> Result<Vec<Convergence>> {
    let measured = families::all()?.into_iter().map(|family| {
        let meshes = family.meshes.iter().filter(|mesh| mesh.topology().face_count() <= most_faces);
        let levels = meshes.map(|mesh| levels::measure(&family, mesh.clone()));
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
