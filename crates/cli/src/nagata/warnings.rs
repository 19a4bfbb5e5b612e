//! What a user must know about a result that is not what it should be.

use smoothpatch::nagata::{Continuity, Join, TangentPlanes};
use smoothpatch::nagata_surface::NagataReport;

use super::task::{NormalsUsed, Task};

/// One sentence for each flaw; none for a good result.
pub(crate) fn warnings(report: &NagataReport, task: &Task) -> Vec<String> {
    let mut warnings = Vec::new();
    let flaws = &report.flawed_edges;
    if let Some(worst) = flaws.iter().max_by(|a, b| a.kink_deg.total_cmp(&b.kink_deg)) {
        let [a, b] = worst.vertices;
        let published =
            task.settings.continuity == Continuity::TangentPlane(TangentPlanes::Published);
        let inflections = flaws.iter().filter(|flaw| flaw.join == Join::Inflection).count();
        let hint = match inflections {
            1.. if published => {
                format!("; {inflections} have an inflection, where `--tangent-planes robust` works")
            }
            _ => String::new(),
        };
        warnings.push(format!(
            "{} edges have no common tangent planes, the worst is {a}-{b} with a kink of {:.2e}°{hint}",
            flaws.len(),
            worst.kink_deg
        ));
    }
    if !report.folded.is_empty() {
        let hint = match task.normals {
            NormalsUsed::Estimate if flaws.is_empty() => "; another --crease-angle may help",
            _ => "",
        };
        warnings.push(format!(
            "{} patches fold over, the first is {}: their normals do not fit the mesh, or the mesh \
             is too coarse there{hint}",
            report.folded.len(),
            report.folded[0]
        ));
    }
    if report.corners_without_normal > 0 && task.normals != NormalsUsed::Estimate {
        warnings.push(format!(
            "{} corners have no normal; edges there are determined by their other end",
            report.corners_without_normal
        ));
    }
    if let Some(deviation) = report.deviation.as_ref().filter(|d| d.failed_samples > 0) {
        warnings.push(format!(
            "{} sample points find no foot on the surface and count as infinitely far from it",
            deviation.failed_samples
        ));
    }
    warnings
}
