//! The report as JSON.

use std::path::Path;

use serde::Serialize;
use smoothpatch::nagata::Settings;
use smoothpatch::nagata_surface::NagataReport;

use super::outputs::WrittenSurface;
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
    reference: Option<&'a str>,
    settings: Settings,
    #[serde(flatten)]
    report: &'a NagataReport,
    files: Vec<FileEntry<'a>>,
}

#[derive(Serialize)]
struct FileEntry<'a> {
    #[serde(flatten)]
    file: &'a Written,
    /// Largest distance of the cells from the patches, a length; missing if they are exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    sampling_deviation: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cells: Option<usize>,
}

impl<'a> ReportFile<'a> {
    pub(crate) fn new(
        task: &'a Task,
        report: &'a NagataReport,
        files: &'a [WrittenSurface],
    ) -> Self {
        let entry = |written: &'a WrittenSurface| FileEntry {
            file: &written.file,
            sampling_deviation: written.approximation.map(|approximation| approximation.gap),
            cells: written.approximation.map(|approximation| approximation.count),
        };
        Self {
            program: concat!("smoothpatch ", env!("CARGO_PKG_VERSION")),
            mesh: &task.mesh,
            normals: normals_text(&task.normals),
            crease_angle_deg: task.crease_angle,
            reference: task.reference.as_ref().map(|(name, _)| name.as_str()),
            settings: task.settings,
            report,
            files: files.iter().map(entry).collect(),
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
