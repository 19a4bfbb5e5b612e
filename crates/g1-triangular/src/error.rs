//! What cannot be joined smoothly.

use thiserror::Error;

/// Why patches could not be joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum JoinError {
    /// The construction needs two faces at every edge.
    #[error("edge {edge} lies on a boundary; only closed surfaces can be joined smoothly yet")]
    OpenSurface {
        /// The edge id.
        edge: usize,
    },
    /// Neighbouring curves leave a vertex in directions that do not determine the weights of the
    /// smoothness condition: three of them are parallel, or a tangent has no length.
    #[error(
        "the curves around vertex {vertex} do not fan out in its tangent plane; refine the base \
         mesh there"
    )]
    DegenerateFan {
        /// The vertex id.
        vertex: usize,
    },
}
