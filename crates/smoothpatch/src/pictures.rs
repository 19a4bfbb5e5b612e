//! Surfaces as pictures show them: patches of nets and cells of files.

#[cfg(feature = "io")]
mod grid;
mod nets;
#[cfg(feature = "io")]
mod polynomial;
mod range;

use render::{Hit, Patches};

#[cfg(feature = "io")]
pub use grid::GridPatches;
pub use nets::NetPatches;
pub use range::{deviation_scale, symmetric_scale, values};

/// Patches whose curvature is known.
pub trait CurvedPatches: Patches {
    /// Mean of the two principal curvatures, negative on convex parts; unit: 1 / length. `None` where
    /// there is none.
    fn mean_curvature(&self, hit: &Hit) -> Option<f64>;
}
