//! Base meshes for tests: regular ones, and random edits that make them irregular.

mod edit;
mod regular;

pub use edit::{Edit, apply_edits, jittered};
pub use regular::{icosphere, on_surface, radially_on_surface, refined, torus_grid};
