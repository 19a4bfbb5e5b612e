//! The story: from an implicit function to a smooth surface, one stage after the other.

use basemesh::glam::DVec3;
use basemesh::{
    EdgeId, EdgeMap, FaceMap, FieldTarget, Foot, Simplified, SurfaceTarget, TriMesh, VertexMap,
    polygonize_to_faces, simplify,
};
use bezier_core::SurfaceJet;
use g1_triangular::{
    CurveNetwork, Earlier, Nothing, PositionalPatches, SmoothPatches, fill_reusing, join_reusing,
};
use hermite_sqp::{CurveFoot, CurveRefinement, CurveSample, EdgeOutcome, EdgeProblem, EdgeStatus};
use implicit::{Aabb, ImplicitSurface};

use crate::adapt::equalise;
use crate::again::Unchanged;
use crate::agreement::{agreeing, contradicted};
use crate::error::FitError;
use crate::folds::find_folds;
use crate::measure::{FaceDeviation, face_deviations};
use crate::memory::{Keys, Memory, Recall};
use crate::objectives::Objectives;
use crate::progress::{Clock, Progress, Stage, StageTimes};
use crate::reconcile::reconciled;
use crate::repair::{self, edges_to_split, refine};
use crate::settings::{SecondForms, Settings};
use crate::source::{FieldSource, FitSource};
use crate::surface::{BaseMeshOrigin, G1Surface, Polygonized};

/// Implicit surface to G1 spline: polygonize, simplify, fit curves, fill, join.
///
/// All components of `field = 0` in `region` are approximated by about
/// [`settings.faces()`](Settings::faces) patches of degree 7 whose tangent planes agree along every
/// edge, and which interpolate position, normal and second fundamental form of the surface at every
/// vertex.
///
/// # Errors
///
/// [`FitError`]: no surface in the region, a surface that leaves it, a singular point, too few
/// faces for its topology.
pub fn fit(
    field: &dyn ImplicitSurface,
    region: &Aabb,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> Result<G1Surface, FitError> {
    let mut clock = Clock::new(progress);
    let faces = settings.faces();
    let dense = clock.run(Stage::Polygonize, settings.base_mesh.oversampling * faces, || {
        polygonize_to_faces(field, region, settings.base_mesh.oversampling * faces)
    })?;
    let polygonized = Polygonized::from(&dense);
    let length = dense.mesh.diagonal();
    let base = clock.run(Stage::Simplify, dense.mesh.topology().face_count(), || {
        let target = FieldTarget::new(field, length, settings.projection);
        simplify(dense.mesh, &target, &settings.base_mesh.simplify)
    })?;
    let source = FieldSource::new(field, base.mesh.diagonal(), settings.projection);
    let mut surface = fit_simplified(base, &source, settings, &mut clock)?;
    surface.origin.polygonized = Some(polygonized);
    surface.times = clock.times;
    Ok(surface)
}

/// A G1 spline with about [`settings.faces()`](Settings::faces) patches from a dense mesh near a surface:
/// simplify, fit curves, fill, join.
///
/// # Errors
///
/// [`FitError`]: an open mesh, vertices without data, too few faces for the topology.
pub fn fit_dense_mesh(
    dense: TriMesh,
    source: &dyn FitSource,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> Result<G1Surface, FitError> {
    let mut clock = Clock::new(progress);
    let base = clock.run(Stage::Simplify, dense.topology().face_count(), || {
        simplify(dense, source, &settings.base_mesh.simplify)
    })?;
    let mut surface = fit_simplified(base, source, settings, &mut clock)?;
    surface.times = clock.times;
    Ok(surface)
}

/// The fit of a base mesh whose faces may change, with their number kept if that is possible.
fn fit_simplified(
    base: Simplified,
    source: &dyn FitSource,
    settings: &Settings,
    clock: &mut Clock<'_>,
) -> Result<G1Surface, FitError> {
    let mut surface = equalise(base.mesh, source, settings, clock)?;
    if needs_repair(&surface, source) {
        let rounds = settings.base_mesh.repair_rounds;
        surface = fit_mesh(surface.mesh, source, settings, rounds, clock)?;
    }
    let added_faces = surface.mesh.topology().face_count() - base.report.faces;
    let simplified = Some(base.report);
    surface.origin = BaseMeshOrigin { simplified, added_faces, ..BaseMeshOrigin::default() };
    Ok(surface)
}

/// A G1 spline over a base mesh that is given: its faces become the patches, as they are.
///
/// The vertices stay where they are; normals and curvatures are those of the level set through
/// each vertex.
///
/// # Errors
///
/// [`FitError`]: a singular point, an edge without a curve.
pub fn fit_base_mesh(
    field: &dyn ImplicitSurface,
    mesh: TriMesh,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> Result<G1Surface, FitError> {
    let source = FieldSource::new(field, mesh.diagonal(), settings.projection);
    fit_source(&source, mesh, settings, progress)
}

/// A G1 spline over a base mesh from any source of feet and second-order data.
///
/// # Errors
///
/// [`FitError`]: vertices without data, an edge without a curve.
pub fn fit_source(
    source: &dyn FitSource,
    mesh: TriMesh,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> Result<G1Surface, FitError> {
    let mut clock = Clock::new(progress);
    let mut surface = fit_mesh(mesh, source, settings, 0, &mut clock)?;
    surface.times = clock.times;
    Ok(surface)
}

/// Whether the base mesh does not resolve the surface somewhere, or patches fold over.
pub(crate) fn needs_repair(surface: &G1Surface, source: &dyn FitSource) -> bool {
    let G1Surface { mesh, jets, curves, patches, .. } = surface;
    !edges_to_split(mesh, jets, curves).is_empty()
        || !find_folds(mesh, jets, &patches.nets, source).is_empty()
}

/// Rounds that refine a mesh of estimated data where patches still fold.
const FOLD_ROUNDS: usize = 2;

/// Curves, then patches, then smooth patches; with local refinement of the mesh where its curves
/// show that it does not resolve the surface, and, for estimated data, where patches still fold.
pub(crate) fn fit_mesh(
    mesh: TriMesh,
    source: &dyn FitSource,
    settings: &Settings,
    repair_rounds: usize,
    clock: &mut Clock<'_>,
) -> Result<G1Surface, FitError> {
    let folds = |surface: &G1Surface| {
        find_folds(&surface.mesh, &surface.jets, &surface.patches.nets, source)
    };
    let mut best = fit_mesh_once(mesh, source, settings, repair_rounds, clock)?;
    if repair_rounds == 0 || settings.second_forms == SecondForms::Given {
        return Ok(best);
    }
    let mut left = folds(&best);
    let mut refined = repair::edges_of_folds(&best.mesh, &best.jets, &left);
    let mut mesh = best.mesh.clone();
    for _ in 0..FOLD_ROUNDS {
        if left.is_empty() {
            break;
        }
        let split = clock.run(Stage::Simplify, refined.len(), || refine(&mesh, source, &refined));
        // no surface near an edge: what cannot be mended is reported
        let Ok(split) = split else { break };
        let next = fit_mesh_once(split, source, settings, repair_rounds, clock)?;
        let folded = folds(&next);
        refined = repair::edges_of_folds(&next.mesh, &next.jets, &folded);
        mesh = next.mesh.clone();
        if folded.len() < left.len() {
            (best, left) = (next, folded);
        }
    }
    Ok(best)
}

fn fit_mesh_once(
    mut mesh: TriMesh,
    source: &dyn FitSource,
    settings: &Settings,
    mut repair_rounds: usize,
    clock: &mut Clock<'_>,
) -> Result<G1Surface, FitError> {
    let (jets, curves) = loop {
        let vertices = mesh.topology().vertex_count();
        let jets = clock.run(Stage::Vertices, vertices, || vertex_jets(&mesh, source, settings))?;
        let edges = mesh.topology().edge_count();
        let (jets, curves) = clock.run(Stage::Curves, edges, || {
            let curves = fit_curves(&mesh, &jets, source, settings)?;
            reconcile_curves(&mesh, jets, curves, source, settings)
        })?;
        let unresolved = edges_to_split(&mesh, &jets, &curves);
        if unresolved.is_empty() || repair_rounds == 0 {
            break (jets, curves);
        }
        repair_rounds -= 1;
        let refined =
            clock.run(Stage::Simplify, unresolved.len(), || refine(&mesh, source, &unresolved));
        match refined {
            Ok(refined) => mesh = refined,
            // no surface near an edge: what cannot be mended is reported
            Err(_) => break (jets, curves),
        }
    };
    let mut objectives = Objectives::uniform(mesh.topology(), settings);
    let mut fitted = fit_patches(&mesh, &jets, curves, source, &objectives, &Nothing, clock)?;
    // a patch that folds over is made again, step by step closer to the published method
    loop {
        let before = objectives.patches.clone();
        if !retreat(&mesh, &jets, &fitted, source, &mut objectives) {
            break;
        }
        let curves = clock.run(Stage::Curves, 0, || {
            refit_curves(&mesh, &jets, &fitted.curves, source, settings, &objectives)
        })?;
        let unchanged = Unchanged::new(
            &mesh,
            [&fitted.curves, &curves],
            [&before, &objectives.patches],
            &fitted.positional,
            &fitted.patches,
        );
        fitted = fit_patches(&mesh, &jets, curves, source, &objectives, &unchanged, clock)?;
    }
    Ok(surface(mesh, jets, fitted, objectives))
}

/// Curves, then patches, then smooth patches, found anew only where the mesh has changed since the
/// fit that is remembered; `memory` then remembers this one. No repair, no fold guard: what is wrong
/// shows in the deviation, and the mesh changes there.
pub(crate) fn fit_again(
    mesh: TriMesh,
    source: &dyn FitSource,
    settings: &Settings,
    memory: &mut Memory,
    clock: &mut Clock<'_>,
) -> Result<(G1Surface, FaceMap<FaceDeviation>), FitError> {
    let topology = mesh.topology();
    let [vertices, edges, faces] =
        [topology.vertex_count(), topology.edge_count(), topology.face_count()];
    let keys = Keys::new(&mesh);
    if settings.second_forms != SecondForms::Given {
        // data at a vertex then depend on its neighbours, which the keys do not know
        *memory = Memory::default();
    }
    let recall = Recall { memory, keys: &keys };
    let objectives = Objectives::uniform(topology, settings);
    let plan = &objectives.patches;

    let jets = clock.run(Stage::Vertices, vertices, || vertex_jets(&mesh, source, settings))?;
    let curves = clock.run(Stage::Curves, edges, || {
        EdgeMap::try_from_fn(edges, |edge| {
            let fit = || fit_curve(&mesh, &jets, source, settings, edge, settings.curve_refinement);
            recall.curve(edge).map_or_else(fit, Ok)
        })
    })?;
    let network = CurveNetwork::new(curves.map(|_, outcome| outcome.curve));
    let positional =
        clock.run(Stage::Fill, faces, || fill_reusing(&mesh, &network, source, plan, &recall));
    let patches = clock.run(Stage::Join, faces, || {
        let nets = positional.nets.clone();
        join_reusing(&mesh, &jets, &network, nets, source, plan, &recall)
    })?;
    let deviations = clock.run(Stage::Measure, faces, || {
        face_deviations(&patches.nets, source, |face| recall.deviation(face))
    });
    *memory = Memory::of(&keys, &curves, &positional, &patches, &deviations);
    let fitted = Fitted { curves, network, positional, patches };
    Ok((surface(mesh, jets, fitted, objectives), deviations))
}

fn surface(
    mesh: TriMesh,
    jets: VertexMap<SurfaceJet>,
    fitted: Fitted,
    objectives: Objectives,
) -> G1Surface {
    let Fitted { curves, network, positional, patches } = fitted;
    let failed_feet = positional.failed_feet;
    G1Surface {
        mesh,
        jets,
        curves,
        network,
        failed_feet,
        patches,
        retreats: objectives.retreats,
        origin: BaseMeshOrigin::default(),
        times: StageTimes::default(),
        rim: None,
    }
}

/// A curve network and its smooth patches.
struct Fitted {
    curves: EdgeMap<EdgeOutcome>,
    network: CurveNetwork,
    positional: PositionalPatches,
    patches: SmoothPatches,
}

/// Patches, then smooth patches, over given curves.
#[allow(clippy::too_many_arguments, reason = "everything that a patch depends on")]
fn fit_patches(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    curves: EdgeMap<EdgeOutcome>,
    source: &dyn FitSource,
    objectives: &Objectives,
    earlier: &dyn Earlier,
    clock: &mut Clock<'_>,
) -> Result<Fitted, FitError> {
    let network = CurveNetwork::new(curves.map(|_, outcome| outcome.curve));
    let faces = mesh.topology().face_count();
    let plan = &objectives.patches;
    let positional =
        clock.run(Stage::Fill, faces, || fill_reusing(mesh, &network, source, plan, earlier));
    let patches = clock.run(Stage::Join, faces, || {
        join_reusing(mesh, jets, &network, positional.nets.clone(), source, plan, earlier)
    })?;
    Ok(Fitted { curves, network, positional, patches })
}

/// Takes the objectives of folded patches back; `false` if no patch folds that could be helped.
fn retreat(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    fitted: &Fitted,
    source: &dyn FitSource,
    objectives: &mut Objectives,
) -> bool {
    let folds = find_folds(mesh, jets, &fitted.patches.nets, source);
    // all of them, whichever succeeds first
    folds.into_iter().filter(|&face| objectives.retreat(mesh.topology(), face)).count() > 0
}

/// Position, normal and second fundamental form at every vertex.
fn vertex_jets(
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
fn reconcile_curves(
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
fn fit_curves(
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
fn refit_curves(
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

fn fit_curve(
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
