//! Golden numbers: what our own program measured when somebody last looked.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use smoothpatch::io::Method;

use super::Row;
use super::measures::Measures;

/// Relative difference of golden and measured figures that is taken for round-off in other
/// libraries and compilers.
const TOLERANCE: f64 = 0.01;

/// Golden numbers by scene and method.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct Golden {
    scenes: BTreeMap<String, BTreeMap<Method, Numbers>>,
}

/// The figures that are compared: counts exactly, the others within [`TOLERANCE`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Numbers {
    faces: usize,
    euler: i64,
    components: usize,
    folds: usize,
    fallbacks: usize,
    retreats: usize,
    max_deviation: f64,
    rms_deviation: f64,
    max_normal_error_deg: f64,
    sqp_iterations: f64,
}

impl From<&Measures> for Numbers {
    fn from(m: &Measures) -> Self {
        Self {
            faces: m.faces,
            euler: m.euler,
            components: m.components,
            folds: m.folds,
            fallbacks: m.fallbacks,
            retreats: m.retreats,
            max_deviation: m.max_deviation,
            rms_deviation: m.rms_deviation,
            max_normal_error_deg: m.max_normal_error_deg,
            sqp_iterations: m.sqp_iterations,
        }
    }
}

impl Numbers {
    fn counts(&self) -> [(&'static str, i128); 6] {
        [
            ("faces", self.faces as i128),
            ("Euler characteristic", self.euler.into()),
            ("components", self.components as i128),
            ("folds", self.folds as i128),
            ("fallbacks", self.fallbacks as i128),
            ("retreats", self.retreats as i128),
        ]
    }

    fn figures(&self) -> [(&'static str, f64); 4] {
        [
            ("max deviation", self.max_deviation),
            ("RMS deviation", self.rms_deviation),
            ("normal error", self.max_normal_error_deg),
            ("SQP iterations", self.sqp_iterations),
        ]
    }
}

impl Golden {
    /// An absent file holds no numbers.
    pub(super) fn read(path: &Path) -> Result<Self> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
        serde_json::from_str(&text).with_context(|| path.display().to_string())
    }

    pub(super) fn write(&self, path: &Path) -> Result<()> {
        std::fs::write(path, serde_json::to_string_pretty(self)? + "\n")?;
        Ok(())
    }

    /// A sentence for every number that changed.
    pub(super) fn differences(&self, scene: &str, method: Method, m: &Measures) -> Vec<String> {
        let Some(golden) = self.scenes.get(scene).and_then(|methods| methods.get(&method)) else {
            return vec!["no golden numbers; look at the figures and run with --bless".into()];
        };
        let measured = Numbers::from(m);
        let counts = golden.counts().into_iter().zip(measured.counts());
        let counts = counts
            .filter(|((_, golden), (_, measured))| golden != measured)
            .map(|((what, golden), (_, measured))| format!("{what} {measured}, golden {golden}"));
        let figures = golden.figures().into_iter().zip(measured.figures());
        let figures = figures
            .filter(|((_, golden), (_, measured))| !close(*golden, *measured))
            .map(|((what, golden), (_, measured))| {
                let change = 100.0 * (measured / golden - 1.0);
                format!("{what} {measured:.4e}, golden {golden:.4e} ({change:+.2} %)")
            });
        counts.chain(figures).collect()
    }

    /// Takes the measured figures; `whole` if scenes that are not among the rows do not exist.
    pub(super) fn bless(&mut self, rows: &[Row], whole: bool) {
        if whole {
            self.scenes.clear();
        }
        for row in rows {
            if let Some(measures) = &row.measures {
                let scene = self.scenes.entry(row.scene.clone()).or_default();
                scene.insert(row.method, measures.into());
            }
        }
    }
}

/// False for numbers that are not finite.
fn close(golden: f64, measured: f64) -> bool {
    (measured - golden).abs() <= TOLERANCE * golden.abs()
}

#[cfg(test)]
mod tests {
    use super::super::bounds::tests::perfect;
    use super::*;

    fn blessed(measures: Measures) -> Golden {
        let mut golden = Golden::default();
        let row = Row {
            scene: "ball".into(),
            method: Method::Refined,
            measures: Some(measures),
            failures: Vec::new(),
        };
        golden.bless(&[row], true);
        golden
    }

    #[test]
    fn small_differences_pass() {
        let golden = blessed(perfect());
        let near = Measures { max_deviation: 1.009e-6, row_residual: 3e-14, ..perfect() };
        assert!(golden.differences("ball", Method::Refined, &near).is_empty());
    }

    #[test]
    fn changes_are_named() {
        let golden = blessed(perfect());
        let other = Measures { faces: 202, max_deviation: 1.02e-6, ..perfect() };
        let differences = golden.differences("ball", Method::Refined, &other);
        assert_eq!(differences[0], "faces 202, golden 200");
        assert_eq!(differences[1], "max deviation 1.0200e-6, golden 1.0000e-6 (+2.00 %)");
        assert_eq!(differences.len(), 2);
    }

    #[test]
    fn what_is_not_known_fails() {
        let golden = blessed(perfect());
        assert_eq!(golden.differences("ball", Method::Published, &perfect()).len(), 1);
        let nan = Measures { rms_deviation: f64::NAN, ..perfect() };
        assert_eq!(golden.differences("ball", Method::Refined, &nan).len(), 1);
    }
}
