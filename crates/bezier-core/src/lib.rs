#![doc = include_str!("../README.md")]

mod barycentric;
mod bernstein;
mod coefficient;
mod continuity;
mod curve;
mod jet;
mod least_squares;
mod local_edge;
mod multi_index;
mod parameter_grid;
mod patch;
mod point_map;
mod tetrahedron;
mod tile;
mod triangle;
mod turning;
#[cfg(feature = "simd")]
mod vector_block;

pub use barycentric::Barycentric;
pub use bernstein::{MAX_DEGREE, bernstein, binomial};
pub use coefficient::Coefficient;
pub use continuity::Seam;
pub use curve::{BezierCurve, CurveJet, QuarticCurve, SepticCurve};
pub use glam;
pub use jet::{FundamentalForm, PatchJet, SurfaceJet};
pub use least_squares::damped_least_squares;
pub use local_edge::{Corner, LocalEdge};
pub use multi_index::MultiIndex;
pub use parameter_grid::ParameterGrid;
pub use patch::ParametricPatch;
pub use point_map::PointMap;
pub use tetrahedron::{BezierTetrahedron, CubicTetrahedron, QuinticTetrahedron, TetrahedralIndex};
pub use triangle::{
    BezierTriangle, CubicTriangle, LinearTriangle, QuadraticTriangle, QuarticTriangle,
    QuinticTriangle, SepticTriangle,
};
pub use turning::Turning;
