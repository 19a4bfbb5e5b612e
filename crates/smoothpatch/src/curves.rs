//! Second-order data at the vertices and the curve of every edge.

use basemesh::glam::DVec3;
use basemesh::{EdgeId, EdgeMap, Foot, SurfaceTarget, TriMesh, VertexMap};
use bezier_core::SurfaceJet;
use hermite_sqp::{CurveFoot, CurveRefinement, CurveSample, EdgeOutcome, EdgeProblem, EdgeStatus};

use crate::agreement::{agreeing, contradicted};
use crate::error::FitError;
use crate::objectives::Objectives;
use crate::reconcile::reconciled;
use crate::settings::{SecondForms, Settings};
use crate::source::FitSource;

/// Position, normal and second fundamental form at every vertex.
pub(crate) fn vertex_jets(
    mesh: &TriMesh,
    source: &dyn FitSource,
    settings: &Settings,
) -> Result<VertexMap<SurfaceJet>, FitError> {
    let jets = VertexMap::try_from_fn(mesh.topology().vertex_count(), |vertex| {
        let at = mesh.position(vertex);
        source.surface_jet(vertex, at).ok_or(FitError::Singular { vertex: vertex.index(), at })
    })?;
    Ok(match settings.second_forms {
        SecondForms::Given => jets,
        SecondForms::AgreeAlongEdges => {
            let emphasis = EdgeMap::from_vec(vec![1.0; mesh.topology().edge_count()]);
            agreeing(mesh, &reconciled(mesh, &jets), &emphasis)
        }
    })
}

/// How often, and how much more edges count whose curves contradict the forms at their ends.
const EMPHASES: usize = 3;
const EMPHASIS: f64 = 30.0;

/// Forms may change further where curves cannot meet them; the curves around are then fitted again.
pub(crate) fn reconcile_curves(
    mesh: &TriMesh,
    mut jets: VertexMap<SurfaceJet>,
    mut curves: EdgeMap<EdgeOutcome>,
    source: &dyn FitSource,
    settings: &Settings,
) -> Result<(VertexMap<SurfaceJet>, EdgeMap<EdgeOutcome>), FitError> {
    if settings.second_forms == SecondForms::Given {
        return Ok((jets, curves));
    }
    let topology = mesh.topology();
    let mut emphasis = EdgeMap::from_vec(vec![1.0; topology.edge_count()]);
    for _ in 0..EMPHASES {
        let missed = contradicted(mesh, &jets, &curves);
        if missed.is_empty() {
            break;
        }
        missed.into_iter().for_each(|edge| emphasis[edge] *= EMPHASIS);
        let changed = agreeing(mesh, &jets, &emphasis);
        curves = EdgeMap::try_from_fn(curves.len(), |edge| {
            let same = topology.edge_vertices(edge).iter().all(|&v| changed[v] == jets[v]);
            if same {
                return Ok(curves[edge]);
            }
            fit_curve(mesh, &changed, source, settings, edge, settings.curve_refinement)
        })?;
        jets = changed;
    }
    Ok((jets, curves))
}

/// One curve per edge, from its lower to its higher vertex.
pub(crate) fn fit_curves(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    target: &dyn FitSource,
    settings: &Settings,
) -> Result<EdgeMap<EdgeOutcome>, FitError> {
    EdgeMap::try_from_fn(mesh.topology().edge_count(), |edge| {
        fit_curve(mesh, jets, target, settings, edge, settings.curve_refinement)
    })
}

/// The curves with those made anew whose objectives are not the general ones any more.
pub(crate) fn refit_curves(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    curves: &EdgeMap<EdgeOutcome>,
    target: &dyn FitSource,
    settings: &Settings,
    objectives: &Objectives,
) -> Result<EdgeMap<EdgeOutcome>, FitError> {
    EdgeMap::try_from_fn(curves.len(), |edge| {
        let refinement = objectives.curves[edge];
        if refinement == settings.curve_refinement {
            Ok(curves[edge])
        } else {
            fit_curve(mesh, jets, target, settings, edge, refinement)
        }
    })
}

pub(crate) fn fit_curve(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    target: &dyn FitSource,
    settings: &Settings,
    edge: EdgeId,
    refinement: CurveRefinement,
) -> Result<EdgeOutcome, FitError> {
    if let Some(curve) = target.given_curve(edge) {
        let status = EdgeStatus::Converged { iterations: 0, published_iterations: 0 };
        return Ok(EdgeOutcome { curve, status });
    }
    let [a, b] = mesh.topology().edge_vertices(edge);
    let samples = curve_samples(&jets[a], &jets[b], target, settings.curve_sections);
    let problem = EdgeProblem::new(&jets[a], &jets[b], &samples).map_err(|reason| {
        FitError::Edge { edge: edge.index(), a: a.index(), b: b.index(), reason }
    })?;
    let solved = hermite_sqp::solve(&problem, &settings.curves);
    let feet = |points: &[DVec3], feet: &mut [CurveFoot]| {
        let mut found: [Option<Foot>; hermite_sqp::MOST_FEET] = [None; hermite_sqp::MOST_FEET];
        target.linear_feet(points, &mut found[..points.len()]);
        feet.iter_mut().zip(&found).all(|(slot, foot)| {
            foot.is_some_and(|Foot { point, normal }| {
                *slot = CurveFoot { point, normal };
                true
            })
        })
    };
    let refined = hermite_sqp::refine(&problem, &solved.curve, refinement, &settings.curves, &feet);
    Ok(EdgeOutcome { curve: refined.curve, ..solved })
}

/// Points of the surface near equidistant points of the chord; those that have no foot are left
/// out.
fn curve_samples(
    start: &SurfaceJet,
    end: &SurfaceJet,
    target: &dyn SurfaceTarget,
    sections: usize,
) -> Vec<CurveSample> {
    let parameters: Vec<f64> = (1..sections).map(|j| j as f64 / sections as f64).collect();
    let chord: Vec<_> =
        parameters.iter().map(|&t| start.point * (1.0 - t) + end.point * t).collect();
    let mut feet = vec![None; chord.len()];
    target.feet(&chord, &mut feet);
    parameters
        .into_iter()
        .zip(feet)
        .filter_map(|(t, foot)| Some(CurveSample { t, point: foot?.point }))
        .collect()
}
