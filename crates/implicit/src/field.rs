//! The traits of a scalar field: value and gradient, Hessian, enclosure.

use glam::{DMat3, DVec3};

use crate::aabb::Aabb;
use crate::interval::Interval;

/// Value, gradient and Hessian of a field at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FieldJet {
    /// The value f.
    pub value: f64,
    /// The gradient ∇f.
    pub gradient: DVec3,
    /// The Hessian ∇∇f; symmetric bit for bit.
    pub hessian: DMat3,
}

/// A scalar field whose zero set is the surface: negative inside, positive outside.
///
/// The three ways to the value (here, in [`value_gradient`](Self::value_gradient) and in
/// [`TwiceDifferentiable::jet`]) and the batch methods agree bit for bit in every field of this
/// crate; implementors outside should keep that.
/// Where the field is undefined (the square root of a negative number) the value is NaN, and where
/// it has no derivative the gradient is not finite: [`project`](crate::project()) and
/// [`surface_point`](crate::surface_point) turn both into errors.
pub trait ImplicitField: Sync {
    /// The value at `p`.
    fn value(&self, p: DVec3) -> f64;

    /// The value and the exact gradient at `p`.
    fn value_gradient(&self, p: DVec3) -> (f64, DVec3);

    /// The values at many points, `out[i]` belonging to `points[i]`.
    ///
    /// # Panics
    /// If the two slices differ in length.
    fn values(&self, points: &[DVec3], out: &mut [f64]) {
        assert_same_length(points, out);
        for (out, &p) in out.iter_mut().zip(points) {
            *out = self.value(p);
        }
    }

    /// The values and gradients at many points, `out[i]` belonging to `points[i]`.
    ///
    /// # Panics
    /// If the two slices differ in length.
    fn value_gradients(&self, points: &[DVec3], out: &mut [(f64, DVec3)]) {
        assert_same_length(points, out);
        for (out, &p) in out.iter_mut().zip(points) {
            *out = self.value_gradient(p);
        }
    }
}

/// A field with its exact, symmetric Hessian; never a silent finite difference.
pub trait TwiceDifferentiable: ImplicitField {
    /// Value, gradient and Hessian at `p`.
    fn jet(&self, p: DVec3) -> FieldJet;

    /// The jets at many points, `out[i]` belonging to `points[i]`.
    ///
    /// # Panics
    /// If the two slices differ in length.
    fn jets(&self, points: &[DVec3], out: &mut [FieldJet]) {
        assert_same_length(points, out);
        for (out, &p) in out.iter_mut().zip(points) {
            *out = self.jet(p);
        }
    }
}

/// A field that can be enclosed over a box, so that a cell without surface is discarded with
/// certainty.
pub trait BoundedField: ImplicitField {
    /// An interval that contains every value that [`ImplicitField::value`] returns at a point of
    /// `region` where it is not NaN; rounding is outward.
    ///
    /// The width shrinks at least in proportion to the box where the field is smooth.
    /// [`Interval::ENTIRE`] means that nothing is known.
    fn enclosure(&self, region: &Aabb) -> Interval;

    /// Intervals that contain the three components of every gradient that
    /// [`ImplicitField::value_gradient`] returns at a point of `region` where it is not NaN; rounding
    /// is outward.
    ///
    /// They also contain all slopes: with these intervals as a vector G, the exact f(q) − f(p) lies in
    /// G · (q − p) for any p and q in `region` between which the field is defined throughout.
    /// At a kink (of `abs`, `min`, `max`) that means the hull of the gradients on both sides; at a
    /// jump or a pole, and for fields that know nothing about their gradient, all three are
    /// [`Interval::ENTIRE`].
    fn gradient_enclosure(&self, region: &Aabb) -> [Interval; 3] {
        let _ = region;
        [Interval::ENTIRE; 3]
    }

    /// Intervals that contain the second derivatives xx, yy, zz, xy, yz, zx of every Hessian that
    /// [`TwiceDifferentiable::jet`] returns at a point of `region` where they are not NaN; rounding is
    /// outward.
    ///
    /// They also contain all slopes of the gradient: with these intervals as a symmetric matrix H, the
    /// exact ∇f(q) − ∇f(p) lies in H (q − p) for any p and q in `region` between which the field is
    /// defined throughout.
    /// The width shrinks at least in proportion to the box where the field is smooth.
    /// At a kink (of `abs`, `min`, `max`), a jump or a pole, the second derivatives across it are
    /// [`Interval::ENTIRE`], and for fields that know nothing about their Hessian all six are.
    fn hessian_enclosure(&self, region: &Aabb) -> [Interval; 6] {
        let _ = region;
        [Interval::ENTIRE; 6]
    }
}

/// All that the surface pipeline needs: derivatives and enclosure.
///
/// Implemented for everything that is both [`TwiceDifferentiable`] and [`BoundedField`].
pub trait ImplicitSurface: TwiceDifferentiable + BoundedField {}

impl<F: TwiceDifferentiable + BoundedField + ?Sized> ImplicitSurface for F {}

/// Batch methods share this check: a silent truncation would leave stale numbers in `out`.
pub(crate) fn assert_same_length<A, B>(points: &[A], out: &[B]) {
    assert_eq!(points.len(), out.len(), "as many results as points are needed");
}

macro_rules! forward_to_pointee {
    ($($pointer:ty),*) => {$(
        impl<F: ImplicitField + ?Sized> ImplicitField for $pointer {
            fn value(&self, p: DVec3) -> f64 {
                (**self).value(p)
            }
            fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
                (**self).value_gradient(p)
            }
            fn values(&self, points: &[DVec3], out: &mut [f64]) {
                (**self).values(points, out);
            }
            fn value_gradients(&self, points: &[DVec3], out: &mut [(f64, DVec3)]) {
                (**self).value_gradients(points, out);
            }
        }

        impl<F: TwiceDifferentiable + ?Sized> TwiceDifferentiable for $pointer {
            fn jet(&self, p: DVec3) -> FieldJet {
                (**self).jet(p)
            }
            fn jets(&self, points: &[DVec3], out: &mut [FieldJet]) {
                (**self).jets(points, out);
            }
        }

        impl<F: BoundedField + ?Sized> BoundedField for $pointer {
            fn enclosure(&self, region: &Aabb) -> Interval {
                (**self).enclosure(region)
            }
            fn gradient_enclosure(&self, region: &Aabb) -> [Interval; 3] {
                (**self).gradient_enclosure(region)
            }
            fn hessian_enclosure(&self, region: &Aabb) -> [Interval; 6] {
                (**self).hessian_enclosure(region)
            }
        }
    )*};
}

forward_to_pointee!(&F, Box<F>);
