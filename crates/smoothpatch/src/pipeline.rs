//! The story: from an implicit function to a smooth surface, one stage after the other.

use basemesh::{
    EdgeMap, FaceMap, FieldTarget, Simplified, TriMesh, VertexMap, polygonize_to_faces, simplify,
};
use bezier_core::SurfaceJet;
use g1_triangular::{
    CurveNetwork, Earlier, Nothing, PositionalPatches, SmoothPatches, fill_reusing, join_reusing,
};
use hermite_sqp::EdgeOutcome;
use implicit::{Aabb, ImplicitSurface};

use crate::adapt::equalise;
use crate::again::unchanged;
use crate::curves::{fit_curves, reconcile_curves, refit_curves, vertex_jets};
use crate::error::FitError;
use crate::folds::find_folds;
use crate::objectives::Objectives;
use crate::progress::{Clock, Progress, Stage, StageTimes};
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
        let known = unchanged(&mesh, &fitted, &curves, [&before, &objectives.patches]);
        fitted = fit_patches(&mesh, &jets, curves, source, &objectives, &known, clock)?;
    }
    Ok(surface(mesh, jets, fitted, objectives))
}

pub(crate) fn surface(
    mesh: TriMesh,
    jets: VertexMap<SurfaceJet>,
    fitted: Fitted,
    objectives: Objectives,
) -> G1Surface {
    let Fitted { curves, network, failed_feet, patches } = fitted;
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
pub(crate) struct Fitted {
    pub(crate) curves: EdgeMap<EdgeOutcome>,
    pub(crate) network: CurveNetwork,
    /// Samples per face that could not be projected.
    pub(crate) failed_feet: FaceMap<usize>,
    pub(crate) patches: SmoothPatches,
}

/// Patches, then smooth patches, over given curves.
#[allow(clippy::too_many_arguments, reason = "everything that a patch depends on")]
pub(crate) fn fit_patches(
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
    let PositionalPatches { nets, failed_feet } =
        clock.run(Stage::Fill, faces, || fill_reusing(mesh, &network, source, plan, earlier));
    let patches = clock.run(Stage::Join, faces, || {
        join_reusing(mesh, jets, &network, nets, source, plan, earlier)
    })?;
    Ok(Fitted { curves, network, failed_feet, patches })
}

/// Takes the objectives of folded patches back; `false` if no patch folds that could be helped.
pub(crate) fn retreat(
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
