//! How far patches are from the surface they stand for.

use std::sync::LazyLock;

use basemesh::glam::DVec3;
use basemesh::{FaceId, FaceMap, Foot, SurfaceTarget};
use bezier_core::{Barycentric, ParameterGrid, SepticTriangle};
use serde::{Deserialize, Serialize};

/// Divisions of the barycentric grid on which every patch is compared: 153 points.
pub const GRID: usize = 16;
/// Divisions of the finest grid that is tried.
const FINEST_GRID: usize = 256;
/// The largest values count as settled when twice as many divisions raise them by no more than this.
const SETTLED: f64 = 1.05;
/// Patches above this part of the largest value are looked at again on the finer grid.
const CANDIDATES: f64 = 0.7;

/// Deviation of a whole surface from its target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deviation {
    /// Diagonal of the bounding box of the vertices, which `max` and `rms` are relative to.
    pub diagonal: f64,
    /// Largest distance to the target over the diagonal.
    pub max: f64,
    /// Area-weighted root mean square distance over the diagonal.
    pub rms: f64,
    /// Largest angle between patch normal and target normal, in degrees.
    pub max_normal_deg: f64,
    /// Area-weighted root mean square of that angle.
    pub rms_normal_deg: f64,
    /// The face with the largest distance.
    pub worst_face: usize,
    /// Faces whose normal turns away from the target's somewhere.
    pub folded: Vec<usize>,
    /// Samples that could not be projected onto the target; they count as infinitely far.
    pub failed_samples: usize,
    /// Divisions of the finest grid on which the worst patches were compared.
    pub grid: usize,
}

/// Deviation of one patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceDeviation {
    /// Largest distance. Unit: length.
    pub max: f64,
    /// Largest normal angle in radians.
    pub max_normal: f64,
    /// The patch normal turns away from the target's somewhere.
    pub folded: bool,
    failed: usize,
    area: f64,
    square_distance: f64,
    square_angle: f64,
}

/// Compares every patch with `target` on a grid of 153 points; `diagonal` is what the distances are
/// stated relative to.
///
/// The patches with the largest values are compared again on grids with twice as many divisions,
/// until the largest distance and the largest angle grow by less than 5 %. The distance is that to
/// the foot of the target, which for small deviations is the closest point to second order. Returns
/// the summary and the figures of each face.
#[must_use]
pub fn deviation(
    nets: &FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
    diagonal: f64,
) -> (Deviation, FaceMap<FaceDeviation>) {
    deviation_by(nets, &|_| target, diagonal)
}

/// [`deviation`] with a target for each face.
pub(crate) fn deviation_by<'t>(
    nets: &FaceMap<SepticTriangle>,
    targets: &(dyn (Fn(FaceId) -> &'t dyn SurfaceTarget) + Sync),
    diagonal: f64,
) -> (Deviation, FaceMap<FaceDeviation>) {
    let on_grid = |face, grid| compare(sampled(&nets[face], grid), targets(face));
    let mut faces = FaceMap::from_fn(nets.len(), |face| on_grid(face, GRID));
    let grid = settle_with(&mut faces, on_grid);
    (summarise(&faces, diagonal, grid), faces)
}

/// [`deviation`] on the grid of 153 points only, for comparison with figures measured like that.
#[must_use]
pub fn deviation_on_grid(
    nets: &FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
    diagonal: f64,
) -> Deviation {
    summarise(&face_deviations(nets, target, |_| None), diagonal, GRID)
}

/// Figures of each face on the grid of 153 points, those that `known` returns as they are.
pub(crate) fn face_deviations(
    nets: &FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
    known: impl Fn(FaceId) -> Option<FaceDeviation> + Sync,
) -> FaceMap<FaceDeviation> {
    FaceMap::from_fn(nets.len(), |face| {
        known(face).unwrap_or_else(|| compare(sampled(&nets[face], GRID), target))
    })
}

/// Positions and normals of a patch at a regular grid; the normals are as long as the area element.
pub(crate) type PatchSamples = (Vec<DVec3>, Vec<DVec3>);

pub(crate) fn sampled(net: &SepticTriangle, divisions: usize) -> PatchSamples {
    if divisions == GRID {
        return on_grid(net);
    }
    let parameters: Vec<Barycentric> = Barycentric::lattice(divisions).collect();
    let mut points = vec![DVec3::ZERO; parameters.len()];
    let mut normals = points.clone();
    net.points_and_area_normals(&parameters, &mut points, &mut normals);
    (points, normals)
}

/// [`sampled`] with [`GRID`] divisions.
pub(crate) fn on_grid(net: &SepticTriangle) -> PatchSamples {
    static USUAL: LazyLock<ParameterGrid<36>> = LazyLock::new(|| ParameterGrid::lattice(GRID));
    let mut points = vec![DVec3::ZERO; USUAL.parameters().len()];
    let mut normals = points.clone();
    USUAL.points_and_area_normals(net, &mut points, &mut normals);
    (points, normals)
}

/// [`deviation`] of other patches: `sample` returns those of a face on a grid with so many
/// divisions.
pub(crate) fn deviation_of(
    count: usize,
    sample: impl Fn(FaceId, usize) -> PatchSamples + Sync,
    target: &dyn SurfaceTarget,
    diagonal: f64,
) -> (Deviation, FaceMap<FaceDeviation>) {
    let mut faces = FaceMap::from_fn(count, |face| compare(sample(face, GRID), target));
    let grid = settle_with(&mut faces, |face, grid| compare(sample(face, grid), target));
    (summarise(&faces, diagonal, grid), faces)
}

/// Doubles the divisions for the worst patches until the largest values settle; returns the last
/// number of divisions.
pub(crate) fn settle(
    faces: &mut FaceMap<FaceDeviation>,
    nets: &FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
) -> usize {
    settle_with(faces, |face, grid| compare(sampled(&nets[face], grid), target))
}

fn settle_with(
    faces: &mut FaceMap<FaceDeviation>,
    on_grid: impl Fn(FaceId, usize) -> FaceDeviation + Sync,
) -> usize {
    let mut grid = GRID;
    while grid < FINEST_GRID {
        grid *= 2;
        let before = largest(faces);
        *faces = faces.map(|face, coarse| {
            // with equality, so that a surface without any deviation is done
            if coarse.max <= CANDIDATES * before.0 && coarse.max_normal <= CANDIDATES * before.1 {
                return *coarse;
            }
            coarse.refined_by(&on_grid(face, grid))
        });
        let after = largest(faces);
        if after.0 <= SETTLED * before.0 && after.1 <= SETTLED * before.1 {
            break;
        }
    }
    grid
}

/// Largest distance and largest normal angle.
fn largest(faces: &FaceMap<FaceDeviation>) -> (f64, f64) {
    let all = faces.as_slice();
    (
        all.iter().map(|face| face.max).fold(0.0, f64::max),
        all.iter().map(|face| face.max_normal).fold(0.0, f64::max),
    )
}

impl FaceDeviation {
    /// These figures with the extremes of a finer grid; the means stay.
    fn refined_by(&self, finer: &Self) -> Self {
        Self {
            max: self.max.max(finer.max),
            max_normal: self.max_normal.max(finer.max_normal),
            folded: self.folded || finer.folded,
            failed: self.failed.max(finer.failed),
            ..*self
        }
    }
}

fn compare((points, normals): PatchSamples, target: &dyn SurfaceTarget) -> FaceDeviation {
    let mut feet: Vec<Option<Foot>> = vec![None; points.len()];
    target.feet(&points, &mut feet);
    let mut result = FaceDeviation {
        max: 0.0,
        max_normal: 0.0,
        folded: false,
        failed: 0,
        area: 0.0,
        square_distance: 0.0,
        square_angle: 0.0,
    };
    for ((point, normal), foot) in points.into_iter().zip(normals).zip(feet) {
        let Some(foot) = foot else {
            result.failed += 1;
            result.max = f64::INFINITY;
            continue;
        };
        let distance = point.distance(foot.point);
        let along = normal.dot(foot.normal);
        let angle = normal.cross(foot.normal).length().atan2(along);
        let weight = normal.length();
        result.max = result.max.max(distance);
        result.max_normal = result.max_normal.max(angle);
        result.folded |= along.is_nan() || along <= 0.0;
        result.area += weight;
        result.square_distance += weight * distance * distance;
        result.square_angle += weight * angle * angle;
    }
    result
}

fn summarise(faces: &FaceMap<FaceDeviation>, diagonal: f64, grid: usize) -> Deviation {
    let (mut area, mut distance, mut angle) = (0.0, 0.0, 0.0);
    let mut summary = Deviation {
        diagonal,
        max: 0.0,
        rms: 0.0,
        max_normal_deg: 0.0,
        rms_normal_deg: 0.0,
        worst_face: 0,
        folded: Vec::new(),
        failed_samples: 0,
        grid,
    };
    for (face, measure) in faces.iter() {
        if measure.max / diagonal > summary.max {
            summary.max = measure.max / diagonal;
            summary.worst_face = face.index();
        }
        summary.max_normal_deg = summary.max_normal_deg.max(measure.max_normal.to_degrees());
        summary.failed_samples += measure.failed;
        if measure.folded {
            summary.folded.push(face.index());
        }
        area += measure.area;
        distance += measure.square_distance;
        angle += measure.square_angle;
    }
    summary.rms = (distance / area).sqrt() / diagonal;
    summary.rms_normal_deg = (angle / area).sqrt().to_degrees();
    summary
}

/// Whether the normal somewhere turns by 90° from the patch's own mean normal.
pub(crate) fn turns_over(net: &SepticTriangle) -> bool {
    let (_, normals) = on_grid(net);
    let mean: DVec3 = normals.iter().sum();
    !normals.iter().all(|normal| normal.dot(mean) > 0.0)
}

/// Patches whose normal somewhere turns by more than 90° from the patch's own mean normal: folds
/// that can be seen without knowing the target.
#[must_use]
pub fn folded_patches(nets: &FaceMap<SepticTriangle>) -> Vec<FaceId> {
    let folded = nets.map(|_, net| turns_over(net));
    folded.iter().filter(|(_, folded)| **folded).map(|(face, _)| face).collect()
}
