//! Rust closures as fields.

use glam::DVec3;

use crate::aabb::Aabb;
use crate::field::{BoundedField, FieldJet, ImplicitField, TwiceDifferentiable};
use crate::interval::Interval;
use crate::jet2::Jet2;

/// A closure over [`Jet2`] as a field with exact gradient and Hessian.
///
/// Every evaluation computes the full jet, and all enclosures are [`Interval::ENTIRE`], because a
/// closure over one number type cannot be asked for another: where that matters, write an
/// [`Expression`](crate::Expression).
/// (A wrapper, because an implementation for every `Fn` would collide with those for references.)
///
/// ```
/// use implicit::glam::DVec3;
/// use implicit::{Closure, ImplicitField, Number};
///
/// let radius = 2.0;
/// let sphere = Closure::new(|[x, y, z]| x.square() + y.square() + z.square() - radius * radius);
/// assert_eq!(sphere.value_gradient(DVec3::X), (-3.0, DVec3::new(2.0, 0.0, 0.0)));
/// ```
#[derive(Clone, Copy)]
pub struct Closure<F>(F);

impl<F: Fn([Jet2; 3]) -> Jet2 + Sync> Closure<F> {
    /// The field that evaluates `f` on [`Jet2::variables`].
    pub const fn new(f: F) -> Self {
        Self(f)
    }

    #[inline]
    fn eval(&self, p: DVec3) -> Jet2 {
        (self.0)(Jet2::variables(p.to_array()))
    }
}

impl<F> std::fmt::Debug for Closure<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Closure")
    }
}

impl<F: Fn([Jet2; 3]) -> Jet2 + Sync> ImplicitField for Closure<F> {
    fn value(&self, p: DVec3) -> f64 {
        self.eval(p).value
    }

    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let jet = self.eval(p);
        (jet.value, DVec3::from_array(jet.gradient))
    }
}

impl<F: Fn([Jet2; 3]) -> Jet2 + Sync> TwiceDifferentiable for Closure<F> {
    fn jet(&self, p: DVec3) -> FieldJet {
        self.eval(p).into()
    }
}

impl<F: Fn([Jet2; 3]) -> Jet2 + Sync> BoundedField for Closure<F> {
    fn enclosure(&self, _region: &Aabb) -> Interval {
        Interval::ENTIRE
    }
}
