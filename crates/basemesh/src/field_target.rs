//! The zero set of an implicit function as a target surface.

use glam::DVec3;
use implicit::{ImplicitField, ProjectionSettings, project_many, project_with_gradient};

use crate::target::{Foot, SurfaceTarget};

/// Points at which the field is evaluated together for linear feet; these need no heap.
const BATCH: usize = 16;

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
        let mut values = [(0.0, DVec3::ZERO); BATCH];
        for (points, feet) in points.chunks(BATCH).zip(feet.chunks_mut(BATCH)) {
            let values = &mut values[..points.len()];
            self.field.value_gradients(points, values);
            for ((foot, &point), &mut (value, gradient)) in feet.iter_mut().zip(points).zip(values)
            {
                let slope = gradient.length();
                let inverse = slope.recip();
                let usable = slope.is_finite() && inverse.is_finite() && value.is_finite();
                let normal = gradient * inverse;
                let point = point - normal * (value * inverse);
                *foot = usable.then_some(Foot { point, normal });
            }
        }
    }
}
