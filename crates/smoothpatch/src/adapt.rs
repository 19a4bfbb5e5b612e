//! An accuracy instead of a number of faces: the base mesh is changed until the measured deviation
//! holds everywhere.

mod equalise;
mod wishes;

use basemesh::{
    FaceMap, FieldTarget, ImproveSettings, RemeshSettings, Simplified, SimplifyError,
    SimplifySettings, TriMesh, polygonize_to_faces, remesh, simplify,
};
use implicit::{Aabb, ImplicitSurface};
use serde::{Deserialize, Serialize};

use crate::error::FitError;
use crate::measure::{FaceDeviation, settle};
use crate::memory::Memory;
use crate::pipeline::{fit_again, fit_mesh, needs_repair};
use crate::progress::{Clock, Progress, Stage};
use crate::settings::Settings;
use crate::source::FieldSource;
use crate::surface::{BaseMeshOrigin, G1Surface, Polygonized};
pub(crate) use equalise::equalise;
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
/// Part of the tolerance that must not be exceeded, so that a denser measurement agrees.
const SAFETY: f64 = 0.95;
/// Triangles of the polygonization: as few as show the topology.
const COARSE: usize = 4000;
/// Faces of the first base mesh for each triangle of the polygonization, inverse.
const FIRST_REDUCTION: usize = 8;

/// Implicit surface to G1 spline with a given accuracy and few faces.
///
/// Starts from a coarse polygonization whose topology two resolutions agree on. Then the base mesh
/// is fitted, measured and remeshed in turn: first everywhere, with edge lengths that make the
/// deviation about the same on all faces (it falls with the sixth power of the length, normal
/// angles with the fifth), then only where the tolerance is exceeded or where edges are not
/// resolved. The number of faces in `settings` is not used.
///
/// A tolerance that cannot be met is not an error: [`Adaptation::met`] tells. At a sharp edge the mesh
/// would grow without end; it ends before the base mesh has more than 100 000 faces.
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
    let dense =
        clock.run(Stage::Polygonize, COARSE, || polygonize_to_faces(field, region, COARSE))?;
    let polygonized = Polygonized::from(&dense);
    let length = dense.mesh.diagonal();
    if let Distance::Absolute(value) = tolerance.distance
        && value < SMALLEST * length
    {
        return Err(FitError::DistanceTolerance { value, smallest: SMALLEST * length });
    }
    let source = FieldSource::new(field, length, settings.projection);
    let first = clock.run(Stage::Simplify, dense.mesh.topology().face_count(), || {
        let target = FieldTarget::new(field, length, settings.projection);
        first_mesh(dense.mesh, &target, &settings.base_mesh.simplify)
    })?;

    let mut mesh = first.mesh;
    let mut shaping = SHAPING_ROUNDS;
    let (mut rounds, mut refining) = (0, 0);
    let mut memory = Memory::default();
    let (mut surface, met) = loop {
        rounds += 1;
        let faces = mesh.topology().face_count();
        let (surface, mut deviations) =
            fit_again(mesh, &source, settings, &mut memory, &mut clock)?;
        if shaping == 0 {
            clock
                .run(Stage::Measure, 0, || settle(&mut deviations, &surface.patches.nets, &source));
        }
        let excess = excess(&surface, &deviations, tolerance);
        let wishes = if shaping > 0 {
            Some(all_wishes(&surface.mesh, &excess))
        } else {
            refining += 1;
            urgent_wishes(&surface, &excess, refining)
        };
        let Some(wishes) = wishes else { break (surface, true) };
        if refining == REFINING_ROUNDS {
            break (surface, false);
        }
        mesh = clock
            .run(Stage::Simplify, faces, || remesh(&surface.mesh, &source, &wishes, &few_faces()))?
            .mesh;
        if mesh.topology().face_count() > MOST_FACES {
            break (surface, false);
        }
        let change = mesh.topology().face_count() as f64 / faces as f64;
        shaping = if (change - 1.0).abs() < SHAPED { 0 } else { shaping.saturating_sub(1) };
    };
    if needs_repair(&surface, &source) {
        surface = fit_mesh(surface.mesh, &source, settings, 0, &mut clock)?;
    }
    surface.origin = BaseMeshOrigin {
        polygonized: Some(polygonized),
        simplified: Some(first.report),
        added_faces: 0,
        adaptation: Some(Adaptation { tolerance: *tolerance, met, rounds }),
    };
    surface.times = clock.times;
    Ok(surface)
}

/// Wider limits than for a mesh of a given size: thin faces are tolerated where that saves some.
fn few_faces() -> RemeshSettings {
    let limits = ImproveSettings { min_quality: 0.25, lean_cos: 0.1, ..ImproveSettings::default() };
    RemeshSettings { limits, ..RemeshSettings::default() }
}

/// The mesh that is fitted first, with few faces, but enough for its topology.
fn first_mesh(
    dense: TriMesh,
    target: &FieldTarget<'_>,
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
fn excess(
    surface: &G1Surface,
    deviations: &FaceMap<FaceDeviation>,
    tolerance: &Tolerance,
) -> FaceMap<f64> {
    let diagonal = surface.mesh.diagonal();
    let distance = match tolerance.distance {
        Distance::Relative(part) => part * diagonal,
        Distance::Absolute(length) => length,
    };
    deviations.map(|_, face: &FaceDeviation| {
        if face.folded {
            return f64::INFINITY;
        }
        let by_distance = face.max / (SAFETY * distance);
        let by_normal = (face.max_normal.to_degrees() / (SAFETY * tolerance.normal_limit_deg()))
            .powf(6.0 / 5.0);
        by_distance.max(by_normal)
    })
}
