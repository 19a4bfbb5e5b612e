//! Base meshes for tests: regular ones, and random edits that make them irregular.

mod edit;
mod given;
mod regular;
mod voxels;

pub use edit::{Edit, apply_edits, jittered};
pub use given::{cushion, hyperboloid, mapped, noisy_sphere, two_triangles};
pub use regular::{icosphere, on_surface, radially_on_surface, refined, torus_grid};
pub use voxels::{double_torus, l_block, voxels};
