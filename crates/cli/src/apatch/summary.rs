//! The table at the end.

use smoothpatch::apatch::rational::{KindCounts, NormalsUsed as Built};
use smoothpatch::apatch_surface::RationalReport;

use super::outputs::Outputs;
use super::task::Task;
use crate::nagata::report_file::normals_text;
use crate::nagata::task::NormalsUsed;
use crate::table::{Table, degrees, grid, length, of_diagonal, yes_no};

/// `seconds`: building, measuring, writing.
pub(crate) fn summary(
    task: &Task,
    report: &RationalReport,
    outputs: &Outputs,
    seconds: [f64; 3],
) -> String {
    let mut table = Table::default();
    let built = &report.construction;
    table.row("normals", normals(task, built.normals));
    table.row("faces", report.faces);
    table.row("Euler characteristic", report.euler_characteristic);
    table.row("closed", yes_no(report.closed));
    table.row("faces by kind", kinds(&built.faces));
    table.row("edges by kind", kinds(&built.edges));
    let (faces, edges) = (built.face_tetrahedra, built.edge_tetrahedra);
    table.row("tetrahedra", format!("{faces} over faces, {edges} over edges"));
    table.row("repairs", repairs(report));
    table.row("invalid edge tetrahedra", built.invalid_edges.len());
    table.row("faces seen from behind", built.behind.len());
    let sheet = report.sheet;
    table.row("bad transversals", format!("{} of {}", sheet.bad, sheet.transversals));
    let joints = &report.joints;
    let [value, gradient] = [joints.value_jump, joints.gradient_jump].map(length);
    table.row("C1 residual", format!("{value} in value, {gradient} in gradient"));
    table.row("angle at joints", degrees(joints.normal_angle.to_degrees()));
    deviation(&mut table, task, report);
    table.gap();
    for (stage, seconds) in ["build", "measure", "write"].into_iter().zip(seconds) {
        table.row(stage, format!("{seconds:.3} s"));
    }
    table.gap();
    for file in &outputs.files {
        file.rows(&mut table, report.diagonal);
    }
    format!("{}, rational A-patches\n{table}", task.mesh.display())
}

fn normals(task: &Task, built: Built) -> String {
    match (&task.normals, built) {
        (NormalsUsed::Estimate, Built::Cone) => "estimated, inside the cones of visibility".into(),
        (NormalsUsed::Estimate, _) => "estimated, of Loop's limit surface".into(),
        (given, _) => normals_text(given),
    }
}

fn kinds(counts: &KindCounts) -> String {
    let KindCounts { positive, negative, nonconvex, zero } = counts;
    format!("{} convex, {nonconvex} on both sides, {zero} flat", positive + negative)
}

/// What was changed to make the tetrahedra fit, or the surface one sheet.
fn repairs(report: &RationalReport) -> String {
    let built = &report.construction;
    let done = [
        (built.loop_steps, "step of Loop's scheme"),
        (built.moved_apices, "faces with moved apices"),
        (built.promoted.len(), "faces made two-sided"),
        (built.raised_edges, "edges raised to one sheet"),
    ];
    let done: Vec<_> =
        done.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")).collect();
    if done.is_empty() { "none".to_owned() } else { done.join(", ") }
}

fn deviation(table: &mut Table, task: &Task, report: &RationalReport) {
    let (Some(deviation), Some((name, _))) = (&report.deviation, &task.reference) else { return };
    table.row("compared with", name);
    table.row("max deviation", of_diagonal(deviation.max));
    table.row("RMS deviation", of_diagonal(deviation.rms));
    table.row("max normal error", degrees(deviation.max_normal_deg));
    table.row("finest grid", grid(deviation.grid));
    if deviation.failed_samples > 0 {
        table.row("samples without foot", deviation.failed_samples);
    }
}
