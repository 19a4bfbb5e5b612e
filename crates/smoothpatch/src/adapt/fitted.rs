//! A fit with what was measured.

use std::sync::Arc;

use basemesh::{
    FaceMap, RemeshSettings, SimplifyError, SimplifySettings, TriMesh, VertexMap, remesh, simplify,
};

use crate::error::FitError;
use crate::measure::{FaceDeviation, settle};
use crate::memory::{Memory, fit_again};
use crate::progress::{Clock, Stage};
use crate::settings::Settings;
use crate::source::FitSource;
use crate::surface::G1Surface;

/// A surface and the deviation of each of its patches.
pub(super) struct Fitted {
    pub(super) surface: Arc<G1Surface>,
    pub(super) deviations: FaceMap<FaceDeviation>,
}

/// What every fit of one surface needs.
pub(super) struct Job<'a, 'p> {
    pub(super) source: &'a dyn FitSource,
    pub(super) settings: &'a Settings,
    pub(super) memory: Memory,
    pub(super) clock: &'a mut Clock<'p>,
}

impl Job<'_, '_> {
    pub(super) fn fit(&mut self, mesh: TriMesh) -> Result<Fitted, FitError> {
        let (surface, deviations) =
            fit_again(mesh, self.source, self.settings, &mut self.memory, self.clock)?;
        Ok(Fitted { surface, deviations })
    }

    /// The fit of the base mesh of another, remeshed with the wanted edge lengths.
    pub(super) fn fit_remeshed(
        &mut self,
        fitted: &Fitted,
        wishes: &VertexMap<Option<f64>>,
        to: &RemeshSettings,
    ) -> Result<Fitted, FitError> {
        let remesh = || remesh(&fitted.surface.mesh, self.source, wishes, to);
        let mesh = self.clock.run(Stage::Simplify, fitted.faces(), remesh)?.mesh;
        self.fit(mesh)
    }

    /// The fit of the base mesh of another, simplified to `faces` faces; `None` if no mesh of its
    /// topology has so few.
    pub(super) fn fit_simplified(
        &mut self,
        fitted: &Fitted,
        faces: usize,
    ) -> Result<Option<Fitted>, FitError> {
        let settings = SimplifySettings { faces, ..self.settings.base_mesh.simplify.clone() };
        let mesh = fitted.surface.mesh.clone();
        let simplify = || simplify(mesh, self.source, &settings);
        match self.clock.run(Stage::Simplify, fitted.faces(), simplify) {
            Err(SimplifyError::TooFewFaces { .. }) => Ok(None),
            simplified => Ok(Some(self.fit(simplified?.mesh)?)),
        }
    }

    /// Measures the worst patches more densely, until the largest values settle.
    pub(super) fn settle(&mut self, fitted: &mut Fitted) {
        let nets = &fitted.surface.patches.nets;
        self.clock.run(Stage::Measure, 0, || settle(&mut fitted.deviations, nets, self.source));
    }
}

impl Fitted {
    pub(super) fn faces(&self) -> usize {
        self.surface.mesh.topology().face_count()
    }

    pub(super) fn folds(&self) -> usize {
        self.deviations.as_slice().iter().filter(|face| face.folded).count()
    }
}
