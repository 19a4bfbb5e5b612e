//! The tables of the study.

use super::checks::{name, order};
use super::cost::Cost;
use super::levels::{Errors, Level, Variant};
use super::tolerance::Scene;
use super::{Convergence, Study};
use crate::check;
use crate::table::{Table, scientific};

/// One line per surface and level; orders in brackets.
pub(super) fn convergence(family: &Convergence) -> Table {
    let mut table =
        Table::new(&["surface", "faces", "max", "RMS", "normal °", "folds", "retreats"]);
    for variant in [
        Variant::Curves,
        Variant::PublishedG0,
        Variant::Published,
        Variant::Unrefined,
        Variant::RefinedCurves,
        Variant::Refined,
        Variant::Interpolant4,
        Variant::Interpolant7,
    ] {
        let mut before: Option<&Errors> = None;
        for Level { faces, errors, .. } in &family.levels {
            let Some(errors) = errors.get(&variant) else { continue };
            let cell = |figure: fn(&Errors) -> Option<f64>| {
                figure(errors).map_or(String::new(), |x| with_order(before.and_then(figure), x))
            };
            table.add(vec![
                name(variant).to_owned(),
                faces.to_string(),
                cell(|errors| Some(errors.max)),
                cell(|errors| errors.rms),
                cell(|errors| errors.normal_deg),
                errors.folds.to_string(),
                errors.retreats.to_string(),
            ]);
            before = Some(errors);
        }
    }
    table
}

fn with_order(before: Option<f64>, x: f64) -> String {
    // no order where nothing is left to measure
    let order = before.filter(|_| x > 0.0).map(|before| format!(" ({:.1})", order(before, x)));
    scientific(x) + &order.unwrap_or_default()
}

/// One line per shape and accuracy.
pub(super) fn tolerance(scenes: &[Scene]) -> Table {
    let mut table = Table::new(&[
        "shape",
        "tolerance",
        "faces",
        "max",
        "folds",
        "s, one thread",
        "sweep",
        "ratio",
        "exponent",
    ]);
    for scene in scenes {
        for fit in &scene.fits {
            table.add(vec![
                scene.shape.to_owned(),
                scientific(fit.tolerance),
                fit.faces.to_string(),
                scientific(fit.deviation),
                fit.folds.to_string(),
                format!("{:.2}", fit.seconds),
                fit.sweep_faces.map_or("more".to_owned(), |faces| faces.to_string()),
                fit.sweep_faces.map_or(String::new(), |_| format!("{:.2}", fit.excess())),
                format!("{:.2}", scene.exponent),
            ]);
        }
    }
    table
}

pub(super) fn cost(costs: &[Cost]) -> Table {
    let mut table = Table::new(&["method", "faces", "s", "µs per face", "by stage, µs per face"]);
    for cost in costs {
        table.add(vec![
            format!("{:?}", cost.method).to_lowercase(),
            cost.faces.to_string(),
            format!("{:.3}", cost.seconds),
            format!("{:.1}", cost.microseconds_per_face),
            stages(cost),
        ]);
    }
    table
}

fn stages(cost: &Cost) -> String {
    let stage = |(name, x): (&String, &f64)| format!("{name} {x:.1}");
    cost.stages.iter().map(stage).collect::<Vec<_>>().join(", ")
}

/// All tables as a Markdown page.
pub(super) fn page(study: &Study) -> String {
    let mut page = String::from(
        "# Convergence and cost\n\nWritten by `cargo xtask verify --full`. Distances over the \
         diagonal of the bounding box; observed orders in brackets, edges halve from line to \
         line.\n",
    );
    for family in &study.convergence {
        let Convergence { family: name, formula, .. } = family;
        page += &format!("\n## {name}: `{formula}`\n\n{}", convergence(family).markdown());
    }
    page += &format!(
        "\n## Fits with an accuracy\n\n`sweep` is the smallest number of faces, of those growing by \
         10 % from step to step, with which `--faces` is within the accuracy; `exponent` is the \
         slope of the faces over the accuracy.\n\n{}",
        tolerance(&study.tolerance).markdown()
    );
    page +=
        &format!("\n## Cost of the whole pipeline, one thread\n\n{}", cost(&study.cost).markdown());
    page += &format!("\n## Checks\n\n{}", check::table(&study.checks).markdown());
    page
}
