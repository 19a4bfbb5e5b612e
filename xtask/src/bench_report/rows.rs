//! The rows of the table: what a bench stands for, its target and its limit.

use super::measured::Measurements;
use crate::table::Table;

/// A figure of the table.
pub(super) struct Row {
    what: &'static str,
    /// Full name of the bench.
    bench: &'static str,
    /// What its nanoseconds are turned into.
    unit: Unit,
    /// Largest time, or smallest rate, in the unit.
    target: f64,
    /// What one element costs at least.
    limit: Limit,
    /// What the paper or the nearest peer needs.
    others: &'static str,
}

enum Unit {
    Nanoseconds,
    Microseconds,
    /// Million a second.
    Millions,
}

enum Limit {
    /// Floating-point operations.
    Operations(f64),
    /// Bytes to and from memory.
    Bytes(f64),
    Unknown,
}

use Limit::{Bytes, Operations, Unknown};
use Unit::{Microseconds, Millions, Nanoseconds};

/// Floating-point operations a second of the calibration, and bytes.
const PEAK: &str = "calibration/multiply-add";
const TRIAD: &str = "calibration/triad";

/// Operation counts: twice the products of points and basis values.
const ROWS: [Row; 13] = [
    row(
        "fit over a base mesh, a patch",
        "fit_base_mesh/published/10000",
        Microseconds,
        20.0,
        Unknown,
        "4200-6700 µs [TK09]",
    ),
    row("the same, refined", "fit_base_mesh/refined/10000", Microseconds, 20.0, Unknown, ""),
    row("point on a grid", "septic/grid/points/153", Nanoseconds, 5.0, Operations(216.0), ""),
    row(
        "point and unit normal on a grid",
        "septic/grid/points_and_unit_normals/153",
        Nanoseconds,
        20.0,
        Operations(680.0),
        "105-136 ns OpenSubdiv",
    ),
    row(
        "point and unit normal, own parameters",
        "septic/grid/own parameters/153",
        Nanoseconds,
        30.0,
        Operations(640.0),
        "",
    ),
    row(
        "point and area normal, one call",
        "septic/point_and_area_normal",
        Nanoseconds,
        250.0,
        Operations(640.0),
        "",
    ),
    row(
        "15 inner points from 66 samples",
        "shared_fit/15 of 66",
        Microseconds,
        0.25,
        Operations(9180.0),
        "",
    ),
    row("a curve by SQP", "solve/torus", Microseconds, 1.44, Unknown, ""),
    row(
        "projection, deccube, a sample",
        "project/shape/deccube/many",
        Nanoseconds,
        140.0,
        Unknown,
        "",
    ),
    row(
        "polygonizer, triangles",
        "polygonize/deccube/*",
        Millions,
        1.0,
        Unknown,
        "0.25-0.63 Bloomenthal",
    ),
    row(
        "decimation, triangles in",
        "simplify/to 5 percent/*",
        Millions,
        0.25,
        Unknown,
        "0.05 CGAL, 0.2 meshlib",
    ),
    row(
        "Nagata C0, a triangle",
        "C0 patches, nothing shared/built",
        Nanoseconds,
        25.0,
        Bytes(324.0),
        "320 ns Loop, an output triangle",
    ),
    row(
        "Nagata C0 and 15 points",
        "C0 patches, nothing shared/built, and 15 points each to memory",
        Nanoseconds,
        80.0,
        Bytes(756.0),
        "",
    ),
];

const fn row(
    what: &'static str,
    bench: &'static str,
    unit: Unit,
    target: f64,
    limit: Limit,
    others: &'static str,
) -> Row {
    Row { what, bench, unit, target, limit, others }
}

impl Row {
    /// All rows with what was measured.
    pub(super) fn table(measurements: &Measurements) -> String {
        let head = ["measure", "ours", "unit", "target", "", "limit", "share", "others"];
        let mut table = Table::new(&head);
        ROWS.iter().for_each(|row| table.add(row.cells(measurements)));
        let calibration = |name, what: &str, unit: &str| match measurements.get(name) {
            Some(m) => format!("{what}: {:.1} {unit}\n", 1.0 / m.nanoseconds),
            None => format!("{what}: not measured\n"),
        };
        table.text()
            + "\n"
            + &calibration(PEAK, "multiply-add", "GFLOP/s")
            + &calibration(TRIAD, "memory triad", "GB/s")
    }

    fn cells(&self, measurements: &Measurements) -> Vec<String> {
        let nanoseconds = self.find(measurements);
        let limit = match self.limit {
            Operations(count) => measurements.get(PEAK).map(|peak| count * peak.nanoseconds),
            Bytes(count) => measurements.get(TRIAD).map(|triad| count * triad.nanoseconds),
            Unknown => None,
        };
        let text = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), significant);
        let ours = nanoseconds.map(|ns| self.unit.of(ns));
        let verdict = match ours {
            None => "not measured",
            Some(ours) if self.unit.is_met(ours, self.target) => "met",
            Some(_) => "missed",
        };
        let share =
            limit.zip(nanoseconds).map(|(limit, ns)| format!("{:.0} %", 100.0 * limit / ns));
        vec![
            self.what.into(),
            text(ours),
            self.unit.name().into(),
            significant(self.target),
            verdict.into(),
            text(limit.map(|ns| self.unit.of(ns))),
            share.unwrap_or_else(|| "-".into()),
            self.others.into(),
        ]
    }

    /// The bench, or the largest one where the name ends with a star.
    fn find(&self, measurements: &Measurements) -> Option<f64> {
        let Some(start) = self.bench.strip_suffix('*') else {
            return measurements.get(self.bench).map(|m| m.nanoseconds);
        };
        let sized = measurements.iter().filter_map(|(name, measurement)| {
            let size: u64 = name.strip_prefix(start)?.parse().ok()?;
            Some((size, measurement.nanoseconds))
        });
        sized.max_by_key(|&(size, _)| size).map(|(_, ns)| ns)
    }
}

impl Unit {
    const fn of(&self, nanoseconds: f64) -> f64 {
        match self {
            Nanoseconds => nanoseconds,
            Microseconds => nanoseconds / 1e3,
            Millions => 1e3 / nanoseconds,
        }
    }

    const fn name(&self) -> &'static str {
        match self {
            Nanoseconds => "ns",
            Microseconds => "µs",
            Millions => "million/s",
        }
    }

    const fn is_met(&self, ours: f64, target: f64) -> bool {
        match self {
            Nanoseconds | Microseconds => ours <= target,
            Millions => ours >= target,
        }
    }
}

fn significant(x: f64) -> String {
    if x >= 100.0 { format!("{x:.0}") } else { format!("{x:.2}") }
}
