//! An accuracy instead of a number of faces: the base mesh is changed until the measured deviation
//! holds everywhere.

mod equalise;
mod fitted;
mod spare;
mod wishes;

use std::sync::Arc;

use basemesh::{
    FaceMap, FieldTarget, ImproveSettings, RemeshSettings, Simplified, SimplifyError,
    SimplifySettings, SurfaceTarget, TriMesh, polygonize_to_faces, simplify,
};
use implicit::{Aabb, ImplicitSurface};
use serde::{Deserialize, Serialize};

use crate::error::FitError;
use crate::measure::FaceDeviation;
use crate::memory::Memory;
use crate::pipeline::{fit_mesh, needs_repair};
use crate::progress::{Clock, Progress, Stage};
use crate::settings::Settings;
use crate::source::{FieldSource, FitSource};
use crate::surface::{BaseMeshOrigin, G1Surface, Polygonized};
pub(crate) use equalise::equalise;
use fitted::{Fitted, Job};
use spare::spare;
use wishes::{all_wishes, urgent_wishes};

/// How close the patches must come to the surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// Largest distance to the surface.
    pub distance: Distance,
    /// Largest angle between patch normal and surface normal in degrees; never more than 10°.
    pub normal_deg: Option<f64>,
}

/// A distance and what it is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Distance {
    /// In diagonals of the bounding box of the surface.
    Relative(f64),
    /// In units of length.
    Absolute(f64),
}

/// Smallest distance that can be asked for, in diagonals: a hundred times what feet are off.
const SMALLEST: f64 = 1e-11;

impl Tolerance {
    /// Largest normal angle in degrees, whatever is asked for: patches that lean more are nearly
    /// folded.
    pub const LARGEST_NORMAL_DEG: f64 = 10.0;

    /// The normal angle in degrees that must hold.
    #[must_use]
    pub fn normal_limit_deg(&self) -> f64 {
        self.normal_deg
            .map_or(Self::LARGEST_NORMAL_DEG, |asked| asked.min(Self::LARGEST_NORMAL_DEG))
    }

    /// Whether both numbers are positive and can be measured.
    fn check(&self) -> Result<(), FitError> {
        let (value, smallest) = match self.distance {
            Distance::Relative(value) => (value, SMALLEST),
            Distance::Absolute(value) => (value, 0.0),
        };
        if !(value.is_finite() && value > 0.0 && value >= smallest) {
            return Err(FitError::DistanceTolerance { value, smallest });
        }
        match self.normal_deg.filter(|degrees| !(degrees.is_finite() && *degrees > 0.0)) {
            Some(degrees) => Err(FitError::NormalTolerance { degrees }),
            None => Ok(()),
        }
    }

    /// Whether the distance can be measured on a surface with this diagonal.
    fn check_size(&self, diagonal: f64) -> Result<(), FitError> {
        let smallest = SMALLEST * diagonal;
        match self.distance {
            Distance::Absolute(value) if value < smallest => {
                Err(FitError::DistanceTolerance { value, smallest })
            }
            _ => Ok(()),
        }
    }
}

/// How an accuracy was reached.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Adaptation {
    /// What was asked for.
    pub tolerance: Tolerance,
    /// Whether the measured deviation is within it everywhere.
    pub met: bool,
    /// Base meshes that were fitted.
    pub rounds: usize,
}

/// Rounds in which the whole mesh changes, and rounds that refine where the tolerance is exceeded.
const SHAPING_ROUNDS: usize = 6;
const REFINING_ROUNDS: usize = 20;
/// Shaping ends when a round changes the number of faces by less than this part.
const SHAPED: f64 = 0.03;
/// Most faces of a base mesh that is fitted.
const MOST_FACES: usize = 100_000;
/// Refining ends without success once it has multiplied the faces by this.
const MOST_GROWTH: usize = 4;
/// Part of the tolerance that must not be exceeded, so that a denser measurement agrees.
const SAFETY: f64 = 0.95;
/// Triangles of the polygonization: as few as show the topology. If patches of the first fit fold, it
/// is repeated with `FINER` times as many, up to `FINE`.
const COARSE: usize = 4000;
const FINER: usize = 4;
const FINE: usize = 16_000;
/// Faces of the first base mesh for each triangle of the polygonization, inverse.
const FIRST_REDUCTION: usize = 8;

/// Implicit surface to G1 spline with a given accuracy and few faces.
///
/// Starts from a coarse polygonization whose topology two resolutions agree on. Then the base mesh
/// is fitted, measured and remeshed in turn: first everywhere, with edge lengths that make the
/// deviation about the same on all faces (it falls with the sixth power of the length, normal
/// angles with the fifth), then only where the tolerance is exceeded or where edges are not
/// resolved. At last faces are taken away as long as it holds without them. The number of faces in `settings` is not used.
///
/// A tolerance that cannot be met is not an error: [`Adaptation::met`] tells. At a sharp edge the mesh
/// would grow without end; it ends at 100 000 faces, or when refining has made four times as many
/// faces as there were.
///
/// # Errors
///
/// [`FitError`], as for [`fit`](crate::fit).
pub fn fit_to_tolerance(
    field: &dyn ImplicitSurface,
    region: &Aabb,
    tolerance: &Tolerance,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> Result<G1Surface, FitError> {
    tolerance.check()?;
    let mut clock = Clock::new(progress);
    let (source, fitted, origin) = start(field, region, tolerance, settings, &mut clock)?;
    let mut surface = adapt(fitted, &source, tolerance, settings, &mut clock)?;
    surface.origin = BaseMeshOrigin { adaptation: surface.origin.adaptation, ..origin };
    surface.times = clock.times;
    Ok(surface)
}

/// Dense mesh near a surface to G1 spline with a given accuracy and few faces; see
/// [`fit_to_tolerance`].
///
/// # Errors
///
/// [`FitError`], as for [`fit_dense_mesh`](crate::fit_dense_mesh).
pub fn fit_dense_mesh_to_tolerance(
    dense: TriMesh,
    source: &dyn FitSource,
    tolerance: &Tolerance,
    settings: &Settings,
    progress: &mut dyn Progress,
) -> Result<G1Surface, FitError> {
    tolerance.check()?;
    tolerance.check_size(dense.diagonal())?;
    let mut clock = Clock::new(progress);
    let first = clock.run(Stage::Simplify, dense.topology().face_count(), || {
        first_mesh(dense, source, &settings.base_mesh.simplify)
    })?;
    let memory = Memory::default();
    let fitted = Job { source, settings, memory, clock: &mut clock }.fit(first.mesh)?;
    let mut surface = adapt(fitted, source, tolerance, settings, &mut clock)?;
    surface.origin.simplified = Some(first.report);
    surface.times = clock.times;
    Ok(surface)
}

/// Changes the base mesh of a first fit until the accuracy is reached with few faces.
fn adapt(
    mut fitted: Fitted,
    source: &dyn FitSource,
    tolerance: &Tolerance,
    settings: &Settings,
    clock: &mut Clock<'_>,
) -> Result<G1Surface, FitError> {
    let memory = Memory::default();
    let mut job = Job { source, settings, memory, clock };
    let mut shaping = SHAPING_ROUNDS;
    let (mut rounds, mut refining) = (1, 0);
    let mut shaped_faces = MOST_FACES;
    let met = loop {
        if shaping == 0 {
            job.settle(&mut fitted);
        }
        let excess = excess(&fitted, tolerance);
        let wishes = if shaping > 0 {
            Some(all_wishes(&fitted.surface.mesh, &excess))
        } else {
            refining += 1;
            urgent_wishes(&fitted.surface, &excess, refining)
        };
        let Some(wishes) = wishes else { break true };
        if refining == REFINING_ROUNDS {
            break false;
        }
        let faces = fitted.faces();
        let mut next = job.fit_remeshed(&fitted, &wishes, &few_faces())?;
        if next.folds() > fitted.folds() {
            // thin faces were too bold here
            let usual = RemeshSettings { limits: ImproveSettings::default(), ..few_faces() };
            next = job.fit_remeshed(&fitted, &wishes, &usual)?;
        }
        rounds += 1;
        fitted = next;
        if fitted.faces() >= MOST_FACES.min(MOST_GROWTH * shaped_faces) {
            break false;
        }
        let change = fitted.faces() as f64 / faces as f64;
        if shaping > 0 {
            shaping = if (change - 1.0).abs() < SHAPED { 0 } else { shaping - 1 };
            shaped_faces = fitted.faces();
        }
    };
    if met {
        fitted = spare(fitted, tolerance, &mut job)?;
    }
    drop(job.memory);
    let mut surface = Arc::unwrap_or_clone(fitted.surface);
    if needs_repair(&surface, source) {
        surface = fit_mesh(surface.mesh, source, settings, 0, clock)?;
    }
    surface.origin.adaptation = Some(Adaptation { tolerance: *tolerance, met, rounds });
    Ok(surface)
}

/// The first fit: of a coarse mesh, or of finer ones while patches fold.
fn start<'a>(
    field: &'a dyn ImplicitSurface,
    region: &Aabb,
    tolerance: &Tolerance,
    settings: &Settings,
    clock: &mut Clock<'_>,
) -> Result<(FieldSource<'a>, Fitted, BaseMeshOrigin), FitError> {
    let mut triangles = COARSE;
    loop {
        let dense = clock
            .run(Stage::Polygonize, triangles, || polygonize_to_faces(field, region, triangles))?;
        let polygonized = Some(Polygonized::from(&dense));
        let length = dense.mesh.diagonal();
        tolerance.check_size(length)?;
        let source = FieldSource::new(field, length, settings.projection);
        let first = clock.run(Stage::Simplify, dense.mesh.topology().face_count(), || {
            let target = FieldTarget::new(field, length, settings.projection);
            first_mesh(dense.mesh, &target, &settings.base_mesh.simplify)
        })?;
        let memory = Memory::default();
        let fitted = Job { source: &source, settings, memory, clock }.fit(first.mesh)?;
        if fitted.folds() == 0 || triangles == FINE {
            let simplified = Some(first.report);
            let origin =
                BaseMeshOrigin { polygonized, simplified, added_faces: 0, adaptation: None };
            return Ok((source, fitted, origin));
        }
        triangles *= FINER;
    }
}

/// Wider limits than for a mesh of a given size: thin faces are tolerated where that saves some.
fn few_faces() -> RemeshSettings {
    let limits = ImproveSettings { min_quality: 0.25, lean_cos: 0.1, ..ImproveSettings::default() };
    RemeshSettings { limits, most_faces: Some(MOST_FACES), ..RemeshSettings::default() }
}

/// The mesh that is fitted first, with few faces, but enough for its topology.
fn first_mesh(
    dense: TriMesh,
    target: &dyn SurfaceTarget,
    settings: &SimplifySettings,
) -> Result<Simplified, SimplifyError> {
    let faces = dense.topology().face_count() / FIRST_REDUCTION / 2 * 2;
    let to = |faces| SimplifySettings { faces, ..settings.clone() };
    match simplify(dense.clone(), target, &to(faces)) {
        Err(SimplifyError::TooFewFaces { needed, .. }) => {
            simplify(dense, target, &to(needed.div_ceil(2) * 2))
        }
        other => other,
    }
}

/// How much every face exceeds the tolerance: 1 is just within, and `e` asks for edges shorter by
/// the sixth root of `e`. Folded patches and samples without foot exceed everything.
fn excess(fitted: &Fitted, tolerance: &Tolerance) -> FaceMap<f64> {
    let diagonal = fitted.surface.mesh.diagonal();
    let distance = match tolerance.distance {
        Distance::Relative(part) => part * diagonal,
        Distance::Absolute(length) => length,
    };
    fitted.deviations.map(|_, face: &FaceDeviation| {
        if face.folded {
            return f64::INFINITY;
        }
        let by_distance = face.max / (SAFETY * distance);
        let by_normal = (face.max_normal.to_degrees() / (SAFETY * tolerance.normal_limit_deg()))
            .powf(6.0 / 5.0);
        by_distance.max(by_normal)
    })
}
