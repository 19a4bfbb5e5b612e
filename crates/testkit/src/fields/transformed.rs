//! Fields whose surface is that of another one, moved or scaled.

use glam::{DMat3, DVec3};
use implicit::{
    Aabb, BoundedField, FieldJet, ImplicitField, ImplicitSurface, Interval, TwiceDifferentiable,
};

/// The field whose surface is that of another, turned and shifted: `f(Rᵀ (p - s))`.
#[derive(Clone, Copy)]
#[allow(missing_debug_implementations, reason = "fields cannot be printed")]
pub struct Moved<'a> {
    /// The field before the motion.
    pub field: &'a dyn ImplicitSurface,
    /// The rotation R.
    pub rotation: DMat3,
    /// The shift s.
    pub shift: DVec3,
}

impl Moved<'_> {
    /// Where the motion takes a point.
    #[must_use]
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.rotation * p + self.shift
    }

    fn back(&self, p: DVec3) -> DVec3 {
        self.rotation.transpose() * (p - self.shift)
    }
}

impl ImplicitField for Moved<'_> {
    fn value(&self, p: DVec3) -> f64 {
        self.field.value(self.back(p))
    }

    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let (value, gradient) = self.field.value_gradient(self.back(p));
        (value, self.rotation * gradient)
    }
}

impl TwiceDifferentiable for Moved<'_> {
    fn jet(&self, p: DVec3) -> FieldJet {
        let jet = self.field.jet(self.back(p));
        let hessian = self.rotation * jet.hessian * self.rotation.transpose();
        FieldJet {
            value: jet.value,
            gradient: self.rotation * jet.gradient,
            // a product of three matrices is symmetric only up to round-off
            hessian: (hessian + hessian.transpose()) * 0.5,
        }
    }
}

impl BoundedField for Moved<'_> {
    fn enclosure(&self, _: &Aabb) -> Interval {
        Interval::ENTIRE
    }
}

/// The field whose surface is `length` times as large as that of another and whose values are
/// `value` times as large: `value · f(p / length)`. Exact if both are powers of two.
#[derive(Clone, Copy)]
#[allow(missing_debug_implementations, reason = "fields cannot be printed")]
pub struct Scaled<'a> {
    /// The field before scaling.
    pub field: &'a dyn ImplicitSurface,
    /// Factor of all lengths.
    pub length: f64,
    /// Factor of the values.
    pub value: f64,
}

impl ImplicitField for Scaled<'_> {
    fn value(&self, p: DVec3) -> f64 {
        self.field.value(p / self.length) * self.value
    }

    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let (value, gradient) = self.field.value_gradient(p / self.length);
        (value * self.value, gradient * (self.value / self.length))
    }
}

impl TwiceDifferentiable for Scaled<'_> {
    fn jet(&self, p: DVec3) -> FieldJet {
        let jet = self.field.jet(p / self.length);
        FieldJet {
            value: jet.value * self.value,
            gradient: jet.gradient * (self.value / self.length),
            hessian: jet.hessian * (self.value / (self.length * self.length)),
        }
    }
}

impl BoundedField for Scaled<'_> {
    fn enclosure(&self, region: &Aabb) -> Interval {
        let part = Aabb { min: region.min / self.length, max: region.max / self.length };
        let Interval { lo, hi } = self.field.enclosure(&part);
        let (a, b) = (lo * self.value, hi * self.value);
        Interval::new(a.min(b), a.max(b))
    }
}
