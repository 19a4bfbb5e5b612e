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
/// Every trial remeshes the best fit to fewer faces with the deviation spread evenly, fits and
/// measures.
pub(super) fn spare(
    mut fitted: Fitted,
    tolerance: &Tolerance,
    job: &mut Job<'_, '_>,
) -> Result<Fitted, FitError> {
    for kept in KEPT {
        while let Some(better) = with_fewer(&fitted, kept, tolerance, job)? {
            fitted = better;
        }
    }
    Ok(fitted)
}

/// A fit within the tolerance on a mesh with `kept` percent of the faces, if there is one.
fn with_fewer(
    fitted: &Fitted,
    kept: usize,
    tolerance: &Tolerance,
    job: &mut Job<'_, '_>,
) -> Result<Option<Fitted>, FitError> {
    // an even number
    let fewer = fitted.faces() * kept / 200 * 2;
    let errors = errors(&fitted.surface, &fitted.deviations, job.settings.projection);
    let wishes = even_wishes(&fitted.surface.mesh, &errors, aim_for(&errors, fewer as f64));
    let to = RemeshSettings { faces: Some(fewer), ..few_faces() };
    let mut trial = job.fit_remeshed(fitted, &wishes, &to)?;
    job.settle(&mut trial);
    let within = urgent_wishes(&trial.surface, &excess(&trial, tolerance), 1).is_none();
    Ok((within && trial.faces() < fitted.faces()).then_some(trial))
}
