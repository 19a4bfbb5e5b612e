//! The report as JSON.

use std::path::{Path, PathBuf};

use serde::Serialize;
use smoothpatch::Report;
use smoothpatch::io::SceneSurface;
use smoothpatch::measure::Certificate;

use super::task::{BaseMesh, Task, method_name};
use crate::output_files::{Written, write_file};

/// What was asked for, what was measured, and what was written.
#[derive(Serialize)]
pub(crate) struct ReportFile<'a> {
    program: &'static str,
    name: &'a str,
    surface: &'a SceneSurface,
    method: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<[[f64; 3]; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    faces_asked: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_mesh_file: Option<PathBuf>,
    #[serde(flatten)]
    report: &'a Report,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<&'a Certificate>,
    files: &'a [Written],
}

impl<'a> ReportFile<'a> {
    pub(crate) fn new(
        task: &'a Task,
        report: &'a Report,
        certificate: Option<&'a Certificate>,
        files: &'a [Written],
    ) -> Self {
        let scene = &task.chosen.scene;
        let (region, faces_asked, base_mesh_file) = match &task.base {
            BaseMesh::Made { region, faces } => {
                (Some([region.min.to_array(), region.max.to_array()]), Some(*faces), None)
            }
            BaseMesh::Adapted { region, .. } => {
                (Some([region.min.to_array(), region.max.to_array()]), None, None)
            }
            BaseMesh::Given { file, .. } => (None, None, Some(file.clone())),
        };
        Self {
            program: concat!("smoothpatch ", env!("CARGO_PKG_VERSION")),
            name: &scene.name,
            surface: &scene.surface,
            method: method_name(task.method),
            region,
            faces_asked,
            base_mesh_file,
            report,
            certificate,
            files,
        }
    }

    pub(crate) fn write(&self, path: &Path) -> anyhow::Result<Written> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        write_file(path, |out| out.write_all(text.as_bytes()))
    }
}
