//! Rational A-patches: a smooth surface through the vertices of a triangulation, with given or
//! estimated normals \[XHB01\].

mod apex;
mod base;
mod block;
mod build;
mod edge;
mod error;
mod face;
mod free_weight;
mod hull;
mod kinds;
mod lanes;
mod loop_step;
mod move_apices;
mod normals;
mod points;
mod rays;
mod repair;
mod report;
mod settings;
mod sheet;
mod surface;
mod tessellate;
mod transversals;
mod validity;

pub use base::{BaseLayer, Split};
pub use edge::{EdgePatch, EdgeSide, FaceShare};
pub use error::SurfaceError;
pub use face::{FacePatch, FaceSide};
pub use kinds::{Convexity, Side};
pub use loop_step::loop_step;
pub use normals::{cone_normals, loop_limit_normals};
pub use points::SurfacePoint;
pub use rays::{Cell, Located, RationalHull};
pub use repair::Normals;
pub use report::{InvalidEdge, KindCounts, NormalsUsed, Report};
pub use settings::{
    ApexSettings, FreeWeightRule, RepairSettings, Settings, ShapeControl, SheetSettings,
};
pub use surface::RationalSurface;
pub use validity::Wedge;
