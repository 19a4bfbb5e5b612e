//! Bézier triangles as patches to draw.

use basemesh::glam::{DVec2, DVec3};
use basemesh::{FaceId, FaceMap};
use bezier_core::{Barycentric, BezierTriangle, ParametricPatch, SurfaceJet};
use render::{Domain, Hit, Patches, SurfacePoint};

use super::CurvedPatches;

/// Bézier triangles, one for each face, with their own normals.
#[derive(Clone, Copy, Debug)]
pub struct NetPatches<'a, const P: usize>(pub &'a FaceMap<BezierTriangle<DVec3, P>>);

fn barycentric(at: DVec2) -> Barycentric {
    Barycentric::new(at.x, at.y)
}

impl<const P: usize> Patches for NetPatches<'_, P> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn domain(&self, _: usize) -> Domain {
        Domain::Triangle
    }

    fn point(&self, patch: usize, at: DVec2) -> DVec3 {
        self.0[FaceId::new(patch)].eval(barycentric(at))
    }

    fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint {
        let at = barycentric(at);
        let [a, b, c] = self.0[FaceId::new(patch)].last_triangle(at);
        let degree = BezierTriangle::<DVec3, P>::DEGREE as f64;
        let (du, dv) = ((a - c) * degree, (b - c) * degree);
        let point = a * at.u + b * at.v + c * at.w;
        SurfacePoint { point, normal: du.cross(dv), du, dv }
    }
}

impl<const P: usize> CurvedPatches for NetPatches<'_, P> {
    fn mean_curvature(&self, hit: &Hit) -> Option<f64> {
        let jet = self.0[FaceId::new(hit.patch)].jet(barycentric(hit.at));
        jet.surface_jet().map(|jet| mean(&jet))
    }
}

/// Half the trace of the second fundamental form.
fn mean(jet: &SurfaceJet) -> f64 {
    let form = jet.second_fundamental_form;
    0.5 * (form.x_axis.x + form.y_axis.y + form.z_axis.z)
}
