//! A fourth story: from a solid with planar faces to a smooth surface that rounds it off.
//!
//! ```text
//! file or name ──solid──> Polyhedron ──> PolyhedralSurface ──grid, weights──> files
//! ```

mod files;
mod weights;

pub use files::{SolidError, curvature_grid, mesh_of, solid};
pub use weights::{WeightsError, read_weights, write_weights};
