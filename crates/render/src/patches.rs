//! What can be drawn.

use glam::{DVec2, DVec3};

use crate::domain::Domain;

/// Curved patches, each a function of two parameters over a triangle or a square.
///
/// Neighbours are drawn without cracks if their common edge is the same curve with the same
/// parameter on both sides.
pub trait Patches: Sync {
    /// Number of patches.
    fn count(&self) -> usize;

    /// The parameters of a patch.
    fn domain(&self, patch: usize) -> Domain;

    /// Position at parameters of the patch.
    fn point(&self, patch: usize, at: DVec2) -> DVec3;

    /// Position, normal and first derivatives.
    fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint;

    /// Whether a side is drawn when edges are drawn. Side `s` begins at corner `s` of the domain.
    fn has_edge(&self, _patch: usize, _side: usize) -> bool {
        true
    }
}

/// A point of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub point: DVec3,
    /// Normal to the outer side, of any length; zero where there is none.
    pub normal: DVec3,
    /// Derivative in the first parameter.
    pub du: DVec3,
    /// Derivative in the second parameter.
    pub dv: DVec3,
}

/// A point of a patch that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Number of the patch.
    pub patch: usize,
    /// Parameters of the patch.
    pub at: DVec2,
    /// Position.
    pub point: DVec3,
    /// Unit normal to the outer side, or zero where there is none.
    pub normal: DVec3,
}
