//! The table at the end.

use smoothpatch::measure::Certificate;
use smoothpatch::{Adaptation, Distance, Report, Stage, Tolerance};

use super::Measured;
use super::scene_task::{BaseMesh, SceneTask};
use super::task::{Input, Task, method_name};
use crate::output_files::Written;
use crate::table::{Table, degrees, grid, length, of_diagonal, yes_no};
use crate::values::region_text;

pub(crate) fn summary(
    task: &Task,
    measured: &Measured<'_>,
    written: &[Written],
    seconds_writing: f64,
) -> String {
    let report = measured.report;
    let mut table = Table::default();
    match &task.input {
        Input::Scene(scene) => origin(&mut table, scene),
        Input::Mesh(mesh) => table.row("input", mesh.file.display()),
    }
    if let Some(mesh) = measured.mesh {
        mesh.rows_of_input(&mut table);
    }
    quality(&mut table, report);
    if let Some(mesh) = measured.mesh {
        mesh.rows_of_distances(&mut table);
    }
    if let Some(certificate) = measured.certificate {
        proof(&mut table, certificate);
    }
    table.gap();
    for stage in Stage::ALL {
        if let Some(seconds) = report.seconds.get(stage.name()) {
            table.row(stage.name(), format!("{seconds:.3} s"));
        }
    }
    table.row("write", format!("{seconds_writing:.3} s"));
    let total = report.seconds.values().sum::<f64>() + seconds_writing;
    table.row("total", format!("{total:.3} s"));
    table.gap();
    for file in written {
        file.rows(&mut table, report.deviation.diagonal);
    }
    format!("{}, {} method\n{table}", task.name(), method_name(task.method))
}

fn origin(table: &mut Table, task: &SceneTask) {
    match &task.base {
        BaseMesh::Made { region, .. } | BaseMesh::Adapted { region, .. } => {
            table.row("region", region_text(region));
        }
        BaseMesh::Given { file, .. } => table.row("base mesh", file.display()),
    }
    if let (BaseMesh::Adapted { .. }, Some(_)) = (&task.base, &task.chosen.file) {
        let faces = task.chosen.scene.faces;
        table.row("faces of the scene", format!("{faces}, not used: the tolerance decides"));
    }
}

fn proof(table: &mut Table, certificate: &Certificate) {
    let Certificate { bound, loosest_face, open, .. } = certificate;
    let of_all = if open.is_empty() {
        String::new()
    } else {
        format!(", without {} patches that have none", open.len())
    };
    table.row(
        "proven bound",
        format!("{} (loosest at patch {loosest_face}){of_all}", of_diagonal(*bound)),
    );
}

fn accuracy(table: &mut Table, adaptation: &Adaptation) {
    let Tolerance { distance, normal_deg } = adaptation.tolerance;
    let mut asked = distance_with_unit(distance);
    if let Some(angle) = normal_deg {
        asked += &format!(", normals {}", degrees(angle));
    }
    let met = if adaptation.met { "met" } else { "NOT met" };
    let rounds = match adaptation.rounds {
        1 => "1 base mesh".to_owned(),
        count => format!("{count} base meshes"),
    };
    table.row("tolerance", format!("{asked}: {met} after {rounds}"));
}

/// A number and what it is measured in.
pub(super) fn distance_with_unit(distance: Distance) -> String {
    match distance {
        Distance::Relative(part) => of_diagonal(part),
        Distance::Absolute(value) => format!("{} (a length)", length(value)),
    }
}

fn quality(table: &mut Table, report: &Report) {
    let (joined, deviation) = (&report.continuity, &report.deviation);
    if let Some(adaptation) = &report.adaptation {
        accuracy(table, adaptation);
    }
    table.row("faces", joined.faces);
    table.row("Euler characteristic", joined.euler_characteristic);
    table.row("components", joined.components);
    table.row("closed", yes_no(joined.closed));
    table.row("G1 angle", degrees(joined.g1_angle_deg));
    if joined.sharp_edges > 0 {
        let angle = degrees(joined.sharp_angle_deg);
        table.row("C0 edges", format!("{}, up to {angle}", joined.sharp_edges));
    }
    table.row("max deviation", of_diagonal(deviation.max));
    table.row("RMS deviation", of_diagonal(deviation.rms));
    table.row("max normal error", degrees(deviation.max_normal_deg));
    table.row("finest grid", grid(deviation.grid));
    if deviation.failed_samples > 0 {
        table.row("samples without foot", deviation.failed_samples);
    }
    table.row("folded patches", deviation.folded.len());
    table.row("fallback curves", report.fallback_edges.len());
    if !report.retreats.is_empty() {
        table.row("patches taken back", report.retreats.len());
    }
}
