#![doc = include_str!("../README.md")]

pub mod measure;

mod adapt;
mod again;
mod agreement;
pub mod apatch_surface;
mod assembly;
mod curves;
mod error;
mod folds;
mod memory;
pub mod mesh_surface;
pub mod nagata_surface;
mod objectives;
pub mod pictures;
mod pipeline;
mod progress;
mod reconcile;
mod region;
mod repair;
mod report;
#[cfg(feature = "io")]
pub mod scene;
mod settings;
#[cfg(feature = "io")]
pub mod solid_surface;
mod source;
mod surface;

pub use adapt::{Adaptation, Distance, Tolerance, fit_dense_mesh_to_tolerance, fit_to_tolerance};
pub use apatch;
pub use basemesh;
pub use bezier_core;
pub use error::FitError;
pub use g1_triangular;
pub use hermite_sqp;
pub use implicit;
#[cfg(feature = "io")]
pub use io;
pub use meshfield;
pub use nagata;
pub use objectives::Retreat;
pub use pipeline::{fit, fit_base_mesh, fit_dense_mesh, fit_source};
pub use progress::{Progress, Silent, Stage, StageTimes};
pub use region::find_region;
pub use render;
pub use report::{BaseMeshReport, Report, report, report_sharp};
pub use settings::{BaseMeshSettings, Method, SecondForms, Settings};
pub use source::{FieldSource, FitSource};
pub use surface::{BaseMeshOrigin, CurveSummary, G1Surface, Polygonized, Rim};
