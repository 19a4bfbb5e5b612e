#![doc = include_str!("../README.md")]

mod along;
mod area;
mod base_patch;
mod blend;
mod corner_normals;
mod correction;
mod curvature_parameter;
mod edge_blocks;
mod edge_curve;
mod edge_table;
mod error;
mod fold;
mod groups;
mod ids;
mod join;
mod lanes;
mod polygon_mesh;
mod quad;
mod query;
mod report;
mod sample;
mod settings;
mod singular_terms;
mod status_byte;
mod surface;
mod tangent_continuous;
mod triangle;
mod triangle_batch;
mod turning_normal;
mod unit;
mod widest;

pub use area::Area;
pub use basemesh;
pub use bezier_core;
pub use corner_normals::CornerNormals;
pub use correction::CorrectionStatus;
pub use curvature_parameter::{
    CurvatureParameter, EdgeNormals, EdgeStatus, Lowering, curvature_parameter, end_misfit,
};
pub use edge_curve::EdgeCurve;
pub use error::{MeshError, NormalsError, SurfaceError};
pub use glam;
pub use groups::{Apex, apexes};
pub use ids::{NormalId, Side};
pub use join::Join;
pub use polygon_mesh::PolygonMesh;
pub use quad::NagataQuad;
pub use query::{Aabb, Bounds, Closest, Hit, PatchPoint, Ray, SurfaceQueries};
pub use report::{EdgeReport, PatchReport, Report};
pub use settings::{Continuity, CorrectionSettings, EdgeSettings, Settings, TangentPlanes};
pub use surface::{NagataSurface, Patch};
pub use tangent_continuous::G1Triangle;
pub use triangle::NagataTriangle;
