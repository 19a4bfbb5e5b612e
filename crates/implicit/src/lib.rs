#![doc = include_str!("../README.md")]

mod aabb;
mod closure;
mod curvature;
mod expression;
mod field;
mod formula;
mod interval;
mod jet;
mod jet1;
mod jet2;
mod level;
mod number;
mod project;
mod shapes;

pub use glam;

pub use crate::aabb::{Aabb, InvalidAabb};
pub use crate::closure::Closure;
pub use crate::curvature::{PrincipalCurvatures, SingularPoint, SurfacePoint, surface_point};
pub use crate::expression::Expression;
pub use crate::field::{
    BoundedField, FieldJet, ImplicitField, ImplicitSurface, TwiceDifferentiable,
};
pub use crate::formula::{Formula, FormulaError, FormulaErrorKind};
pub use crate::interval::Interval;
pub use crate::jet1::Jet1;
pub use crate::jet2::Jet2;
pub use crate::level::Level;
pub use crate::number::Number;
pub use crate::project::{
    ProjectionError, ProjectionSettings, project, project_many, project_with_gradient,
};
pub use crate::shapes::{
    Chair, Deccube, Dodecahedron, DoubleTorus, Ellipsoid, McMullen, NamedShape, Plane, Quadric,
    Sphere, Torus, catalogue,
};
