//! The zero set of an implicit function as a target surface.

use glam::DVec3;
use implicit::{ImplicitField, ProjectionSettings, project_many, project_with_gradient};

use crate::target::{Foot, SurfaceTarget};

/// The zero set of a field; feet are found by Newton steps along the gradient.
#[derive(Clone, Copy)]
pub struct FieldTarget<'a> {
    field: &'a dyn ImplicitField,
    length: f64,
    projection: ProjectionSettings,
}

impl<'a> FieldTarget<'a> {
    /// The zero set of `field`; `length` is the size of the whole surface (the diagonal of its
    /// bounding box), which the projection tolerance is relative to.
    #[must_use]
    pub fn new(field: &'a dyn ImplicitField, length: f64, projection: ProjectionSettings) -> Self {
        Self { field, length, projection }
    }
}

impl std::fmt::Debug for FieldTarget<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FieldTarget")
            .field("length", &self.length)
            .field("projection", &self.projection)
            .finish_non_exhaustive()
    }
}

impl SurfaceTarget for FieldTarget<'_> {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        project_with_gradient(self.field, near, self.length, &self.projection)
            .ok()
            .map(|(point, normal)| Foot { point, normal })
    }

    fn feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        assert_eq!(points.len(), feet.len(), "one foot per point");
        let mut moved = points.to_vec();
        let normals = project_many(self.field, &mut moved, self.length, &self.projection);
        for ((foot, point), normal) in feet.iter_mut().zip(moved).zip(normals) {
            *foot = normal.ok().map(|normal| Foot { point, normal });
        }
    }

    fn linear_feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        assert_eq!(points.len(), feet.len(), "one foot per point");
        let mut values = vec![(0.0, DVec3::ZERO); points.len()];
        self.field.value_gradients(points, &mut values);
        for ((foot, &point), (value, gradient)) in feet.iter_mut().zip(points).zip(values) {
            let slope = gradient.length();
            let usable = slope > 0.0 && slope.is_finite() && value.is_finite();
            let normal = gradient / slope;
            *foot = usable.then(|| Foot { point: point - normal * (value / slope), normal });
        }
    }
}
