//! Settings of the curve solver.

/// How far curves are drawn towards the surface after [`solve`](crate::solve).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CurveRefinement {
    /// Not at all: the published scheme.
    #[default]
    None,
    /// With end tangents of fixed direction: three free numbers a curve.
    TangentFixed,
    /// With end tangents that may turn in the tangent planes: five free numbers a curve.
    TangentFree,
}

/// Numbers that steer [`solve`](crate::solve); all dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settings {
    /// The iteration ends when unknowns (in chord lengths) and multipliers together change by less.
    ///
    /// The paper uses [`Settings::PUBLISHED_TOLERANCE`]; convergence is quadratic, so the default
    /// costs less than one more step and makes the curvature conditions hold to round-off.
    pub tolerance: f64,
    /// Most iterations before the fallback curve is taken.
    pub max_iterations: usize,
    /// Shortest accepted end tangent `|q1 - q0|`, in chord lengths.
    pub min_length: f64,
    /// Longest accepted end tangent, in chord lengths.
    pub max_length: f64,
}

impl Settings {
    /// The tolerance of \[TK09\], at which iterations are counted for comparison.
    pub const PUBLISHED_TOLERANCE: f64 = 1e-6;
}

impl Default for Settings {
    fn default() -> Self {
        Self { tolerance: 1e-9, max_iterations: 30, min_length: 0.12, max_length: 0.40 }
    }
}
