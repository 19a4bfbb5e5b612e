//! What a user must know about a result that is not what it should be.

use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{FaceId, FaceMap};
use smoothpatch::bezier_core::Barycentric;
use smoothpatch::measure::{Deviation, FaceDeviation};
use smoothpatch::{Distance, G1Surface, Report, Tolerance};

use super::summary::distance_with_unit;
use crate::table::degrees;

/// Far above the rounding of exact constructions.
const SMOOTH_DEG: f64 = 1e-6;

/// Normals of a surface that is resolved are closer than that.
const LEANING_DEG: f64 = 20.0;

/// One sentence for each flaw; none for a good result.
pub(crate) fn warnings(
    report: &Report,
    surface: &G1Surface,
    faces: &FaceMap<FaceDeviation>,
) -> Vec<String> {
    let (joined, deviation) = (&report.continuity, &report.deviation);
    let mut warnings = Vec::new();
    if report.base_mesh.as_ref().is_some_and(|base| !base.topology_confirmed) {
        warnings.push(
            "two resolutions disagree about the topology: parts of the surface may be too thin \
             for the grid; try a smaller region or more faces"
                .to_owned(),
        );
    }
    if let Some(adaptation) = report.adaptation.filter(|adaptation| !adaptation.met) {
        warnings.push(not_met(&adaptation.tolerance, deviation));
    }
    if deviation.max_normal_deg > LEANING_DEG {
        warnings.push(leaning(deviation.max_normal_deg, surface, faces));
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

/// What was reached and what was asked for: often only one of the two is not met.
fn not_met(tolerance: &Tolerance, deviation: &Deviation) -> String {
    let (asked, reached) = match tolerance.distance {
        Distance::Relative(part) => (part, Distance::Relative(deviation.max)),
        Distance::Absolute(length) => {
            (length, Distance::Absolute(deviation.max * deviation.diagonal))
        }
    };
    let (Distance::Relative(distance) | Distance::Absolute(distance)) = reached;
    let limit = tolerance.normal_limit_deg();
    let hidden = if distance <= asked && deviation.max_normal_deg <= limit {
        "; too close to call, or the base mesh does not resolve the surface"
    } else {
        ""
    };
    format!(
        "the tolerance is not met: the distance is {} (asked for: {}), the angle of normals {} \
         (asked for: {}){hidden}",
        distance_with_unit(reached),
        distance_with_unit(tolerance.distance),
        degrees(deviation.max_normal_deg),
        degrees(limit),
    )
}

/// Where a patch leans most.
fn leaning(angle: f64, surface: &G1Surface, faces: &FaceMap<FaceDeviation>) -> String {
    let worst = faces.iter().max_by(|(_, a), (_, b)| a.max_normal.total_cmp(&b.max_normal));
    let place = worst.map_or(String::new(), |(face, _)| {
        let DVec3 { x, y, z } = surface.patches.nets[face].eval(Barycentric::CENTROID);
        format!(" at patch {} around [{x:.4}, {y:.4}, {z:.4}]", FaceId::index(face))
    });
    format!(
        "normals of patches and surface differ by {angle:.0}°{place}: a singular point or a sharp \
         edge? If not, use more faces"
    )
}
