//! How far patches are from a known surface.

use smoothpatch::bezier_core::{Barycentric, LocalEdge};
use smoothpatch::nagata::glam::DVec3;
use smoothpatch::nagata::{NagataSurface, Patch};
use testkit::polygons::KnownSurface;

pub(super) struct Errors {
    pub(super) distance: f64,
    /// In radians.
    pub(super) angle: f64,
    /// Number of samples at which the normal points to the other side.
    pub(super) reversed: usize,
}

/// Points and normals at the lattice with this many divisions.
fn samples(patch: &Patch, divisions: usize) -> Vec<(DVec3, Option<DVec3>)> {
    let lattice = || Barycentric::lattice(divisions);
    match patch {
        Patch::Triangle(p) => lattice().map(|at| (p.point(at), p.normal(at))).collect(),
        Patch::TangentPlane(p) => lattice().map(|at| (p.point(at), p.normal(at))).collect(),
        Patch::Quad(p) => {
            let steps = 0..=divisions;
            let at = steps.clone().flat_map(|i| steps.clone().map(move |j| [i, j]));
            at.map(|at| at.map(|k| k as f64 / divisions as f64))
                .map(|at| (p.point(at), p.normal(at)))
                .collect()
        }
    }
}

/// Of the first `faces` patches, at the lattice with this many divisions.
pub(super) fn errors(
    surface: &NagataSurface,
    faces: usize,
    truth: &KnownSurface,
    divisions: usize,
) -> Errors {
    let mut worst = Errors { distance: 0.0, angle: 0.0, reversed: 0 };
    for face in surface.mesh().faces().take(faces) {
        for (point, normal) in samples(&surface.patch(face), divisions) {
            let distance = (truth.distance)(point).abs();
            worst.distance = worst_of(worst.distance, distance);
            if let Some(normal) = normal {
                let exact = (truth.normal)(point);
                let angle = normal.cross(exact).length().atan2(normal.dot(exact));
                worst.angle = worst.angle.max(angle);
                worst.reversed += usize::from(normal.dot(exact) < 0.0);
            }
        }
    }
    worst
}

/// Number of patches with a reversed normal that are not reported as folded and none of whose edges
/// says that the construction failed there.
pub(super) fn reversed_without_report(
    surface: &NagataSurface,
    truth: &KnownSurface,
    divisions: usize,
) -> usize {
    let mesh = surface.mesh();
    let silent = mesh.faces().filter(|face| {
        let patch = surface.patch(*face);
        let reversed = samples(&patch, divisions)
            .into_iter()
            .any(|(point, normal)| normal.is_some_and(|n| n.dot((truth.normal)(point)) < 0.0));
        reversed
            && !surface.patch_report(*face).folded
            && !fails_at_an_edge(&patch)
            && !mesh.sides(*face).any(|side| surface.join(mesh.edge(side)).is_failure())
    });
    silent.count()
}

/// Also at edges of one patch only, which join nothing.
fn fails_at_an_edge(patch: &Patch) -> bool {
    let Patch::TangentPlane(patch) = patch else { return false };
    LocalEdge::ALL.into_iter().any(|edge| {
        let status = patch.correction_status(edge);
        status.inflection || status.rejected
    })
}

/// The larger one; not a number if one of them is none, which `max` would lose.
fn worst_of(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
