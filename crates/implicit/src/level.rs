//! Another level of a field as a field of its own.

use glam::DVec3;

use crate::aabb::Aabb;
use crate::field::{BoundedField, FieldJet, ImplicitField, TwiceDifferentiable};
use crate::interval::Interval;

/// The field f − c, whose zero set is the level set f = c of [`field`](Self::field).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Level<F> {
    /// The field f.
    pub field: F,
    /// The level c, in the units of f.
    pub level: f64,
}

impl<F: ImplicitField> ImplicitField for Level<F> {
    fn value(&self, p: DVec3) -> f64 {
        self.field.value(p) - self.level
    }

    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let (value, gradient) = self.field.value_gradient(p);
        (value - self.level, gradient)
    }

    fn values(&self, points: &[DVec3], out: &mut [f64]) {
        self.field.values(points, out);
        for value in out {
            *value -= self.level;
        }
    }

    fn value_gradients(&self, points: &[DVec3], out: &mut [(f64, DVec3)]) {
        self.field.value_gradients(points, out);
        for (value, _) in out {
            *value -= self.level;
        }
    }
}

impl<F: TwiceDifferentiable> TwiceDifferentiable for Level<F> {
    fn jet(&self, p: DVec3) -> FieldJet {
        let jet = self.field.jet(p);
        FieldJet { value: jet.value - self.level, ..jet }
    }

    fn jets(&self, points: &[DVec3], out: &mut [FieldJet]) {
        self.field.jets(points, out);
        for jet in out {
            jet.value -= self.level;
        }
    }
}

impl<F: BoundedField> BoundedField for Level<F> {
    fn enclosure(&self, region: &Aabb) -> Interval {
        self.field.enclosure(region) - self.level
    }

    fn gradient_enclosure(&self, region: &Aabb) -> [Interval; 3] {
        self.field.gradient_enclosure(region)
    }

    fn hessian_enclosure(&self, region: &Aabb) -> [Interval; 6] {
        self.field.hessian_enclosure(region)
    }
}
