//! How good a surface is, measured on its control nets alone and against a target.

mod certify;
mod continuity;
mod deviation;
mod interpolation;

pub use certify::{Certificate, USUAL_CUTS, certify};
pub use continuity::{Continuity, SEAM_SAMPLES, continuity, continuity_beside, seam};
pub use deviation::{Deviation, FaceDeviation, GRID, deviation, deviation_on_grid, folded_patches};
pub(crate) use deviation::{
    PatchSamples, deviation_by, deviation_of, face_deviations, sampled, settle, turns_over,
};
pub use interpolation::{Interpolation, interpolation};
