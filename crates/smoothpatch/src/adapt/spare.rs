//! Faces that are not needed are taken away again.

use basemesh::RemeshSettings;

use super::equalise::errors;
use super::fitted::{Fitted, Job};
use super::wishes::{aim_for, even_wishes, urgent_wishes};
use super::{Tolerance, excess, few_faces};
use crate::error::FitError;

/// Parts of the faces that a trial keeps, in percent: each as long as it succeeds. Keeping more is
/// not worth a fit.
const KEPT: [usize; 4] = [60, 77, 88, 94];

/// The fit with the fewest faces that are found to be enough, from one that is within the tolerance.
///
/// Every trial makes a mesh with fewer faces, fits and measures: first by remeshing the best fit with
/// the deviation spread evenly, and if that fails by simplifying its mesh, which finds other meshes.
pub(super) fn spare(
    mut fitted: Fitted,
    tolerance: &Tolerance,
    job: &mut Job<'_, '_>,
) -> Result<Fitted, FitError> {
    for kept in KEPT {
        loop {
            // an even number
            let fewer = fitted.faces() * kept / 200 * 2;
            let better = match remeshed(&fitted, fewer, tolerance, job)? {
                None => simplified(&fitted, fewer, tolerance, job)?,
                better => better,
            };
            let Some(better) = better else { break };
            fitted = better;
        }
    }
    Ok(fitted)
}

/// A fit within the tolerance on the mesh of another remeshed to `fewer` faces, if there is one.
fn remeshed(
    fitted: &Fitted,
    fewer: usize,
    tolerance: &Tolerance,
    job: &mut Job<'_, '_>,
) -> Result<Option<Fitted>, FitError> {
    let errors = errors(&fitted.surface, &fitted.deviations, job.settings.projection);
    let wishes = even_wishes(&fitted.surface.mesh, &errors, aim_for(&errors, fewer as f64));
    let to = RemeshSettings { faces: Some(fewer), ..few_faces() };
    let trial = job.fit_remeshed(fitted, &wishes, &to)?;
    Ok(accepted(trial, fitted, tolerance, job))
}

/// The same on the simplified mesh.
fn simplified(
    fitted: &Fitted,
    fewer: usize,
    tolerance: &Tolerance,
    job: &mut Job<'_, '_>,
) -> Result<Option<Fitted>, FitError> {
    let Some(trial) = job.fit_simplified(fitted, fewer)? else { return Ok(None) };
    Ok(accepted(trial, fitted, tolerance, job))
}

/// A fit that is within the tolerance with fewer faces than another.
fn accepted(
    mut trial: Fitted,
    than: &Fitted,
    tolerance: &Tolerance,
    job: &mut Job<'_, '_>,
) -> Option<Fitted> {
    if trial.faces() >= than.faces() {
        return None;
    }
    job.settle(&mut trial);
    let within = urgent_wishes(&trial.surface, &excess(&trial, tolerance), 1).is_none();
    within.then_some(trial)
}
