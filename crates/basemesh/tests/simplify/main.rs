//! Simplification to base meshes: topology, guards, quality, reproducibility.

mod reproducible;
mod shapes;
mod support;
mod topology;
