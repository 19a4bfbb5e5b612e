//! Patches as fine triangles on the screen, without cracks.
//!
//! A patch is divided until its triangles are nearer than [`TOLERANCE`] pixels. Sides are divided
//! after their own curve, which both neighbours know; where a patch is divided finer than a side, its
//! points on that side are moved to the coarser line. Patches outside the picture are not divided.

use glam::{DVec2, DVec3};

use crate::camera::Camera;
use crate::domain::Domain;
use crate::patches::Patches;

/// Largest distance from triangles to the point of the patch with the same parameters, in pixels.
const TOLERANCE: f64 = 0.03;
/// Divisions where the bending of a patch is measured.
pub(crate) const COARSE: usize = 8;
/// No patch is divided more finely; enough for any polynomial that fills a picture.
const FINEST: usize = 1024;

/// A patch with the places of its lattice points on the screen.
pub(crate) struct ScreenPatch {
    pub(crate) domain: Domain,
    pub(crate) divisions: usize,
    /// In the order of [`Domain::lattice`], as [`Camera::project`] gives them.
    pub(crate) points: Vec<DVec3>,
    /// Smallest and largest coordinate downwards.
    pub(crate) rows: [f64; 2],
}

impl ScreenPatch {
    /// `None` if a point is not finite; without points if the patch is outside a picture of this size.
    pub(crate) fn new(
        patches: &dyn Patches,
        patch: usize,
        camera: &Camera,
        size: DVec2,
    ) -> Option<Self> {
        let domain = patches.domain(patch);
        let place = |at: DVec2| camera.project(patches.point(patch, at));
        let coarse: Vec<DVec3> = domain.lattice(COARSE).map(place).collect();
        let bending = bending(domain, &coarse);
        if !bending.is_finite() || !coarse.iter().all(|point| point.is_finite()) {
            return None;
        }
        if is_outside(&coarse, bending, size) {
            let rows = [f64::INFINITY, f64::NEG_INFINITY];
            return Some(Self { domain, divisions: 0, points: Vec::new(), rows });
        }
        let sides = domain.corners().len();
        let of_sides: Vec<usize> =
            (0..sides).map(|side| side_divisions(domain, side, &coarse)).collect();
        let divisions = of_sides.iter().copied().fold(divisions_for(bending), usize::max);
        let mut points: Vec<DVec3> = domain.lattice(divisions).map(place).collect();
        if !points.iter().all(|point| point.is_finite()) {
            return None;
        }
        for (side, &of_side) in of_sides.iter().enumerate() {
            straighten(domain, divisions, side, of_side, &mut points);
        }
        let downwards = points.iter().map(|point| point.y);
        let rows = [
            downwards.clone().fold(f64::INFINITY, f64::min),
            downwards.fold(f64::NEG_INFINITY, f64::max),
        ];
        Some(Self { domain, divisions, points, rows })
    }

    /// Calls `f` with the lattice points of each triangle: their numbers and parameters.
    pub(crate) fn for_each_triangle(&self, mut f: impl FnMut([usize; 3], [DVec2; 3])) {
        let n = self.divisions;
        let step = 1.0 / n as f64;
        let corner = |i: usize, j: usize| {
            (self.domain.index(n, i, j), DVec2::new(i as f64, j as f64) * step)
        };
        let mut call = |corners: [(usize, DVec2); 3]| f(corners.map(|c| c.0), corners.map(|c| c.1));
        for j in 0..n {
            let last = self.domain.last_of_row(n, j);
            for i in 0..last {
                call([corner(i, j), corner(i + 1, j), corner(i, j + 1)]);
                if i < self.domain.last_of_row(n, j + 1) {
                    call([corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]);
                }
            }
        }
    }
}

/// Whether a patch with these points cannot be seen in the picture, even if it bends beyond them.
fn is_outside(coarse: &[DVec3], bending: f64, size: DVec2) -> bool {
    // between points at most the distance that was measured, and as much again to be safe
    let reach = size * 0.5 + 2.0 * bending;
    let places = || coarse.iter().copied().map(DVec3::truncate);
    let low = places().fold(DVec2::INFINITY, DVec2::min);
    let high = places().fold(DVec2::NEG_INFINITY, DVec2::max);
    low.cmpgt(reach).any() || high.cmplt(-reach).any()
}

/// The largest distance of the middle of a step from the point with the same parameters, for `COARSE`
/// divisions, in all directions of the lattice.
fn bending(domain: Domain, coarse: &[DVec3]) -> f64 {
    let n = COARSE;
    let at = |i: usize, j: usize| coarse[domain.index(n, i, j)];
    let mut largest: f64 = 0.0;
    for j in 0..=n {
        for i in 0..=domain.last_of_row(n, j) {
            if i >= 1 && i < domain.last_of_row(n, j) {
                largest = largest.max(second_difference(at(i - 1, j), at(i, j), at(i + 1, j)));
            }
            if j >= 1 && j < n && i <= domain.last_of_row(n, j + 1) {
                largest = largest.max(second_difference(at(i, j - 1), at(i, j), at(i, j + 1)));
            }
            if i >= 1 && j >= 1 && j < n && i < domain.last_of_row(n, j - 1) {
                largest =
                    largest.max(second_difference(at(i - 1, j + 1), at(i, j), at(i + 1, j - 1)));
            }
        }
    }
    largest / 8.0
}

fn side_divisions(domain: Domain, side: usize, coarse: &[DVec3]) -> usize {
    let at = |step| coarse[domain.along(COARSE, side, step)];
    let differences =
        (1..COARSE).map(|step| second_difference(at(step - 1), at(step), at(step + 1)));
    divisions_for(differences.fold(0.0, f64::max) / 8.0)
}

/// The same for both directions.
fn second_difference(before: DVec3, at: DVec3, after: DVec3) -> f64 {
    ((before + after) - at * 2.0).length()
}

/// A power of two; the distance falls with the square of the divisions.
fn divisions_for(coarse_distance: f64) -> usize {
    let mut divisions = 1;
    let mut distance = coarse_distance * (COARSE * COARSE) as f64;
    while distance > TOLERANCE && divisions < FINEST {
        divisions *= 2;
        distance /= 4.0;
    }
    divisions
}

/// Moves the points of a side to a line with fewer divisions.
fn straighten(domain: Domain, divisions: usize, side: usize, of_side: usize, points: &mut [DVec3]) {
    let ratio = divisions / of_side;
    for step in 0..divisions {
        let within = step % ratio;
        if within > 0 {
            let before = points[domain.along(divisions, side, step - within)];
            let after = points[domain.along(divisions, side, step - within + ratio)];
            let t = within as f64 / ratio as f64;
            points[domain.along(divisions, side, step)] = before * (1.0 - t) + after * t;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_cover_the_domain_once() {
        for domain in [Domain::Triangle, Domain::Square] {
            let divisions = 4;
            let points: Vec<DVec3> = domain.lattice(divisions).map(|p| p.extend(0.0)).collect();
            let patch = ScreenPatch { domain, divisions, points, rows: [0.0; 2] };
            let mut area = 0.0;
            patch.for_each_triangle(|ids, [a, b, c]| {
                let twice = (b - a).perp_dot(c - a);
                assert!(twice > 0.0, "counter-clockwise");
                assert_eq!(patch.points[ids[0]].truncate(), a, "the same point");
                area += 0.5 * twice;
            });
            let whole = if domain == Domain::Triangle { 0.5 } else { 1.0 };
            assert_eq!(area, whole, "{domain:?}");
        }
    }

    #[test]
    fn a_flat_patch_is_not_divided() {
        assert_eq!(divisions_for(0.0), 1);
        assert_eq!(divisions_for(TOLERANCE), COARSE);
    }
}
