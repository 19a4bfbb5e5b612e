//! `cargo xtask verify`: every scene in every method, measured and compared.

mod bounds;
mod cases;
mod golden;
mod measures;
mod present;

use std::io::IsTerminal;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use serde::Serialize;
use smoothpatch::io::Method;

use cases::Case;
use golden::Golden;
use measures::Measures;

#[derive(Args)]
pub(crate) struct Options {
    /// Only these scenes.
    #[arg(long, num_args = 1.., value_name = "NAME")]
    scene: Vec<String>,
    /// Only this method.
    #[arg(long)]
    method: Option<MethodName>,
    /// Where to write the figures; by default target/verify/verify.json.
    #[arg(long, value_name = "PATH")]
    json: Option<PathBuf>,
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
    full: Option<crate::study::Part>,
    /// Number of threads; by default one per core.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
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
    let cases = cases::find(&options.scene, options.method)?;

    let mut rows: Vec<Row> = cases.iter().map(|case| row(case, &golden, options.bless)).collect();
    compare_methods(&mut rows);

    let good = rows.iter().all(|row| row.failures.is_empty());
    print!("{}", present::table(&rows).text());
    print!("{}", present::failures(&rows));
    present::write_json(&rows, options.json.as_deref())?;
    if options.bless {
        let whole = options.scene.is_empty() && options.method.is_none();
        golden.bless(&rows, whole);
        golden.write(&golden_file).with_context(|| golden_file.display().to_string())?;
        println!("golden numbers written to {}", golden_file.display());
    }
    let good_study = match options.full {
        Some(part) => crate::study::run(part)?,
        None => true,
    };
    Ok(good && good_study)
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
