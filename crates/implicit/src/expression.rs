//! Formulas written in Rust, once, for every kind of number.

use crate::number::Number;

/// A formula in x, y, z, written once and evaluated over any [`Number`].
///
/// [`field_from_expression!`](crate::field_from_expression) makes it a field: value, gradient,
/// Hessian and enclosures all come from the one body.
///
/// ```
/// use implicit::glam::DVec3;
/// use implicit::{Expression, ImplicitField, Number, TwiceDifferentiable};
///
/// struct Capsule {
///     length: f64,
///     radius: f64,
/// }
///
/// impl Expression for Capsule {
///     fn eval<T: Number>(&self, [x, y, z]: [T; 3]) -> T {
///         let beyond = (z.abs() - 0.5 * self.length).max(T::constant(0.0));
///         x.square() + y.square() + beyond.square() - self.radius * self.radius
///     }
/// }
///
/// implicit::field_from_expression!(Capsule);
///
/// let capsule = Capsule { length: 4.0, radius: 1.0 };
/// let jet = capsule.jet(DVec3::new(0.0, 0.0, 3.0));
/// assert_eq!((jet.value, jet.gradient.z, jet.hessian.z_axis.z), (0.0, 2.0, 2.0));
/// ```
pub trait Expression {
    /// The formula at `p` = \[x, y, z\].
    fn eval<T: Number>(&self, p: [T; 3]) -> T;
}

/// Implements all field traits for types that implement [`Expression`].
#[macro_export]
macro_rules! field_from_expression {
    ($($shape:ty),+ $(,)?) => {$(
        impl $crate::ImplicitField for $shape {
            #[inline]
            fn value(&self, p: $crate::glam::DVec3) -> f64 {
                $crate::Expression::eval(self, p.to_array())
            }
            #[inline]
            fn value_gradient(&self, p: $crate::glam::DVec3) -> (f64, $crate::glam::DVec3) {
                let variables = $crate::Jet1::variables(p.to_array());
                let jet = $crate::Expression::eval(self, variables);
                (jet.value, $crate::glam::DVec3::from_array(jet.gradient))
            }
        }

        impl $crate::TwiceDifferentiable for $shape {
            #[inline]
            fn jet(&self, p: $crate::glam::DVec3) -> $crate::FieldJet {
                let variables = $crate::Jet2::variables(p.to_array());
                $crate::Expression::eval(self, variables).into()
            }
        }

        impl $crate::BoundedField for $shape {
            fn enclosure(&self, region: &$crate::Aabb) -> $crate::Interval {
                $crate::Expression::eval(self, region.intervals())
            }
            fn gradient_enclosure(&self, region: &$crate::Aabb) -> [$crate::Interval; 3] {
                let variables = $crate::Jet1::variables(region.intervals());
                $crate::Expression::eval(self, variables).gradient
            }
            fn hessian_enclosure(&self, region: &$crate::Aabb) -> [$crate::Interval; 6] {
                let variables = $crate::Jet2::variables(region.intervals());
                $crate::Expression::eval(self, variables).hessian
            }
        }
    )+};
}
