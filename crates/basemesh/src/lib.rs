#![cfg_attr(feature = "polygonize", doc = include_str!("../README.md"))]
#![cfg_attr(
    not(feature = "polygonize"),
    doc = "Triangle meshes as base meshes of spline surfaces; see the README."
)]

mod build;
mod fan;
#[cfg(feature = "polygonize")]
mod field_target;
mod ids;
mod improve;
mod maps;
mod mesh;
#[cfg(feature = "polygonize")]
mod polygonize;
mod quality;
mod remesh;
mod simplify;
mod target;
mod topology;

pub use build::TopologyError;
pub use fan::Fan;
#[cfg(feature = "polygonize")]
pub use field_target::FieldTarget;
pub use glam;
pub use ids::{EdgeId, FaceId, HalfedgeId, VertexId};
pub use improve::{
    ImproveError, ImproveReport, ImproveSettings, Improved, SplitError, improve, split_edges,
};
pub use maps::{EdgeMap, FaceMap, HalfedgeMap, VertexMap};
pub use mesh::{MeshError, TriMesh};
#[cfg(feature = "polygonize")]
pub use polygonize::{
    Polygonization, PolygonizeError, PolygonizeSettings, TopologyCount, cells_for_faces,
    polygonize, polygonize_to_faces,
};
pub use quality::{MeshQuality, edge_turning, invalid_fans, triangle_quality};
pub use remesh::{RemeshError, RemeshSettings, remesh};
pub use simplify::{
    Refusals, Relaxation, Simplified, SimplifyError, SimplifyReport, SimplifySettings, simplify,
};
pub use target::{Foot, SurfaceTarget};
pub use topology::Topology;
