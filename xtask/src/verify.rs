//! `cargo xtask verify`: every scene in every method and every patch scheme, measured and compared.

mod bounds;
mod cases;
mod golden;
mod html;
mod measures;
mod present;

use std::io::IsTerminal;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use serde::Serialize;
use smoothpatch::io::Method;

use cases::Case;
use golden::Golden;
use measures::Measures;

use crate::schemes::{self, Effort};
use crate::study;

#[derive(Args)]
pub(crate) struct Options {
    /// Only these scenes, or surfaces of the second table.
    #[arg(long, num_args = 1.., value_name = "NAME")]
    scene: Vec<String>,
    /// Only one of the tables.
    #[arg(long)]
    only: Option<Part>,
    /// Only this method; leaves out the second table.
    #[arg(long)]
    method: Option<MethodName>,
    /// Where to write the figures; by default target/verify/verify.json.
    #[arg(long, value_name = "PATH")]
    json: Option<PathBuf>,
    /// Also write everything as one page for browsers, with plots of convergence and a picture of each
    /// scene; by default target/verify/verify.html.
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true)]
    html: Option<Option<PathBuf>>,
    /// Take the measured figures as the golden numbers.
    #[arg(long)]
    bless: bool,
    /// Also the study, or one part of it.
    #[arg(
        long,
        value_name = "PART",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "all"
    )]
    full: Option<study::Part>,
    /// Number of threads; by default one per core.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Splines fitted to the scenes.
    Splines,
    /// Patch schemes over given meshes.
    Schemes,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    Published,
    Refined,
}

/// One line of the table.
#[derive(Serialize)]
struct Row {
    scene: String,
    method: Method,
    /// Missing if the fit failed.
    measures: Option<Measures>,
    failures: Vec<String>,
}

/// Returns whether everything holds.
pub(crate) fn run(options: &Options) -> Result<bool> {
    if let Some(threads) = options.threads {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    }
    let golden_file = crate::root().join("fixtures/expected/verify.json");
    let mut golden = Golden::read(&golden_file)?;
    let effort = match options.full {
        Some(part) if part.has(study::Part::Schemes) => Effort::Full,
        _ => Effort::Usual,
    };
    let Selection { cases, schemes } = select(options, effort)?;

    let mut rows: Vec<Row> = cases.iter().map(|case| row(case, &golden, options.bless)).collect();
    compare_methods(&mut rows);
    if !rows.is_empty() {
        print!("{}{}", present::table(&rows).text(), present::failures(&rows));
    }
    let scheme_rows: Vec<_> = schemes.iter().map(|case| schemes::measure(case, effort)).collect();
    if !scheme_rows.is_empty() {
        print!("\n{}{}", schemes::table(&scheme_rows).text(), schemes::failures(&scheme_rows));
    }

    let good = rows.iter().all(|row| row.failures.is_empty())
        && scheme_rows.iter().all(schemes::Row::passes);
    present::write_json(&rows, &scheme_rows, options.json.as_deref())?;
    if options.bless {
        let whole = options.scene.is_empty()
            && options.method.is_none()
            && options.only != Some(Part::Schemes);
        golden.bless(&rows, whole);
        golden.write(&golden_file).with_context(|| golden_file.display().to_string())?;
        println!("golden numbers written to {}", golden_file.display());
    }
    let study = options.full.map(study::run).transpose()?;
    let good = good && study.as_ref().is_none_or(|study| study.good);
    if let Some(path) = &options.html {
        let convergence = study.map_or(Vec::new(), |study| study.convergence);
        let page =
            html::Page { good, rows: &rows, schemes: &scheme_rows, cases: &cases, convergence };
        page.write(path.as_deref())?;
    }
    Ok(good)
}

/// What is measured.
struct Selection {
    cases: Vec<Case>,
    schemes: Vec<schemes::Case>,
}

fn select(options: &Options, effort: Effort) -> Result<Selection> {
    let mut cases = cases::all(options.method)?;
    let mut schemes = schemes::cases(effort);
    for name in &options.scene {
        let scenes = cases.iter().map(|case| &*case.scene.name);
        let mut known: Vec<&str> =
            scenes.chain(schemes.iter().map(|case| &*case.surface)).collect();
        known.dedup();
        if !known.contains(&&**name) {
            bail!("there is no scene or surface named `{name}`; known are {}", known.join(", "));
        }
    }
    let wanted = |name: &String| options.scene.is_empty() || options.scene.contains(name);
    cases.retain(|case| wanted(&case.scene.name) && options.only != Some(Part::Schemes));
    schemes.retain(|case| {
        wanted(&case.surface) && options.only != Some(Part::Splines) && options.method.is_none()
    });
    Ok(Selection { cases, schemes })
}

fn row(case: &Case, golden: &Golden, bless: bool) -> Row {
    if std::io::stderr().is_terminal() {
        eprint!("\x1b[K{} ({:?})\r", case.scene.name, case.method);
    }
    let (measures, failures) = match measures::measure(case) {
        Ok(measures) => {
            let mut failures = bounds::broken(&measures, case.bounds());
            if !bless {
                failures.extend(golden.differences(&case.scene.name, case.method, &measures));
            }
            (Some(measures), failures)
        }
        Err(error) => (None, vec![format!("{error:#}")]),
    };
    Row { scene: case.scene.name.clone(), method: case.method, measures, failures }
}

/// The refined method must be nowhere worse than the published one.
fn compare_methods(rows: &mut [Row]) {
    let published: Vec<(String, Measures)> = rows
        .iter()
        .filter(|row| row.method == Method::Published)
        .filter_map(|row| Some((row.scene.clone(), row.measures.clone()?)))
        .collect();
    for row in rows.iter_mut().filter(|row| row.method == Method::Refined) {
        let Some(measures) = &row.measures else { continue };
        let other = published.iter().find(|(scene, _)| *scene == row.scene);
        if let Some((_, other)) = other {
            row.failures.extend(bounds::worse_than_published(measures, other));
        }
    }
}
