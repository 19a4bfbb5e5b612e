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
mod patch;
mod tetrahedron;
mod triangle;
mod turning;

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
pub use patch::ParametricPatch;
pub use tetrahedron::{BezierTetrahedron, CubicTetrahedron, QuinticTetrahedron, TetrahedralIndex};
pub use triangle::{
    BezierTriangle, CubicTriangle, LinearTriangle, QuadraticTriangle, QuarticTriangle,
    QuinticTriangle, SepticTriangle,
};
pub use turning::Turning;
