//! The second table of `cargo xtask verify`: patch schemes over given meshes.

mod meshes;
mod nagata;
mod polyhedral;
mod rational;

use std::io::IsTerminal;
use std::time::Instant;

use anyhow::Result;
use serde::Serialize;

use crate::check::Check;
use crate::table::{Table, scientific};

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// What the gate runs: few and small meshes.
    Usual,
    /// All resolutions.
    Full,
}

/// A surface in a scheme, to be measured.
pub(crate) struct Case {
    pub(crate) surface: String,
    pub(crate) scheme: String,
    pub(crate) measure: Box<dyn Fn(Effort) -> Result<Measured>>,
}

impl Case {
    fn new(
        surface: impl Into<String>,
        scheme: impl Into<String>,
        measure: impl Fn(Effort) -> Result<Measured> + 'static,
    ) -> Self {
        Self { surface: surface.into(), scheme: scheme.into(), measure: Box::new(measure) }
    }
}

/// What was measured on the finest mesh of a case; missing where it does not apply.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Measured {
    pub(crate) faces: usize,
    pub(crate) euler: i64,
    /// Largest angle between the normals of neighbours along their common edge, in radians; creases
    /// apart.
    pub(crate) kink: Option<f64>,
    /// Largest distance from the surface that is approximated, over the diagonal of the mesh.
    pub(crate) deviation: Option<f64>,
    /// Observed order of the deviation, between the last two resolutions.
    pub(crate) order: Option<f64>,
    /// Everything that must hold.
    pub(crate) checks: Vec<Check>,
}

/// One line of the table.
#[derive(Serialize)]
pub(crate) struct Row {
    surface: String,
    scheme: String,
    measured: Option<Measured>,
    /// Seconds for building and measuring all meshes of the case.
    seconds: f64,
    failures: Vec<String>,
}

impl Row {
    pub(crate) fn passes(&self) -> bool {
        self.failures.is_empty()
    }
}

/// All cases, in the order of the table.
pub(crate) fn cases(effort: Effort) -> Vec<Case> {
    [nagata::cases(), rational::cases(), polyhedral::cases(effort), meshes::cases()]
        .into_iter()
        .flatten()
        .collect()
}

pub(crate) fn measure(case: &Case, effort: Effort) -> Row {
    if std::io::stderr().is_terminal() {
        eprint!("\x1b[K{} ({})\r", case.surface, case.scheme);
    }
    let start = Instant::now();
    let result = (case.measure)(effort);
    let seconds = start.elapsed().as_secs_f64();
    let (measured, failures) = match result {
        Ok(measured) => {
            let broken = measured.checks.iter().filter(|check| !check.holds);
            let failures = broken.map(Check::failure).collect();
            (Some(measured), failures)
        }
        Err(error) => (None, vec![format!("{error:#}")]),
    };
    let Case { surface, scheme, .. } = case;
    Row { surface: surface.clone(), scheme: scheme.clone(), measured, seconds, failures }
}

const HEAD: [&str; 10] =
    ["surface", "scheme", "faces", "Euler", "kink rad", "max", "order", "checks", "s", ""];

/// One line per case.
pub(crate) fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(&HEAD);
    for row in rows {
        let verdict = if row.passes() { "pass" } else { "FAIL" };
        let mut cells = vec![row.surface.clone(), row.scheme.clone()];
        match &row.measured {
            Some(measured) => cells.extend(figures(measured)),
            None => cells.extend(std::iter::repeat_n("-".to_owned(), HEAD.len() - 4)),
        }
        cells.push(format!("{:.2}", row.seconds));
        cells.push(verdict.to_owned());
        table.add(cells);
    }
    table
}

fn figures(m: &Measured) -> [String; 6] {
    let or_dash = |x: Option<String>| x.unwrap_or_else(|| "-".to_owned());
    [
        m.faces.to_string(),
        m.euler.to_string(),
        or_dash(m.kink.map(scientific)),
        or_dash(m.deviation.map(scientific)),
        or_dash(m.order.map(|order| format!("{order:.2}"))),
        m.checks.len().to_string(),
    ]
}

/// A line for every reason.
pub(crate) fn failures(rows: &[Row]) -> String {
    let lines = rows.iter().flat_map(|row| {
        let name = format!("{}, {}", row.surface, row.scheme);
        row.failures.iter().map(move |failure| format!("FAIL {name}: {failure}\n"))
    });
    lines.collect()
}
