//! `cargo xtask verify --full`: how the errors fall when edges are halved, and what a face costs.

mod checks;
mod cost;
mod families;
mod interpolants;
mod levels;
mod lobatto;
mod present;

use anyhow::{Context, Result};
use serde::Serialize;

use checks::Check;
use cost::Cost;
use families::Family;
use levels::Level;

/// The levels of one family, coarse ones first.
#[derive(Debug, Serialize)]
struct Convergence {
    family: &'static str,
    formula: String,
    levels: Vec<Level>,
}

#[derive(Debug, Serialize)]
struct Study {
    convergence: Vec<Convergence>,
    cost: Vec<Cost>,
    checks: Vec<Check>,
}

/// Returns whether all orders and costs are as promised.
pub(crate) fn run() -> Result<bool> {
    let mut convergence = Vec::new();
    for family in families::all()? {
        let levels = family.meshes.iter().map(|mesh| levels::measure(&family, mesh.clone()));
        let levels = levels.collect::<Result<_>>().with_context(|| family.name)?;
        let Family { name, formula, .. } = family;
        let one = Convergence { family: name, formula, levels };
        println!("\n{name}: {}\n{}", one.formula, present::convergence(&one).text());
        convergence.push(one);
    }
    let cost = cost::measure()?;
    println!("\ncost\n{}", present::cost(&cost).text());

    let mut checks: Vec<Check> = convergence.iter().flat_map(checks::orders).collect();
    checks.extend(checks::invariants(&convergence));
    checks.extend(checks::costs(&cost));
    println!("\n{}", present::checks(&checks).text());
    let good = checks.iter().all(|check| check.holds);
    write(&Study { convergence, cost, checks })?;
    Ok(good)
}

/// Writes `study.json` and `study.md` to `target/verify`.
fn write(study: &Study) -> Result<()> {
    let folder = crate::root().join("target/verify");
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    std::fs::write(folder.join("study.json"), serde_json::to_string_pretty(study)? + "\n")?;
    std::fs::write(folder.join("study.md"), present::page(study))?;
    Ok(())
}
