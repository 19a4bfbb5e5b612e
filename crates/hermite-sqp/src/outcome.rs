//! What became of one edge.

use bezier_core::QuarticCurve;

/// A curve and how it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeOutcome {
    /// The curve; usable whatever the status.
    pub curve: QuarticCurve,
    /// How it was found.
    pub status: EdgeStatus,
}

/// How a curve was found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum EdgeStatus {
    /// The iteration converged to a curve with end tangents of sensible lengths.
    Converged {
        /// Steps taken.
        iterations: usize,
        /// Steps until the paper's criterion,
        /// [`Settings::PUBLISHED_TOLERANCE`](crate::Settings::PUBLISHED_TOLERANCE), was met.
        published_iterations: usize,
    },
    /// The fallback curve was taken: a place that the base mesh does not resolve.
    Fallback(FallbackReason),
}

impl EdgeStatus {
    /// Whether the fallback curve was taken.
    #[must_use]
    pub fn is_fallback(&self) -> bool {
        matches!(self, Self::Fallback(_))
    }
}

/// Why the fallback curve was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FallbackReason {
    /// The samples do not determine a curve.
    NoStart,
    /// The largest number of iterations was not enough.
    NotConverged,
    /// A step was not finite.
    Singular,
    /// The iteration converged, but an end tangent is too short or too long for its edge.
    LengthOutOfRange {
        /// Lengths of the end tangents at start and end, in chord lengths.
        lengths: [f64; 2],
    },
}
