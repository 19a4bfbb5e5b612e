//! What a parametric surface patch over a triangle can be asked.

use glam::DVec3;

use crate::barycentric::Barycentric;
use crate::jet::PatchJet;

/// A smooth map from barycentric coordinates to space.
///
/// Smooth inside the triangle and usable slightly outside; pure, without allocation.
pub trait ParametricPatch {
    /// The point at these parameters.
    fn point(&self, at: Barycentric) -> DVec3;

    /// Point and derivatives to second order with respect to `(u, v)`, where `w = 1 - u - v`.
    fn jet(&self, at: Barycentric) -> PatchJet;
}
