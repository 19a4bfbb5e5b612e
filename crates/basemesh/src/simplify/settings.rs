//! Settings of the simplification.

use crate::improve::ImproveSettings;

/// Settings of [`simplify`](crate::simplify); all but the number of faces are dimensionless.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SimplifySettings {
    /// Faces of the result, an even number.
    pub faces: usize,
    /// Guards apply below this multiple of `faces`; above it, only the topology and `flip_cos`
    /// matter. Default 4.
    pub plain_factor: usize,
    /// Smoothing sweeps over the input, which remove the slivers of a marched mesh. Default 6.
    pub relaxation_iterations: usize,
    /// Weight of distances to vertices against distances to planes in the cost of a collapse.
    /// Default 1e-3: it decides where edges turn by less than about two degrees.
    pub isotropy: f64,
    /// Most rounds that split edges beyond `max_turning_deg` and collapse others instead.
    /// Default 8.
    pub exchange_rounds: usize,
    /// See [`ImproveSettings::max_turning_deg`]. Default 50.
    pub max_turning_deg: f64,
    /// See [`ImproveSettings::min_quality`]. Default 0.25.
    pub min_quality: f64,
    /// See [`ImproveSettings::quality_keep`]. Default 0.95.
    pub quality_keep: f64,
    /// See [`ImproveSettings::flip_cos`]. Default 0.2.
    pub flip_cos: f64,
    /// See [`ImproveSettings::lean_cos`]. Default 0.1.
    pub lean_cos: f64,
    /// See [`ImproveSettings::min_valence`]. Default 4.
    pub min_valence: usize,
    /// See [`ImproveSettings::smoothing_iterations`]. Default 6.
    pub smoothing_iterations: usize,
    /// See [`ImproveSettings::rounds`]. Default 2.
    pub rounds: usize,
    /// See [`ImproveSettings::density_exponent`]. Default 0.5.
    pub density_exponent: f64,
    /// See [`ImproveSettings::density_offset`]. Default 0.02.
    pub density_offset: f64,
}

impl SimplifySettings {
    /// The defaults for a result of `faces` faces.
    #[must_use]
    pub fn to_faces(faces: usize) -> Self {
        let improve = ImproveSettings::default();
        Self {
            faces,
            plain_factor: 4,
            relaxation_iterations: 6,
            isotropy: 1e-3,
            exchange_rounds: 8,
            max_turning_deg: improve.max_turning_deg,
            min_quality: improve.min_quality,
            quality_keep: improve.quality_keep,
            flip_cos: improve.flip_cos,
            lean_cos: improve.lean_cos,
            min_valence: improve.min_valence,
            smoothing_iterations: improve.smoothing_iterations,
            rounds: improve.rounds,
            density_exponent: improve.density_exponent,
            density_offset: improve.density_offset,
        }
    }

    /// The part that the improvement uses.
    #[must_use]
    pub fn improve_settings(&self) -> ImproveSettings {
        ImproveSettings {
            max_turning_deg: self.max_turning_deg,
            min_quality: self.min_quality,
            quality_keep: self.quality_keep,
            flip_cos: self.flip_cos,
            lean_cos: self.lean_cos,
            min_valence: self.min_valence,
            smoothing_iterations: self.smoothing_iterations,
            rounds: self.rounds,
            density_exponent: self.density_exponent,
            density_offset: self.density_offset,
        }
    }
}
