//! What several test suites of the workspace share: conformance checks, fields and base meshes.

pub mod conformance;
pub mod fields;
pub mod meshes;
mod numbers;
pub mod polygons;
pub mod solids;

pub use numbers::Numbers;
