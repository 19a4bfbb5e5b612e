//! Smooth solids: A-patches over an inner hull of a polyhedron \[BCX94\].

mod checks;
mod conditions;
mod cubic;
mod dofs;
mod energy;
mod error;
mod fill;
mod flat_face;
mod guards;
mod hull;
mod kkt;
mod merge;
mod middle_weights;
mod points;
mod polyhedron;
mod quintic;
mod rays;
mod report;
mod settings;
mod signs;
mod skeleton;
mod solids;
mod surface;
mod tessellate;

pub use checks::{Finding, Margins};
pub use error::{HullError, PolyhedronError};
pub use hull::{Cell, Hull, HullEdge, HullTriangle, Split};
pub use points::SurfacePoint;
pub use polyhedron::{Facet, Planarity, Polyhedron};
pub use rays::{HullTree, Place};
pub use report::{FairnessReport, Report};
pub use settings::{FairnessSettings, HullSettings, Scheme, Settings, ShapeControl};
pub use skeleton::{PointOrigin, Skeleton, SkeletonTriangle, TriangleOrigin};
pub use solids::SOLID_NAMES;
pub use surface::{CellJet, Curvatures, PolyhedralSurface};
pub use tessellate::Sampled;
