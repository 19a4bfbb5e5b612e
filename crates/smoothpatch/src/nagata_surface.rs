//! The other story: from a mesh with normals to a curved surface, nothing fitted.
//!
//! ```text
//! Polygons ──mesh──> PolygonMesh ──normals──> CornerNormals ──> NagataSurface ──report──> files
//! ```

#[cfg(feature = "io")]
mod exact;
#[cfg(feature = "io")]
mod files;
#[cfg(feature = "io")]
mod from_polygons;
mod report;

#[cfg(feature = "io")]
pub use exact::{ExactError, patch_surface};
#[cfg(feature = "io")]
pub use files::{
    CurvedGrid, chord_tessellation, curved_grid, curved_mesh, flat_gap, polygons, samples,
};
#[cfg(feature = "io")]
pub use from_polygons::{NagataError, NormalSource, Tips, from_polygons, from_polygons_with_tips};
pub use report::{EdgeFlaw, NagataFigures, NagataReport, report};
