//! Why there is no surface.

use basemesh::glam::DVec3;
use basemesh::{PolygonizeError, RemeshError, SimplifyError, SplitError};
use g1_triangular::JoinError;
use hermite_sqp::EdgeProblemError;
use thiserror::Error;

/// Why no smooth surface could be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FitError {
    /// The field has no usable surface in the region.
    #[error(transparent)]
    Polygonize(#[from] PolygonizeError),
    /// The base mesh could not be made.
    #[error(transparent)]
    Simplify(#[from] SimplifyError),
    /// The base mesh could not be adapted.
    #[error(transparent)]
    Remesh(#[from] RemeshError),
    /// The base mesh could not be refined.
    #[error(transparent)]
    Refine(#[from] SplitError),
    /// Too small a distance is asked for, or no distance at all.
    #[error("the tolerance {value:e} is not a number of at least {smallest:e}")]
    DistanceTolerance {
        /// What was asked for.
        value: f64,
        /// The smallest that can be measured here, in the same unit.
        smallest: f64,
    },
    /// The angle asked for is not a positive number.
    #[error("the normal tolerance {degrees}° is not a positive number")]
    NormalTolerance {
        /// What was asked for.
        degrees: f64,
    },
    /// The surface has no normal or no curvature at a vertex.
    #[error(
        "the surface is singular at vertex {vertex}, {at}: its gradient vanishes there; \
         choose another level or keep this point out of the region"
    )]
    Singular {
        /// The vertex of the base mesh.
        vertex: usize,
        /// Its position.
        at: DVec3,
    },
    /// No curve can be fitted between two vertices.
    #[error("no curve between vertices {a} and {b} (edge {edge}): {reason}; use more faces")]
    Edge {
        /// The edge of the base mesh.
        edge: usize,
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
        /// Why.
        reason: EdgeProblemError,
    },
    /// The patches could not be joined.
    #[error(transparent)]
    Join(#[from] JoinError),
}
