#![doc = include_str!("../README.md")]

mod construct;
mod edge_system;
mod error;
mod faces;
mod fill;
mod interior;
mod network;
mod plan;
mod residual;
mod samples;
mod second_order;
mod tangent_planes;
mod vertex_system;
mod weights;

pub use basemesh;
pub use bezier_core;
pub use construct::{SmoothPatches, join};
pub use error::JoinError;
pub use fill::{PositionalPatches, fill};
pub use network::CurveNetwork;
pub use plan::{Fill, InnerPoints, Plan, Rows, Settings};
pub use residual::g1_residual;
pub use second_order::SecondOrderData;
pub use weights::EdgeWeights;
