//! The deviation is spread evenly over a given number of faces.

use std::sync::Arc;

use basemesh::{FaceMap, RemeshSettings, TriMesh, remesh};
use implicit::ProjectionSettings;

use super::wishes::{aim_for, even_wishes};
use crate::error::FitError;
use crate::measure::FaceDeviation;
use crate::memory::{Memory, fit_again};
use crate::progress::{Clock, Stage};
use crate::settings::Settings;
use crate::source::FitSource;
use crate::surface::G1Surface;

/// The fit of a base mesh with the same number of faces on which the deviation is spread more
/// evenly.
///
/// Every round fits the mesh and remeshes it with edge lengths that make the deviation, judged by
/// this fit, the same everywhere. The best of all fits is returned: that with the smallest product
/// of largest distance and largest normal angle.
pub(crate) fn equalise(
    mesh: TriMesh,
    source: &dyn FitSource,
    settings: &Settings,
    clock: &mut Clock<'_>,
) -> Result<G1Surface, FitError> {
    let faces = mesh.topology().face_count();
    let mut memory = Memory::default();
    let (mut surface, mut deviations) = fit_again(mesh, source, settings, &mut memory, clock)?;
    let mut best: Option<(f64, Arc<G1Surface>)> = None;
    for _ in 0..settings.base_mesh.equalising_rounds {
        let errors = errors(&surface, &deviations, settings.projection);
        let wishes = even_wishes(&surface.mesh, &errors, aim_for(&errors, faces as f64));
        let to = RemeshSettings { faces: Some(faces), ..RemeshSettings::default() };
        let remeshed =
            clock.run(Stage::Simplify, faces, || remesh(&surface.mesh, source, &wishes, &to))?.mesh;
        // the guards may refuse to reach the number of faces
        if remeshed.topology().face_count() != faces {
            break;
        }
        keep_better(&mut best, badness(&surface, &deviations), surface);
        (surface, deviations) = fit_again(remeshed, source, settings, &mut memory, clock)?;
    }
    keep_better(&mut best, badness(&surface, &deviations), surface);
    let (_, surface) = best.expect("invariant: at least one fit was kept");
    // nobody else holds the surface then
    drop(memory);
    Ok(Arc::unwrap_or_clone(surface))
}

fn keep_better(best: &mut Option<(f64, Arc<G1Surface>)>, badness: f64, surface: Arc<G1Surface>) {
    if best.as_ref().is_none_or(|(least, _)| badness < *least) {
        *best = Some((badness, surface));
    }
}

/// Largest distance times largest normal angle; worse than everything if patches fold.
fn badness(surface: &G1Surface, deviations: &FaceMap<FaceDeviation>) -> f64 {
    let largest = |value: &dyn Fn(&FaceDeviation) -> f64| {
        deviations.as_slice().iter().map(value).fold(0.0, f64::max)
    };
    let folds = deviations.as_slice().iter().filter(|face| face.folded).count();
    let size = surface.mesh.diagonal();
    largest(&|face| face.max) * largest(&|face| face.max_normal) + folds as f64 * size
}

/// Distances up to so many tolerances of the projection are rounding, not shape.
const NOISE: f64 = 4.0;

/// Largest distance of every patch in diagonals; one for a folded patch. Where nothing is left to see
/// all are equal, so that no mesh is changed for the sake of rounding.
pub(super) fn errors(
    surface: &G1Surface,
    deviations: &FaceMap<FaceDeviation>,
    projection: ProjectionSettings,
) -> FaceMap<f64> {
    let size = surface.mesh.diagonal();
    let least = (NOISE * projection.tolerance).clamp(f64::EPSILON, 1.0);
    deviations.map(|_, face| if face.folded { 1.0 } else { (face.max / size).clamp(least, 1.0) })
}
