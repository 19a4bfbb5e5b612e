#![doc = include_str!("../README.md")]

mod blend;
mod creases;
mod cut;
mod error;
mod field;
mod fit;
mod jet;
mod plain;
mod polynomial;
mod rings;
mod settings;
mod subdivide;
mod tree;

pub use basemesh;
pub use bezier_core;
pub use creases::{SharpEdges, sharp_edges};
pub use cut::{CutMesh, cut_open};
pub use error::JetError;
pub use field::MeshField;
pub use fit::fit_jets;
pub use glam;
pub use implicit;
pub use jet::{FitQuality, VertexJet};
pub use settings::JetSettings;
pub use subdivide::subdivided;
pub use tree::{ClosestPoint, TriangleTree};
