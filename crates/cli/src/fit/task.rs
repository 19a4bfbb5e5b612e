//! What is to be fitted and how.

use std::path::Path;

use smoothpatch::basemesh::FaceMap;
use smoothpatch::measure::FaceDeviation;
use smoothpatch::mesh_surface::{MeshSource, SharpMesh};
use smoothpatch::{
    FieldSource, FitSource, G1Surface, Method, Progress, Report, Settings, report, report_sharp,
};

use super::FitArguments;
use super::mesh_task::{MeshShape, MeshTask, is_mesh};
use super::scene_task::SceneTask;

/// One surface and everything that decides how it is fitted.
pub(crate) struct Task {
    pub(crate) input: Input,
    pub(crate) method: Method,
    pub(crate) settings: Settings,
}

/// Where the surface comes from.
pub(crate) enum Input {
    /// The zero set of a function.
    Scene(Box<SceneTask>),
    /// A mesh.
    Mesh(Box<MeshTask>),
}

impl Task {
    pub(crate) fn new(arguments: &FitArguments) -> anyhow::Result<Self> {
        let input = match arguments.input.as_deref().filter(|file| is_mesh(file)) {
            Some(file) => Input::Mesh(Box::new(MeshTask::new(arguments, file)?)),
            None => Input::Scene(Box::new(SceneTask::new(arguments)?)),
        };
        let faces = match &input {
            Input::Scene(scene) => scene.base.faces(),
            Input::Mesh(mesh) => mesh.faces(),
        };
        let method = arguments.method.into();
        let settings = Settings::with_faces(faces).with_method(method);
        Ok(Self { input, method, settings })
    }

    /// The whole pipeline.
    pub(crate) fn fit(&self, progress: &mut dyn Progress) -> anyhow::Result<G1Surface> {
        match &self.input {
            Input::Scene(scene) => scene.fit(&self.settings, progress),
            Input::Mesh(mesh) => mesh.fit(&self.settings, progress),
        }
    }

    /// Everything measured about the result, and the figures of each face.
    pub(crate) fn report(
        &self,
        surface: &G1Surface,
        progress: &mut dyn Progress,
    ) -> (Report, FaceMap<FaceDeviation>) {
        match self.source(surface.mesh.diagonal()) {
            Ok(source) => report(surface, &*source, progress),
            Err(sharp) => report_sharp(surface, sharp, &self.settings, progress),
        }
    }

    /// The smooth surface that the patches are compared with, of the size `diagonal`, or the mesh whose
    /// pieces have one each.
    pub(crate) fn source(&self, diagonal: f64) -> Result<Box<dyn FitSource + '_>, &SharpMesh> {
        let projection = self.settings.projection;
        match &self.input {
            Input::Scene(scene) => {
                Ok(Box::new(FieldSource::new(&*scene.field, diagonal, projection)))
            }
            Input::Mesh(mesh) => match &mesh.shape {
                MeshShape::Smooth(field) => Ok(Box::new(MeshSource::new(field, projection))),
                MeshShape::Sharp(sharp) => Err(sharp),
            },
        }
    }

    /// A name for the surface.
    pub(crate) fn name(&self) -> String {
        match &self.input {
            Input::Scene(scene) => scene.chosen.scene.name.clone(),
            Input::Mesh(mesh) => mesh.name(),
        }
    }

    /// Files that must not be overwritten with results.
    pub(crate) fn files_read(&self) -> Vec<&Path> {
        match &self.input {
            Input::Scene(scene) => scene.files_read(),
            Input::Mesh(mesh) => vec![&mesh.file],
        }
    }
}

/// The word for a method in options, tables and reports.
pub(crate) fn method_name(method: Method) -> &'static str {
    match method {
        Method::Published => "published",
        _ => "refined",
    }
}
