//! How far a point of a patch is from the sides of the patch.

use glam::DVec2;

use crate::domain::Domain;
use crate::patches::{Patches, SurfacePoint};

/// Distance along the surface from a point to the nearest side that is drawn, to first order; infinite
/// if there is none.
pub(crate) fn distance(
    patches: &dyn Patches,
    patch: usize,
    at: DVec2,
    point: &SurfacePoint,
) -> f64 {
    let domain: Domain = patches.domain(patch);
    let (uu, uv, vv) =
        (point.du.length_squared(), point.du.dot(point.dv), point.dv.length_squared());
    let determinant = uu * vv - uv * uv;
    let sides = (0..domain.corners().len()).filter(|&side| patches.has_edge(patch, side));
    let distances = sides.map(|side| {
        let (value, g) = domain.inward(side, at);
        // length of the gradient on the surface
        let square = (vv * g.x * g.x - 2.0 * uv * g.x * g.y + uu * g.y * g.y) / determinant;
        value.abs() / square.sqrt()
    });
    // where the derivatives are parallel there is no distance, and the comparison is false
    distances.fold(f64::INFINITY, |nearest, next| if next < nearest { next } else { nearest })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// A plane with sheared parameters.
    struct Plane;

    impl Patches for Plane {
        fn count(&self) -> usize {
            1
        }
        fn domain(&self, _: usize) -> Domain {
            Domain::Triangle
        }
        fn point(&self, _: usize, at: DVec2) -> DVec3 {
            DVec3::new(6.0 * at.x + at.y, 4.0 * at.y, 0.0)
        }
        fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint {
            SurfacePoint {
                point: self.point(patch, at),
                normal: DVec3::Z,
                du: DVec3::new(6.0, 0.0, 0.0),
                dv: DVec3::new(1.0, 4.0, 0.0),
            }
        }
        fn has_edge(&self, _: usize, side: usize) -> bool {
            side == 0
        }
    }

    #[test]
    fn it_is_the_distance_to_the_line() {
        let at = DVec2::new(0.3, 0.2);
        let found = distance(&Plane, 0, at, &Plane.surface_point(0, at));
        assert!((found - 0.8).abs() < 1e-14, "{found}");
    }
}
