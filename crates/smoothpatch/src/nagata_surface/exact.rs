//! C0 surfaces as polynomial patches, for files that hold them exactly.

use basemesh::glam::DVec3;
use io::{PatchSurface, PatchSurfaceError, Polygon};
use nagata::{NagataQuad, NagataSurface, Patch};
use thiserror::Error;

/// Why a surface has no polynomial patches.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ExactError {
    /// The patches are rational.
    #[error("patches with common tangent planes are no polynomials")]
    Rational,
    /// The patches are no surface.
    #[error(transparent)]
    Surface(#[from] PatchSurfaceError),
}

/// The patches of a C0 surface: quadratic triangles, and quadrilaterals that are quadratic in each
/// direction.
///
/// # Errors
///
/// [`ExactError`]; `Rational` for every surface with common tangent planes.
pub fn patch_surface(surface: &NagataSurface) -> Result<PatchSurface, ExactError> {
    let mesh = surface.mesh();
    let (mut faces, mut nets) = (Vec::new(), Vec::new());
    for face in mesh.faces() {
        let corners: Vec<usize> = mesh.corners(face).iter().map(|v| v.index()).collect();
        faces.push(Polygon::new(&corners).expect("invariant: a face has three or four corners"));
        match surface.patch(face) {
            Patch::Triangle(patch) => nets.extend_from_slice(patch.bezier().net()),
            Patch::Quad(patch) => nets.extend(quad_net(&patch)),
            Patch::TangentPlane(_) => return Err(ExactError::Rational),
        }
    }
    Ok(PatchSurface::new(2, faces, nets)?)
}

/// Control points in rows from the first side to the opposite one.
fn quad_net(patch: &NagataQuad) -> [DVec3; 9] {
    let [p0, p1, p2, p3] = patch.corners;
    let [c0, c1, c2, c3] = patch.curvature;
    // as in a triangle, so that neighbours have the same bits
    let middle = |a: DVec3, b: DVec3, curvature: DVec3| (a + b - curvature) * 0.5;
    let centre = ((p0 + p1 + p2 + p3) - (c0 + c1 + c2 + c3)) * 0.25;
    let [bottom, right, top, left] =
        [middle(p0, p1, c0), middle(p1, p2, c1), middle(p2, p3, c2), middle(p3, p0, c3)];
    [p0, bottom, p1, left, centre, right, p3, top, p2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use bezier_core::bernstein;

    #[test]
    fn the_net_is_the_patch() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.1, 0.3], [1.8, 1.5, 0.0], [-0.2, 1.0, 0.4]];
        let curvature = [[0.1, 0.2, 0.4], [0.0, -0.3, 0.2], [0.3, 0.1, 0.1], [0.0, 0.0, -0.5]];
        let patch = NagataQuad {
            corners: corners.map(DVec3::from_array),
            curvature: curvature.map(DVec3::from_array),
        };
        let net = quad_net(&patch);
        for [eta, zeta] in [[0.0, 0.0], [0.3, 0.8], [1.0, 0.5], [0.7, 1.0], [0.5, 0.5]] {
            let (by_eta, by_zeta): ([f64; 3], [f64; 3]) = (bernstein(eta), bernstein(zeta));
            let point: DVec3 = (0..9).map(|k| net[k] * (by_eta[k % 3] * by_zeta[k / 3])).sum();
            let distance = point.distance(patch.point([eta, zeta]));
            assert!(distance < 8.0 * f64::EPSILON * 2.0, "[{eta}, {zeta}]: {distance}");
        }
    }
}
