//! What a verified result must satisfy.

use serde::{Deserialize, Serialize};

use super::error::SceneError;

/// A way to construct the patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Method {
    /// The construction as published.
    Published,
    /// The construction with our refinements.
    Refined,
}

/// Bounds on measured quantities of a result, ends included; what is not given is not checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bounds {
    /// Euler characteristic of the base mesh, exactly.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub euler: Option<i64>,
    /// Largest distance to the surface, relative to the diagonal of the bounding box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_deviation: Option<f64>,
    /// Root mean square distance to the surface, relative to the diagonal of the bounding box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms_deviation: Option<f64>,
    /// Largest angle between patch normal and surface normal, in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_normal_error_deg: Option<f64>,
    /// Largest angle between the normals of two patches along their common edge, in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub g1_angle_deg: Option<f64>,
    /// Largest residual of the G1 conditions in the control points, relative to the edge length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub row_residual: Option<f64>,
    /// Number of patches that fold over.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folds: Option<usize>,
    /// Number of boundary curves that fell back to a simpler construction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fallbacks: Option<usize>,
    /// Lower and upper bound of the mean number of SQP iterations per boundary curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sqp_iterations: Option<(f64, f64)>,
}

impl Bounds {
    pub(super) fn check(&self, method: Method) -> Result<(), SceneError> {
        let upper = [
            ("max_deviation", self.max_deviation),
            ("rms_deviation", self.rms_deviation),
            ("max_normal_error_deg", self.max_normal_error_deg),
            ("g1_angle_deg", self.g1_angle_deg),
            ("row_residual", self.row_residual),
        ];
        for (name, value) in upper {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value >= 0.0)) {
                return Err(SceneError::Bound { method, name, value });
            }
        }
        match self.sqp_iterations {
            Some((low, high)) if !(low >= 0.0 && low <= high && high.is_finite()) => {
                Err(SceneError::BoundInterval { method, name: "sqp_iterations", low, high })
            }
            _ => Ok(()),
        }
    }
}
