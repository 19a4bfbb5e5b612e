//! The report as JSON.

use std::path::Path;

use serde::Serialize;
use smoothpatch::nagata::Settings;
use smoothpatch::nagata_surface::NagataReport;

use super::task::{NormalsUsed, Task};
use crate::output_files::{Written, write_file};

/// What was asked for, what was measured, and what was written.
#[derive(Serialize)]
pub(crate) struct ReportFile<'a> {
    program: &'static str,
    mesh: &'a Path,
    normals: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    crease_angle_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tips: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reference: Option<&'a str>,
    settings: Settings,
    #[serde(flatten)]
    report: &'a NagataReport,
    files: &'a [Written],
}

impl<'a> ReportFile<'a> {
    pub(crate) fn new(task: &'a Task, report: &'a NagataReport, files: &'a [Written]) -> Self {
        Self {
            program: concat!("smoothpatch ", env!("CARGO_PKG_VERSION")),
            mesh: &task.mesh,
            normals: normals_text(&task.normals),
            crease_angle_deg: task.crease_angle,
            tips: task.tips,
            reference: task.reference.as_ref().map(|(name, _)| name.as_str()),
            settings: task.settings,
            report,
            files,
        }
    }

    pub(crate) fn write(&self, path: &Path) -> anyhow::Result<Written> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        write_file(path, |out| out.write_all(text.as_bytes()))
    }
}

/// The word for normals in tables and reports.
pub(crate) fn normals_text(normals: &NormalsUsed) -> String {
    match normals {
        NormalsUsed::File => "file".to_owned(),
        NormalsUsed::Estimate => "estimate".to_owned(),
        NormalsUsed::Scene(path) => path.display().to_string(),
    }
}
