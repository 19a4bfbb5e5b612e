//! Where the pipeline gets its geometry from: an implicit surface as a target and as a source of
//! second-order data.

use basemesh::glam::DVec3;
use basemesh::{FieldTarget, Foot, SurfaceTarget, VertexId};
use bezier_core::SurfaceJet;
use g1_triangular::SecondOrderData;
use implicit::{ImplicitSurface, ProjectionSettings, surface_point};

/// A surface that curves and patches can be fitted to: feet of points near it, and second-order
/// data at the vertices of a mesh on it.
pub trait FitSource: SurfaceTarget + SecondOrderData {}

impl<T: SurfaceTarget + SecondOrderData> FitSource for T {}

/// The zero set of an implicit function.
#[derive(Clone, Copy)]
pub struct FieldSource<'a> {
    field: &'a dyn ImplicitSurface,
    target: FieldTarget<'a>,
}

impl<'a> FieldSource<'a> {
    /// The zero set of `field`; `length` is the diagonal of its bounding box, which the projection
    /// tolerance is relative to.
    #[must_use]
    pub fn new(
        field: &'a dyn ImplicitSurface,
        length: f64,
        projection: ProjectionSettings,
    ) -> Self {
        Self { field, target: FieldTarget::new(field, length, projection) }
    }
}

impl std::fmt::Debug for FieldSource<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FieldSource").field("target", &self.target).finish_non_exhaustive()
    }
}

impl SurfaceTarget for FieldSource<'_> {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        self.target.foot(near)
    }

    fn feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        self.target.feet(points, feet);
    }

    fn linear_feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        self.target.linear_feet(points, feet);
    }
}

impl SecondOrderData for FieldSource<'_> {
    fn surface_jet(&self, _: VertexId, position: DVec3) -> Option<SurfaceJet> {
        let at = surface_point(self.field, position).ok()?;
        Some(SurfaceJet {
            point: position,
            normal: at.normal,
            second_fundamental_form: at.second_fundamental_form,
        })
    }
}
