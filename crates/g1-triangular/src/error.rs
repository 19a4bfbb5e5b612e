//! What cannot be joined smoothly.

use thiserror::Error;

/// Why patches could not be joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum JoinError {
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
