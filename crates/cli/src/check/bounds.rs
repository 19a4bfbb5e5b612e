//! What a file must satisfy.

use std::fmt;

use clap::Args;
use serde::Serialize;

use super::findings::Measured;
use crate::surface::SURFACE;
use crate::values;

/// Bounds given as options; they hold with equality.
#[derive(Args)]
#[group(skip)]
#[command(next_help_heading = "Bounds")]
pub(crate) struct Bounds {
    /// Largest distance to the surface over the diagonal of the bounding box; with --mesh, in both
    /// directions
    #[arg(long, value_name = "X", requires = SURFACE, value_parser = values::bound)]
    max_deviation: Option<f64>,

    /// Root mean square distance over the diagonal
    #[arg(long, value_name = "X", requires = SURFACE, value_parser = values::bound)]
    max_rms_deviation: Option<f64>,

    /// Largest angle between patch normal and surface normal
    #[arg(long, value_name = "DEG", requires = SURFACE, value_parser = values::bound)]
    max_normal_error: Option<f64>,

    /// Largest angle between the normals of neighbouring patches along their edge
    #[arg(long, value_name = "DEG", value_parser = values::bound)]
    max_g1_angle: Option<f64>,

    /// Largest distance of corresponding boundary control points (a length)
    #[arg(long, value_name = "X", value_parser = values::bound)]
    max_gap: Option<f64>,

    /// Number of patches that fold over
    #[arg(long, value_name = "N")]
    max_folds: Option<usize>,

    /// Euler characteristic, exactly
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    euler: Option<i64>,

    /// Number of connected components, exactly
    #[arg(long, value_name = "N")]
    components: Option<usize>,

    /// No open edges
    #[arg(long)]
    closed: bool,
}

/// A number that was measured, or its bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub(crate) enum Figure {
    Count(i64),
    Real(f64),
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(count) => write!(f, "{count}"),
            // all digits, so that a value just above its limit looks like it
            Self::Real(value) => write!(f, "{value:e}"),
        }
    }
}

/// One bound and how it was met.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Verdict {
    /// The option without its dashes.
    pub(crate) bound: &'static str,
    pub(crate) limit: Figure,
    pub(crate) measured: Figure,
    pub(crate) holds: bool,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { bound, limit, measured, holds } = self;
        let verdict = if *holds { "holds" } else { "exceeded" };
        match *bound {
            CLOSED => write!(f, "--{CLOSED} {verdict}: {measured} open edges"),
            _ => write!(f, "--{bound} {limit} {verdict}: measured {measured}"),
        }
    }
}

const CLOSED: &str = "closed";

impl Verdict {
    fn at_most(bound: &'static str, limit: f64, measured: f64) -> Self {
        // not a number never holds
        let holds = measured <= limit;
        Self { bound, limit: Figure::Real(limit), measured: Figure::Real(measured), holds }
    }

    fn count(bound: &'static str, limit: i64, measured: i64, holds: bool) -> Self {
        Self { bound, limit: Figure::Count(limit), measured: Figure::Count(measured), holds }
    }
}

impl Bounds {
    /// A bound that has no meaning when patches are compared with a mesh.
    pub(super) fn not_for_meshes(&self) -> Option<&'static str> {
        [
            (self.max_rms_deviation.is_some(), "--max-rms-deviation"),
            (self.max_normal_error.is_some(), "--max-normal-error"),
        ]
        .into_iter()
        .find_map(|(given, name)| given.then_some(name))
    }

    /// All bounds that were given.
    pub(crate) fn verdicts(&self, measured: &Measured) -> Vec<Verdict> {
        let joined = &measured.continuity;
        let mut reals = vec![
            ("max-g1-angle", self.max_g1_angle, joined.g1_angle_deg),
            ("max-gap", self.max_gap, joined.position_gap),
        ];
        if let Some(deviation) = &measured.deviation {
            reals.extend([
                ("max-deviation", self.max_deviation, deviation.max),
                ("max-rms-deviation", self.max_rms_deviation, deviation.rms),
                ("max-normal-error", self.max_normal_error, deviation.max_normal_deg),
            ]);
        }
        if let Some(mesh) = &measured.mesh {
            reals.push(("max-deviation", self.max_deviation, mesh.max()));
        }
        let folds = measured.folded.len();
        let exact = [
            ("euler", self.euler, joined.euler_characteristic),
            ("components", self.components.map(count), count(joined.components)),
            (CLOSED, self.closed.then_some(0), count(measured.open_edges)),
        ];
        let reals = reals
            .into_iter()
            .filter_map(|(bound, limit, measured)| Some(Verdict::at_most(bound, limit?, measured)));
        let folds = self
            .max_folds
            .map(|limit| Verdict::count("max-folds", count(limit), count(folds), folds <= limit));
        let exact = exact.into_iter().filter_map(|(bound, limit, measured)| {
            let limit = limit?;
            Some(Verdict::count(bound, limit, measured, measured == limit))
        });
        reals.chain(folds).chain(exact).collect()
    }
}

fn count(number: usize) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_with_equality_and_never_for_nan() {
        assert!(Verdict::at_most("x", 0.5, 0.5).holds, "equality");
        assert!(!Verdict::at_most("x", 0.5, 0.6).holds, "above");
        assert!(!Verdict::at_most("x", 0.5, f64::NAN).holds, "not a number");
        assert!(!Verdict::at_most("x", 0.5, f64::INFINITY).holds, "infinite");
    }
}
