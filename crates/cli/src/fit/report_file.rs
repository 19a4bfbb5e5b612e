//! The report as JSON.

use std::path::{Path, PathBuf};

use serde::Serialize;
use smoothpatch::Report;
use smoothpatch::implicit::Aabb;
use smoothpatch::io::SceneSurface;
use smoothpatch::measure::Certificate;

use super::Measured;
use super::mesh_task::MeshReport;
use super::scene_task::{BaseMesh, SceneTask};
use super::task::{Input, Task, method_name};
use crate::output_files::{Written, write_file};

/// What was asked for, what was measured, and what was written.
#[derive(Serialize)]
pub(crate) struct ReportFile<'a> {
    program: &'static str,
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface: Option<&'a SceneSurface>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mesh: Option<&'a MeshReport>,
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
    pub(crate) fn new(task: &'a Task, measured: &Measured<'a>, files: &'a [Written]) -> Self {
        let (surface, region, faces_asked, base_mesh_file) = match &task.input {
            Input::Mesh(mesh) => (None, None, mesh.faces_asked(), None),
            Input::Scene(scene) => of_scene(scene),
        };
        Self {
            program: concat!("smoothpatch ", env!("CARGO_PKG_VERSION")),
            name: task.name(),
            surface,
            mesh: measured.mesh,
            method: method_name(task.method),
            region,
            faces_asked,
            base_mesh_file,
            report: measured.report,
            certificate: measured.certificate,
            files,
        }
    }

    pub(crate) fn write(&self, path: &Path) -> anyhow::Result<Written> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        write_file(path, |out| out.write_all(text.as_bytes()))
    }
}

/// The surface, the region that was searched, the number of faces asked for, the file of the base mesh.
type OfScene<'a> =
    (Option<&'a SceneSurface>, Option<[[f64; 3]; 2]>, Option<usize>, Option<PathBuf>);

fn of_scene(scene: &SceneTask) -> OfScene<'_> {
    let surface = Some(&scene.chosen.scene.surface);
    let corners = |region: &Aabb| Some([region.min.to_array(), region.max.to_array()]);
    match &scene.base {
        BaseMesh::Made { region, faces } => (surface, corners(region), Some(*faces), None),
        BaseMesh::Adapted { region, .. } => (surface, corners(region), None, None),
        BaseMesh::Given { file, .. } => (surface, None, None, Some(file.clone())),
    }
}
