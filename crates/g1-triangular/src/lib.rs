#![doc = include_str!("../README.md")]

mod construct;
mod earlier;
mod edge_system;
mod error;
mod faces;
mod fill;
mod interior;
mod network;
mod normal_fit;
mod plan;
mod residual;
mod samples;
mod second_order;
mod tangent_planes;
mod vertex_system;
mod weights;

pub use basemesh;
pub use bezier_core;
pub use construct::{SmoothPatches, join, join_reusing};
pub use earlier::{Earlier, Nothing};
pub use edge_system::EdgeRows;
pub use error::JoinError;
pub use fill::{PositionalPatch, PositionalPatches, fill, fill_reusing};
pub use network::CurveNetwork;
pub use plan::{Fill, InnerPoints, Plan, Rows, Settings};
pub use residual::g1_residual;
pub use second_order::SecondOrderData;
pub use weights::EdgeWeights;
