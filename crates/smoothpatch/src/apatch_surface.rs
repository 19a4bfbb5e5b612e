//! A third story: from a triangle mesh with normals to A-patches, the zero set of one smooth function.
//!
//! ```text
//! Polygons ──mesh, normals──> RationalSurface ──report──> Tessellation ──> files
//! ```

#[cfg(feature = "io")]
mod files;
#[cfg(feature = "io")]
mod from_polygons;
mod joints;
mod report;
mod samples;

#[cfg(feature = "io")]
pub use files::{flat_gap, grid, triangles};
#[cfg(feature = "io")]
pub use from_polygons::{NormalSource, RationalError, rational_surface};
pub use joints::{Joints, joints};
pub use report::{RationalFigures, RationalReport, SHEET_GRID, Sheet, report};
