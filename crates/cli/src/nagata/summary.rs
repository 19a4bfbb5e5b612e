//! The table at the end.

use smoothpatch::nagata::{Continuity, TangentPlanes};
use smoothpatch::nagata_surface::NagataReport;

use super::report_file::normals_text;
use super::task::Task;
use crate::output_files::Written;
use crate::table::{Table, degrees, grid, length, of_diagonal, yes_no};

/// `seconds`: building, measuring, writing.
pub(crate) fn summary(
    task: &Task,
    report: &NagataReport,
    written: &[Written],
    seconds: [f64; 3],
) -> String {
    let mut table = Table::default();
    table.row(
        "normals",
        match task.crease_angle {
            Some(angle) => format!("estimated, creases from {angle}°"),
            None => normals_text(&task.normals),
        },
    );
    if let Some(count) = task.tips {
        table.row("tips", count);
    }
    mesh(&mut table, report);
    joints(&mut table, report);
    deviation(&mut table, task, report);
    table.gap();
    for (stage, seconds) in ["build", "measure", "write"].into_iter().zip(seconds) {
        table.row(stage, format!("{seconds:.3} s"));
    }
    table.gap();
    for file in written {
        file.rows(&mut table, report.diagonal);
    }
    format!("{}, {}\n{table}", task.mesh.display(), kind(task))
}

fn kind(task: &Task) -> &'static str {
    match task.settings.continuity {
        Continuity::Position => "C0 Nagata patches",
        Continuity::TangentPlane(TangentPlanes::Robust) => "G1 Nagata patches",
        Continuity::TangentPlane(TangentPlanes::Published) => "G1 Nagata patches as published",
    }
}

fn mesh(table: &mut Table, report: &NagataReport) {
    if report.quadrilaterals == 0 {
        table.row("triangles", report.triangles);
    } else if report.triangles == 0 {
        table.row("quadrilaterals", report.quadrilaterals);
    } else {
        let (triangles, quadrilaterals) = (report.triangles, report.quadrilaterals);
        table.row("faces", format!("{triangles} triangles, {quadrilaterals} quadrilaterals"));
    }
    table.row("Euler characteristic", report.euler_characteristic);
    table.row("closed", yes_no(report.closed));
    table.row("area", area(report.area.value));
    if report.corners_without_normal > 0 {
        table.row("corners without normal", report.corners_without_normal);
    }
}

fn joints(table: &mut Table, report: &NagataReport) {
    let construction = &report.construction;
    table.row("edges", construction.edges);
    table.row("boundary edges", construction.boundary);
    table.row("creases", construction.creases);
    table.row("lowered edges", construction.lowered);
    if let Some(residual) = report.g1_residual {
        table.row("edges with common planes", construction.tangent_plane);
        table.row("G1 residual", format!("{} rad", length(residual)));
        table.row("cubic edges", construction.cubic);
        table.row("edges that fail G1", report.flawed_edges.len());
    }
    table.row("misfit of normals", format!("{} of the edge", length(construction.max_misfit)));
    table.row("max kink", degrees(report.max_kink_deg));
    table.row("folded patches", report.folded.len());
}

fn deviation(table: &mut Table, task: &Task, report: &NagataReport) {
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

/// Seven digits.
fn area(value: f64) -> String {
    if (1e-2..1e6).contains(&value) { format!("{value:.6}") } else { format!("{value:.6e}") }
}
