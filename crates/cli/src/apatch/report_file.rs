//! The report as JSON.

use std::path::Path;

use serde::Serialize;
use smoothpatch::apatch::rational::Settings;
use smoothpatch::apatch_surface::RationalReport;

use super::outputs::Outputs;
use super::task::Task;
use crate::nagata::report_file::normals_text;
use crate::output_files::{Written, write_file};

/// What was asked for, what was done and measured, and what was written.
#[derive(Serialize)]
pub(crate) struct ReportFile<'a> {
    program: &'static str,
    mesh: &'a Path,
    scheme: &'static str,
    normals: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    reference: Option<&'a str>,
    settings: &'a Settings,
    #[serde(flatten)]
    report: &'a RationalReport,
    points_not_on_surface: usize,
    files: &'a [Written],
}

impl<'a> ReportFile<'a> {
    pub(crate) fn new(task: &'a Task, report: &'a RationalReport, outputs: &'a Outputs) -> Self {
        Self {
            program: concat!("smoothpatch ", env!("CARGO_PKG_VERSION")),
            mesh: &task.mesh,
            scheme: "rational",
            normals: normals_text(&task.normals),
            reference: task.reference.as_ref().map(|(name, _)| name.as_str()),
            settings: &task.settings,
            report,
            points_not_on_surface: outputs.missing,
            files: &outputs.files,
        }
    }

    pub(crate) fn write(&self, path: &Path) -> anyhow::Result<Written> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        write_file(path, |out| out.write_all(text.as_bytes()))
    }
}
