//! Results that `cargo bench` leaves in `target/criterion`.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};

/// Medians by the full name of a bench.
#[derive(Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct Measurements(BTreeMap<String, Measurement>);

/// One median with its spread.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Measurement {
    /// Nanoseconds for each element of the throughput, or for one run where there is none.
    pub(super) nanoseconds: f64,
    /// Ends of the confidence interval (95 %) of the median, in the same unit.
    pub(super) interval: [f64; 2],
}

#[derive(Deserialize)]
struct Bench {
    full_id: String,
    throughput: Option<BTreeMap<String, f64>>,
}

#[derive(Deserialize)]
struct Estimates {
    median: Estimate,
}

#[derive(Deserialize)]
struct Estimate {
    point_estimate: f64,
    confidence_interval: Interval,
}

#[derive(Deserialize)]
struct Interval {
    lower_bound: f64,
    upper_bound: f64,
}

impl Measurements {
    /// All results below a folder.
    pub(super) fn read(folder: &Path) -> Result<Self> {
        let mut found = BTreeMap::new();
        collect(folder, &mut found)
            .with_context(|| format!("{}: no results; run without --saved", folder.display()))?;
        ensure!(!found.is_empty(), "{}: no results; run without --saved", folder.display());
        Ok(Self(found))
    }

    pub(super) fn get(&self, name: &str) -> Option<Measurement> {
        self.0.get(name).copied()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&str, Measurement)> {
        self.0.iter().map(|(name, measurement)| (name.as_str(), *measurement))
    }
}

fn collect(folder: &Path, found: &mut BTreeMap<String, Measurement>) -> Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.ends_with("new") {
            let (name, measurement) = read(&path)?;
            found.insert(name, measurement);
        } else if path.is_dir() {
            collect(&path, found)?;
        }
    }
    Ok(())
}

fn read(folder: &Path) -> Result<(String, Measurement)> {
    let text = |file: &str| std::fs::read_to_string(folder.join(file));
    let bench: Bench = serde_json::from_str(&text("benchmark.json")?)?;
    let Estimates { median } = serde_json::from_str(&text("estimates.json")?)?;
    let elements = bench.throughput.and_then(|t| t.into_values().next()).unwrap_or(1.0);
    let Interval { lower_bound, upper_bound } = median.confidence_interval;
    let measurement = Measurement {
        nanoseconds: median.point_estimate / elements,
        interval: [lower_bound / elements, upper_bound / elements],
    };
    Ok((bench.full_id, measurement))
}
