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
    /// Most rounds that split edges beyond the two turning limits and collapse others instead.
    /// Default 8.
    pub exchange_rounds: usize,
    /// Twice the angle in degrees between the surface normal near the middle of an edge and those
    /// at its ends, above which the edge is split if faces can be spared elsewhere. Default 60: an
    /// edge over a bend that both its ends miss turns little from end to end.
    pub max_middle_turning_deg: f64,
    /// See [`ImproveSettings::max_turning_deg`]. Default 50.
    pub max_turning_deg: f64,
    /// See [`ImproveSettings::min_quality`]. Default 0.4.
    pub min_quality: f64,
    /// See [`ImproveSettings::quality_keep`]. Default 0.95.
    pub quality_keep: f64,
    /// See [`ImproveSettings::flip_cos`]. Default 0.2.
    pub flip_cos: f64,
    /// See [`ImproveSettings::lean_cos`]. Default 0.75.
    pub lean_cos: f64,
    /// See [`ImproveSettings::min_valence`]. Default 4.
    pub min_valence: usize,
    /// See [`ImproveSettings::smoothing_iterations`]. Default 6.
    pub smoothing_iterations: usize,
    /// See [`ImproveSettings::rounds`]. Default 2.
    pub rounds: usize,
    /// See [`ImproveSettings::turning_weight`]. Default 1.
    pub turning_weight: f64,
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
            max_middle_turning_deg: 60.0,
            max_turning_deg: improve.max_turning_deg,
            min_quality: improve.min_quality,
            quality_keep: improve.quality_keep,
            flip_cos: improve.flip_cos,
            lean_cos: improve.lean_cos,
            min_valence: improve.min_valence,
            smoothing_iterations: improve.smoothing_iterations,
            rounds: improve.rounds,
            turning_weight: improve.turning_weight,
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
            turning_weight: self.turning_weight,
        }
    }
}
