//! Why a mesh has no jets.

use glam::DVec3;
use thiserror::Error;

/// Why there are no jets. Vertices and faces count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum JetError {
    /// A degree that is not offered.
    #[error("jets of degree {degree} are not offered; take 2 to {largest}")]
    Degree {
        /// What was asked for.
        degree: usize,
        /// The largest one.
        largest: usize,
    },
    /// The faces around a vertex have no mean normal: they fold back, or have no area.
    #[error("the faces around vertex {vertex}, {at}, fold back on each other or have no area")]
    NoNormal {
        /// The vertex.
        vertex: usize,
        /// Its position.
        at: DVec3,
    },
    /// Distances around a vertex are too large or too small for numbers.
    #[error("the distances of the neighbours of vertex {vertex}, {at}, are not finite numbers")]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// Its position.
        at: DVec3,
    },
    /// A face without area, on which no surface can be blended.
    #[error("face {face} at {at} has no area")]
    FlatFace {
        /// The face.
        face: usize,
        /// One of its corners.
        at: DVec3,
    },
}
