//! Fits one case and keeps the figures that are compared.

use std::collections::BTreeMap;

use anyhow::Result;
use serde::{Deserialize, Serialize};
use smoothpatch::implicit::ImplicitSurface;
use smoothpatch::{
    FieldSource, G1Surface, Report, Settings, Silent, find_region, fit, fit_base_mesh, report,
    scene,
};

use super::cases::Case;

/// What was measured about one surface. Lengths are relative as in the bounds of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Measures {
    pub(super) faces: usize,
    pub(super) euler: i64,
    pub(super) components: usize,
    pub(super) closed: bool,
    /// Largest distance of boundary points that should be the same.
    pub(super) position_gap: f64,
    pub(super) g1_angle_deg: f64,
    pub(super) row_residual: f64,
    pub(super) max_deviation: f64,
    pub(super) rms_deviation: f64,
    pub(super) max_normal_error_deg: f64,
    /// Samples that have no foot on the surface.
    pub(super) failed_samples: usize,
    pub(super) folds: usize,
    /// Edges with a fallback curve.
    pub(super) fallbacks: usize,
    /// Patches that were taken back to the published objectives because they folded.
    pub(super) retreats: usize,
    pub(super) sqp_iterations: f64,
    pub(super) vertex_position: f64,
    pub(super) vertex_normal: f64,
    pub(super) vertex_second_form: f64,
    /// Seconds of the whole fit.
    pub(super) seconds: f64,
    pub(super) seconds_by_stage: BTreeMap<String, f64>,
}

pub(super) fn measure(case: &Case) -> Result<Measures> {
    let field = scene::field_of(&case.scene.surface)?;
    let settings = settings(case);
    let surface = fit_case(case, &*field)?;
    let target = FieldSource::new(&*field, surface.mesh.diagonal(), settings.projection);
    let (report, _) = report(&surface, &target, &mut Silent);
    Ok(Measures { seconds: surface.times.total(), ..report.into() })
}

fn settings(case: &Case) -> Settings {
    Settings::with_faces(case.scene.faces).with_method(case.method.into())
}

/// The surface of a case.
pub(super) fn fit_case(case: &Case, field: &dyn ImplicitSurface) -> Result<G1Surface> {
    let settings = settings(case);
    Ok(if let Some(mesh) = scene::base_mesh_of(&case.scene, &case.path)? {
        fit_base_mesh(field, mesh, &settings, &mut Silent)?
    } else {
        let region = scene::region_of(&case.scene)?;
        let region = region.map_or_else(|| find_region(field), Ok)?;
        fit(field, &region, &settings, &mut Silent)?
    })
}

impl From<Report> for Measures {
    fn from(report: Report) -> Self {
        let Report { continuity, deviation, interpolation, .. } = report;
        Self {
            faces: continuity.faces,
            euler: continuity.euler_characteristic,
            components: continuity.components,
            closed: continuity.closed,
            position_gap: continuity.position_gap,
            g1_angle_deg: continuity.g1_angle_deg,
            row_residual: report.row_residual,
            max_deviation: deviation.max,
            rms_deviation: deviation.rms,
            max_normal_error_deg: deviation.max_normal_deg,
            failed_samples: deviation.failed_samples,
            folds: deviation.folded.len(),
            fallbacks: report.fallback_edges.len(),
            retreats: report.retreats.len(),
            sqp_iterations: report.mean_sqp_iterations,
            vertex_position: interpolation.position,
            vertex_normal: interpolation.normal,
            vertex_second_form: interpolation.second_form,
            seconds: report.seconds.values().sum(),
            seconds_by_stage: report.seconds,
        }
    }
}
