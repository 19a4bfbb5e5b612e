//! Fits with a given accuracy, against a sweep over numbers of faces.

use std::time::Instant;

use anyhow::{Context, Result};
use serde::Serialize;
use smoothpatch::implicit::NamedShape;
use smoothpatch::measure::deviation;
use smoothpatch::{
    Distance, FieldSource, FitError, G1Surface, Settings, Silent, Tolerance, fit, fit_to_tolerance,
};

/// Over the diagonal, loose ones first.
const TOLERANCES: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-7];
/// The sweep starts at this part of the faces of the loosest fit, and grows by this part, both in
/// percent.
const SWEEP_START: usize = 40;
const SWEEP_STEP: usize = 10;

pub(super) const SHAPES: [&str; 7] =
    ["sphere", "torus", "dodecahedron", "double-torus", "mcmullen", "chair", "deccube"];

/// One shape.
#[derive(Debug, Serialize)]
pub(super) struct Scene {
    pub(super) shape: &'static str,
    pub(super) fits: Vec<Fit>,
    /// Least-squares slope of the number of faces over the tolerance, both in logarithms.
    pub(super) exponent: f64,
}

/// One accuracy.
#[derive(Debug, Serialize)]
pub(super) struct Fit {
    pub(super) tolerance: f64,
    pub(super) faces: usize,
    /// What the fit itself says.
    pub(super) met: bool,
    /// Measured anew from the patches alone, over the diagonal.
    pub(super) deviation: f64,
    pub(super) folds: usize,
    /// On one thread.
    pub(super) seconds: f64,
    /// The smallest number of faces of the sweep that is within the tolerance; missing if none is up
    /// to the faces of this fit.
    pub(super) sweep_faces: Option<usize>,
}

impl Fit {
    pub(super) fn holds(&self) -> bool {
        self.met && self.folds == 0 && self.deviation <= self.tolerance
    }

    /// Faces over those of the sweep; at most one if the sweep needs more.
    pub(super) fn excess(&self) -> f64 {
        self.sweep_faces.map_or(1.0, |faces| self.faces as f64 / faces as f64)
    }
}

pub(super) fn measure(shape: &'static str) -> Result<Scene> {
    let named = NamedShape::find(shape).with_context(|| format!("no shape named {shape}"))?;
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let fits = TOLERANCES.map(|tolerance| one_thread.install(|| adaptive(named, tolerance)));
    let mut fits = fits.into_iter().collect::<Result<Vec<_>>>()?;
    sweep(named, &mut fits)?;
    let points: Vec<_> = fits.iter().map(|f| (f.tolerance.ln(), (f.faces as f64).ln())).collect();
    Ok(Scene { shape, exponent: slope(&points), fits })
}

fn adaptive(shape: &NamedShape, tolerance: f64) -> Result<Fit> {
    let field = shape.field();
    let asked = Tolerance { distance: Distance::Relative(tolerance), normal_deg: None };
    // the number of faces is not used
    let settings = Settings::with_faces(1000);
    let start = Instant::now();
    let surface = fit_to_tolerance(&*field, &shape.region, &asked, &settings, &mut Silent)?;
    let seconds = start.elapsed().as_secs_f64();
    let (deviation, folds) = measured(shape, &surface);
    Ok(Fit {
        tolerance,
        faces: surface.mesh.topology().face_count(),
        met: surface.origin.adaptation.is_some_and(|adaptation| adaptation.met),
        deviation,
        folds,
        seconds,
        sweep_faces: None,
    })
}

/// Largest distance over the diagonal, and folded patches.
fn measured(shape: &NamedShape, surface: &G1Surface) -> (f64, usize) {
    let field = shape.field();
    let diagonal = surface.mesh.diagonal();
    let projection = Settings::with_faces(1000).projection;
    let target = FieldSource::new(&*field, diagonal, projection);
    let (found, _) = deviation(&surface.patches.nets, &target, diagonal);
    (found.max, found.folded.len())
}

/// Fits with more and more faces until every tolerance is met or has been met with fewer.
fn sweep(shape: &NamedShape, fits: &mut [Fit]) -> Result<()> {
    let loosest = fits.first().map_or(0, |fit| fit.faces);
    let mut count = (loosest * SWEEP_START / 200 * 2).max(4);
    while let Some(open) = fits.iter().position(|fit| fit.sweep_faces.is_none()) {
        let open = &mut fits[open..];
        if open.iter().all(|fit| count > fit.faces) {
            break;
        }
        let settings = Settings::with_faces(count);
        count += (count * SWEEP_STEP / 200 * 2).max(2);
        let surface = match fit(&*shape.field(), &shape.region, &settings, &mut Silent) {
            // the topology needs more
            Err(FitError::Simplify(_)) => continue,
            other => other?,
        };
        let (deviation, folds) = measured(shape, &surface);
        let faces = surface.mesh.topology().face_count();
        for fit in open.iter_mut().filter(|fit| folds == 0 && deviation <= fit.tolerance) {
            fit.sweep_faces.get_or_insert(faces);
        }
    }
    Ok(())
}

/// Of the line of least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::slope;

    #[test]
    fn the_slope_of_a_line_is_found() {
        let line: Vec<_> = [0.0, 1.0, 5.0].map(|x| (x, 2.0 - x / 3.0)).into();
        assert!((slope(&line) + 1.0 / 3.0).abs() < 4.0 * f64::EPSILON, "{}", slope(&line));
    }
}
