//! Whether a patch folds over.

use bezier_core::{Barycentric, Corner};
use glam::DVec3;

use crate::surface::Patch;
use crate::triangle::NagataTriangle;

/// Divisions of the lattice of points that are looked at: more where corrections may change the normal
/// within a small part of the patch.
const DIVISIONS: usize = 4;
const CORRECTED_DIVISIONS: usize = 8;

impl Patch {
    /// Whether the normal points away from `flat` somewhere, as far as is looked at.
    pub(crate) fn is_folded(&self, flat: DVec3) -> bool {
        if let Self::Triangle(patch) = self
            && faces(patch, flat)
        {
            return false;
        }
        let divisions =
            if matches!(self, Self::TangentPlane(_)) { CORRECTED_DIVISIONS } else { DIVISIONS };
        let quad = matches!(self, Self::Quad(_));
        let step = |k: usize| k as f64 / divisions as f64;
        let last = |i: usize| if quad { divisions } else { divisions - i };
        let mut lattice =
            (0..=divisions).flat_map(|i| (0..=last(i)).map(move |j| [step(i), step(j)]));
        lattice.any(|at| self.normal(at).is_some_and(|normal| normal.dot(flat) < 0.0))
    }
}

/// Whether the normal points to the side of `flat` on the whole patch for certain: its six Bézier
/// coefficients do.
fn faces(patch: &NagataTriangle, flat: DVec3) -> bool {
    // derivatives from the last corner to the other two, at each corner
    let [a, b, c] = Corner::ALL.map(|corner| {
        let [d0, d1, d2] = patch.partials(Barycentric::at(corner));
        [d0 - d2, d1 - d2]
    });
    let at_corner = |[u, v]: [DVec3; 2]| u.cross(v).dot(flat);
    let between = |[u, v]: [DVec3; 2], [s, t]: [DVec3; 2]| (u.cross(t) + s.cross(v)).dot(flat);
    [at_corner(a), at_corner(b), at_corner(c), between(a, b), between(b, c), between(c, a)]
        .into_iter()
        .all(|coefficient| coefficient > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One edge bows far into the triangle, while the other two keep the corners regular.
    #[test]
    fn folds_between_the_corners_are_found() {
        let patch = |bow: f64| NagataTriangle {
            corners: [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1.0, 0.0)],
            curvature: [DVec3::X * -0.5, DVec3::X * 0.5, DVec3::Y * -bow],
        };
        for corner in Corner::ALL {
            assert!(patch(3.0).corner_normal(corner).is_some_and(|n| n.z > 0.0), "{corner:?}");
        }
        assert!(Patch::Triangle(patch(3.0)).is_folded(DVec3::Z));
        assert!(!Patch::Triangle(patch(1.0)).is_folded(DVec3::Z));
        assert!(faces(&patch(0.5), DVec3::Z), "certain without samples");
    }
}
