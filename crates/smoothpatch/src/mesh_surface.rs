//! A triangle mesh as the surface to be fitted.

mod distances;
mod fit;
mod jets;
mod rims;
mod sharp;
mod source;

pub use distances::{Distances, MeshDistances, mesh_distances};
pub use fit::{MeshBase, fit_mesh_field};
pub use jets::{JetSummary, jet_summary};
pub use sharp::SharpMesh;
pub use source::{MeshSource, MeshSurfaceError, mesh_field};
