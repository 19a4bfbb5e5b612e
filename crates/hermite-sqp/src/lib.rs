#![doc = include_str!("../README.md")]

mod free_tangents;
mod gradients;
mod kkt;
mod outcome;
mod problem;
mod refine;
mod settings;
mod solve;
mod start;

pub use bezier_core;
pub use outcome::{EdgeOutcome, EdgeStatus, FallbackReason};
pub use problem::{CurveSample, EdgeProblem, EdgeProblemError};
pub use refine::{CurveFoot, FindFeet, MOST_FEET, Refined, refine};
pub use settings::{CurveRefinement, Settings};
pub use solve::solve;
