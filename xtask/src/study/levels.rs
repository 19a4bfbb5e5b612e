//! All surfaces over one base mesh, and how far each is from its target.

use std::collections::BTreeMap;

use anyhow::Result;
use serde::Serialize;
use smoothpatch::basemesh::{FaceMap, SurfaceTarget, TriMesh};
use smoothpatch::bezier_core::SepticTriangle;
use smoothpatch::g1_triangular::{self, CurveNetwork, Plan};
use smoothpatch::hermite_sqp::CurveRefinement;
use smoothpatch::measure::{continuity, deviation};
use smoothpatch::{FieldSource, G1Surface, Method, Settings, Silent, fit_base_mesh};

use super::families::Family;
use super::interpolants::interpolate;

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Variant {
    /// The curves that the published method ends with.
    Curves,
    /// The patches without smoothness that the published method starts from.
    PublishedG0,
    /// The published method.
    Published,
    /// The refined objectives on the curves of the published method.
    Unrefined,
    /// The curves of the refined method.
    RefinedCurves,
    /// The refined method.
    Refined,
    /// Continuous interpolation of degree 4.
    Interpolant4,
    /// Continuous interpolation of degree 7.
    Interpolant7,
}

/// Errors of one surface; distances over the diagonal. Curves have only the largest distance.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Errors {
    pub(crate) max: f64,
    pub(crate) rms: Option<f64>,
    pub(crate) normal_deg: Option<f64>,
    pub(crate) folds: usize,
    /// Patches that were taken back to the published objectives.
    pub(crate) retreats: usize,
}

/// One base mesh.
#[derive(Debug, Serialize)]
pub(crate) struct Level {
    pub(crate) faces: usize,
    pub(crate) errors: BTreeMap<Variant, Errors>,
    /// The largest of all G1 surfaces.
    pub(crate) g1_angle_deg: f64,
    pub(crate) row_residual: f64,
}

/// Points at which a curve is compared.
const CURVE_SAMPLES: u32 = 32;

pub(super) fn measure(family: &Family, mesh: TriMesh) -> Result<Level> {
    let diagonal = mesh.diagonal();
    let settings = Settings::with_faces(mesh.topology().face_count());
    let target = FieldSource::new(&*family.field, diagonal, settings.projection);
    let mut level = Level {
        faces: mesh.topology().face_count(),
        errors: BTreeMap::new(),
        g1_angle_deg: 0.0,
        row_residual: 0.0,
    };

    let published = settings.clone().with_method(Method::Published);
    let unrefined = Settings { curve_refinement: CurveRefinement::None, ..settings.clone() };
    let fits = [
        (Variant::Published, published, Some(Variant::Curves)),
        (Variant::Unrefined, unrefined, None),
        (Variant::Refined, settings, Some(Variant::RefinedCurves)),
    ];
    for (variant, settings, curves) in fits {
        let surface = fit_base_mesh(&*family.field, mesh.clone(), &settings, &mut Silent)?;
        level.add_surface(variant, &surface, &target, diagonal);
        if let Some(curves) = curves {
            let max = curve_error(&surface.network, &target) / diagonal;
            let errors = Errors { max, rms: None, normal_deg: None, folds: 0, retreats: 0 };
            level.errors.insert(curves, errors);
        }
        if variant == Variant::Published {
            let plan = Plan::uniform(mesh.topology(), settings.patches);
            let patches = g1_triangular::fill(&mesh, &surface.network, &target, &plan);
            level.add(Variant::PublishedG0, &patches.nets, &target, diagonal);
        }
    }
    level.add(Variant::Interpolant4, &interpolate::<15>(&mesh, &target)?, &target, diagonal);
    level.add(Variant::Interpolant7, &interpolate::<36>(&mesh, &target)?, &target, diagonal);
    Ok(level)
}

impl Level {
    fn add(
        &mut self,
        variant: Variant,
        nets: &FaceMap<SepticTriangle>,
        target: &dyn SurfaceTarget,
        diagonal: f64,
    ) {
        let (found, _) = deviation(nets, target, diagonal);
        let errors = Errors {
            max: found.max,
            rms: Some(found.rms),
            normal_deg: Some(found.max_normal_deg),
            folds: found.folded.len(),
            retreats: 0,
        };
        self.errors.insert(variant, errors);
    }

    fn add_surface(
        &mut self,
        variant: Variant,
        surface: &G1Surface,
        target: &dyn SurfaceTarget,
        diagonal: f64,
    ) {
        let nets = &surface.patches.nets;
        self.add(variant, nets, target, diagonal);
        if let Some(errors) = self.errors.get_mut(&variant) {
            errors.retreats = surface.retreats.as_slice().iter().flatten().count();
        }
        let joined = continuity(surface.mesh.topology(), nets);
        self.g1_angle_deg = self.g1_angle_deg.max(joined.g1_angle_deg);
        self.row_residual = self.row_residual.max(surface.max_row_residual());
    }
}

/// Largest distance of the curves to the target; infinite if a sample has no foot.
fn curve_error(network: &CurveNetwork, target: &dyn SurfaceTarget) -> f64 {
    let distances = network.curves().map(|_, curve| {
        let sample = |j| {
            let point = curve.eval(f64::from(j) / f64::from(CURVE_SAMPLES));
            target.foot(point).map_or(f64::INFINITY, |foot| foot.point.distance(point))
        };
        (1..CURVE_SAMPLES).map(sample).fold(0.0, f64::max)
    });
    distances.as_slice().iter().copied().fold(0.0, f64::max)
}
