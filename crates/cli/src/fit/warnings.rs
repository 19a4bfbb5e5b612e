//! What a user must know about a result that is not what it should be.

use smoothpatch::Report;

/// Far above the rounding of exact constructions.
const SMOOTH_DEG: f64 = 1e-6;

/// Normals of a surface that is resolved are closer than that.
const LEANING_DEG: f64 = 30.0;

/// One sentence for each flaw; none for a good result.
pub(crate) fn warnings(report: &Report) -> Vec<String> {
    let (joined, deviation) = (&report.continuity, &report.deviation);
    let mut warnings = Vec::new();
    if report.base_mesh.as_ref().is_some_and(|base| !base.topology_confirmed) {
        warnings.push(
            "two resolutions disagree about the topology: parts of the surface may be too thin \
             for the grid; try a smaller region or more faces"
                .to_owned(),
        );
    }
    if report.adaptation.is_some_and(|adaptation| !adaptation.met) {
        warnings.push(format!(
            "the tolerance is not met: {:.2e} of the diagonal is reached",
            deviation.max
        ));
    }
    if deviation.max_normal_deg > LEANING_DEG {
        warnings.push(format!(
            "a patch leans by {:.0}° from the surface: there is a singular point or an edge, or \
             more faces are needed (the largest distance is at patch {})",
            deviation.max_normal_deg, deviation.worst_face
        ));
    }
    if !deviation.folded.is_empty() {
        warnings.push(format!(
            "{} patches fold over; the surface has an edge or a tip there, or needs more faces",
            deviation.folded.len()
        ));
    }
    if deviation.failed_samples > 0 {
        warnings.push(format!(
            "{} sample points find no foot on the surface and count as infinitely far from it",
            deviation.failed_samples
        ));
    }
    // not a number is not smooth either
    if joined.g1_angle_deg.is_nan() || joined.g1_angle_deg > SMOOTH_DEG {
        warnings.push(format!(
            "neighbouring patches meet at an angle of up to {:.2e}°: the result is not smooth",
            joined.g1_angle_deg
        ));
    }
    warnings
}
