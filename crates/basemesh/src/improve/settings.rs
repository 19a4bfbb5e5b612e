//! Settings of the improvement.

use super::guard::Guard;

/// Settings of [`improve`](crate::improve); all are dimensionless.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImproveSettings {
    /// Largest angle in degrees that the surface normal may turn along a changed edge, unless it
    /// turned farther before. Default 50: of spline patches whose edges turn by less than 60°, one
    /// in a thousand folds, above 90° four in five do.
    pub max_turning_deg: f64,
    /// Triangle quality below which changes may not push a triangle. Default 0.25.
    pub min_quality: f64,
    /// Share of its quality that a triangle below `min_quality` must keep. Default 0.95: a strict
    /// limit would freeze the slivers of a marched mesh.
    pub quality_keep: f64,
    /// Smallest cosine between a face before and after a change. Default 0.2.
    pub flip_cos: f64,
    /// Smallest cosine between a face and the surface normals at its corners. Default 0.1; anything
    /// above zero keeps edges in order around their vertices.
    pub lean_cos: f64,
    /// Smallest valence that a change may leave. Default 4.
    pub min_valence: usize,
    /// Smoothing sweeps after each set of flips. Default 6.
    pub smoothing_iterations: usize,
    /// Rounds of flips and smoothing. Default 2.
    pub rounds: usize,
    /// Power of the normal turning (radians) in the weight of a face while smoothing. Default 0.5;
    /// zero makes areas equal and destroys adaptation to curvature.
    pub density_exponent: f64,
    /// Turning in radians added before the power is taken, which limits how large flat faces
    /// become. Default 0.02.
    pub density_offset: f64,
}

impl Default for ImproveSettings {
    fn default() -> Self {
        Self {
            max_turning_deg: 50.0,
            min_quality: 0.25,
            quality_keep: 0.95,
            flip_cos: 0.2,
            lean_cos: 0.1,
            min_valence: 4,
            smoothing_iterations: 6,
            rounds: 2,
            density_exponent: 0.5,
            density_offset: 0.02,
        }
    }
}

impl ImproveSettings {
    pub(crate) fn guard(&self) -> Guard {
        Guard {
            turning_cos: self.max_turning_deg.to_radians().cos(),
            min_quality: self.min_quality,
            quality_keep: self.quality_keep,
            flip_cos: self.flip_cos,
            lean_cos: self.lean_cos,
            min_valence: self.min_valence,
        }
    }
}
