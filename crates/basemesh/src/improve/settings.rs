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
    /// Triangle quality below which changes may not push a triangle. Default 0.4: all angles of
    /// better triangles are above 13.7°.
    pub min_quality: f64,
    /// Share of its quality that a triangle below `min_quality` must keep. Default 0.95: a strict
    /// limit would freeze the slivers of a marched mesh.
    pub quality_keep: f64,
    /// Smallest cosine between a face before and after a change. Default 0.2.
    pub flip_cos: f64,
    /// Smallest cosine between a face and the surface normals at its corners. Default 0.75 (41°):
    /// faces that lean more stand across a ridge that their corners do not show.
    pub lean_cos: f64,
    /// Smallest valence that a change may leave. Default 4.
    pub min_valence: usize,
    /// Smoothing sweeps after each set of flips. Default 6.
    pub smoothing_iterations: usize,
    /// Rounds of flips and smoothing. Default 2.
    pub rounds: usize,
    /// How much the turning of the surface counts against distances when edges are compared. With
    /// the default 1, both have the same part in the sum of squared lengths over all edges; zero
    /// makes triangles equilateral and destroys adaptation to curvature.
    pub turning_weight: f64,
}

impl Default for ImproveSettings {
    fn default() -> Self {
        Self {
            max_turning_deg: 50.0,
            min_quality: 0.4,
            quality_keep: 0.95,
            flip_cos: 0.2,
            lean_cos: 0.75,
            min_valence: 4,
            smoothing_iterations: 6,
            rounds: 2,
            turning_weight: 1.0,
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
