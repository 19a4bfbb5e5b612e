//! What is printed about a smooth solid.

use std::path::Path;

use smoothpatch::apatch::polyhedral::{Finding, Joints, PolyhedralSurface, Sampled};

use crate::output_files::Written;
use crate::table::{Table, bytes, degrees, length};

/// `seconds`: building, measuring, writing.
pub(super) fn summary(
    name: &Path,
    surface: &PolyhedralSurface,
    joints: Joints,
    sampled: &Sampled,
    written: &[Written],
    seconds: [f64; 3],
) -> String {
    let report = surface.report();
    let mut table = Table::default();
    let [convex, concave, straight] = report.edges;
    table.row("triangles of the hull", surface.hull().triangles.len());
    table.row("edges by kind", format!("{convex} convex, {concave} concave, {straight} straight"));
    let (faces, edges) = (report.face_tetrahedra, report.edge_tetrahedra);
    table.row("tetrahedra", format!("{faces} over triangles, {edges} over edges"));
    table.row("hulls tried", report.hulls);
    table.row("findings", report.findings.len());
    let [bad, rays] = report.bad_rays;
    table.row("bad rays", format!("{bad} of {rays}"));
    let [value, gradient] = [joints.value_jump, joints.gradient_jump].map(length);
    table.row("C1 residual", format!("{value} in value, {gradient} in gradient"));
    let smooth = surface.degree() == 5;
    if smooth {
        table.row("C2 residual", length(joints.hessian_jump));
    }
    table.row("angle at joints", degrees(joints.normal_angle.to_degrees()));
    table.row("volume", format!("{:.6e}", sampled.mesh.signed_volume()));
    table.gap();
    for (stage, seconds) in ["build", "measure", "write"].into_iter().zip(seconds) {
        table.row(stage, format!("{seconds:.3} s"));
    }
    table.gap();
    for file in written {
        table.row("wrote", format!("{} ({})", file.file.display(), bytes(file.bytes)));
    }
    table.row("", format!("{} flat triangles", sampled.mesh.triangles.len()));
    let kind = if smooth { "C2 quintic A-patches" } else { "C1 cubic A-patches" };
    format!("{}, {kind}\n{table}", name.display())
}

/// One sentence for each kind of fault; none for a good result.
pub(super) fn warnings(surface: &PolyhedralSurface, sampled: &Sampled) -> Vec<String> {
    let report = surface.report();
    let mut warnings = Vec::new();
    if let Some(first) = report.findings.first() {
        warnings.push(format!(
            "the tetrahedra do not fit together in {} places; first: {}",
            report.findings.len(),
            describe(first)
        ));
    }
    if report.bad_rays[0] > 0 {
        let [bad, all] = report.bad_rays;
        warnings.push(format!("{bad} of {all} rays do not meet the surface exactly once"));
    }
    if report.fairness.is_some_and(|f| !f.accurate) {
        warnings
            .push("some weights have the wrong sign; the surface is smooth, see bad rays".into());
    }
    if let Some(fairness) = report.fairness.filter(|f| !f.is_smooth()) {
        let residual = fairness.residual;
        warnings.push(format!("not smooth: the smoothness conditions hold only to {residual:.1e}"));
    }
    let flipped = sampled.mesh.flipped_facets();
    if flipped > 0 {
        warnings.push(format!("{flipped} triangles look the wrong way; try another --density"));
    }
    warnings
}

fn describe(finding: &Finding) -> String {
    match finding {
        Finding::Overlap { at: [a, b], .. } => format!("overlap of those at {a:?} and {b:?}"),
        Finding::Wedge { at: [a, b], .. } => format!("order of those at {a:?} and {b:?}"),
        other => format!("{other:?}"),
    }
}
