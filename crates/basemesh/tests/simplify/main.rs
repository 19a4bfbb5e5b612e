//! Simplification to base meshes: topology, guards, quality, reproducibility.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests, and tables for humans")]

mod improve;
mod reproducible;
#[cfg(feature = "polygonize")]
mod shapes;
mod support;
mod topology;
