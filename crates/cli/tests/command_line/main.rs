//! The program as its users meet it: the built binary, run in a temporary directory.
#![allow(clippy::unwrap_used, reason = "in tests, also in their helpers")]

mod apatch;
mod bad_input;
mod check;
mod fit;
mod formats;
mod help;
mod meshes;
mod nagata;
mod nagata_bad_input;
mod query;
mod render;
mod shapes;
mod solids;
mod workplace;
