//! The table, the reasons below it, and the JSON file.

use std::path::Path;

use anyhow::{Context, Result};
use serde::Serialize;
use smoothpatch::io::Method;

use super::Row;
use super::measures::Measures;
use crate::schemes;
use crate::table::{Table, scientific};

const HEAD: [&str; 18] = [
    "scene",
    "method",
    "faces",
    "Euler",
    "G1 °",
    "row",
    "max",
    "RMS",
    "normal °",
    "folds",
    "fallb.",
    "retr.",
    "SQP",
    "vertex",
    "vx. n",
    "vx. II",
    "s",
    "",
];

/// One line per case.
pub(super) fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(&HEAD);
    for row in rows {
        let verdict = if row.failures.is_empty() { "pass" } else { "FAIL" };
        let mut cells = vec![row.scene.clone(), name(row.method).to_owned()];
        match &row.measures {
            Some(measures) => cells.extend(figures(measures)),
            None => cells.extend(std::iter::repeat_n("-".to_owned(), HEAD.len() - 3)),
        }
        cells.push(verdict.to_owned());
        table.add(cells);
    }
    table
}

fn figures(m: &Measures) -> [String; 15] {
    [
        m.faces.to_string(),
        m.euler.to_string(),
        scientific(m.g1_angle_deg),
        scientific(m.row_residual),
        scientific(m.max_deviation),
        scientific(m.rms_deviation),
        format!("{:.4}", m.max_normal_error_deg),
        m.folds.to_string(),
        m.fallbacks.to_string(),
        m.retreats.to_string(),
        format!("{:.2}", m.sqp_iterations),
        scientific(m.vertex_position),
        scientific(m.vertex_normal),
        scientific(m.vertex_second_form),
        format!("{:.2}", m.seconds),
    ]
}

fn name(method: Method) -> &'static str {
    match method {
        Method::Published => "published",
        Method::Refined => "refined",
    }
}

/// A line for every reason.
pub(super) fn failures(rows: &[Row]) -> String {
    let mut text = String::new();
    for row in rows {
        for failure in &row.failures {
            text += &format!("FAIL {}, {}: {failure}\n", row.scene, name(row.method));
        }
    }
    text
}

#[derive(Serialize)]
struct File<'a> {
    threads: usize,
    passed: bool,
    /// Splines fitted to the scenes.
    cases: &'a [Row],
    /// Patch schemes over given meshes.
    schemes: &'a [schemes::Row],
}

/// Writes all figures to `path`, or to `target/verify/verify.json`.
pub(super) fn write_json(
    rows: &[Row],
    schemes: &[schemes::Row],
    path: Option<&Path>,
) -> Result<()> {
    let usual = crate::root().join("target/verify/verify.json");
    let path = path.unwrap_or(&usual);
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    let file = File {
        threads: rayon::current_num_threads(),
        passed: rows.iter().all(|row| row.failures.is_empty())
            && schemes.iter().all(schemes::Row::passes),
        cases: rows,
        schemes,
    };
    std::fs::write(path, serde_json::to_string_pretty(&file)? + "\n")
        .with_context(|| path.display().to_string())
}
