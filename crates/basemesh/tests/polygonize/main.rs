//! Promises of the polygonizer: closed manifold meshes, all components, honest errors.
#![cfg(feature = "polygonize")]

mod accuracy;
mod cost;
mod errors;
mod fields;
mod invariance;
mod random;
mod resolution;
mod topology;
