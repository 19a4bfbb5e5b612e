#![doc = include_str!("../README.md")]

mod bernstein;
mod cubic_root;
mod hierarchy;
mod linear_program;
mod min_norm;
mod ray;
mod segment_polynomial;
mod tessellate;
mod tetrahedron;
mod unfold;

pub mod polyhedral;
pub mod rational;

pub use basemesh;
pub use cubic_root::RayCubic;
pub use glam;
pub use hierarchy::Hierarchy;
pub use ray::{Ray, RayHit};
pub use segment_polynomial::SegmentPolynomial;
pub use tessellate::{Element, PatchKind, Tessellation};
pub use tetrahedron::Tetrahedron;
