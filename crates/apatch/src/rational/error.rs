//! What nobody can work with.

use glam::DVec3;
use thiserror::Error;

/// Why a mesh with normals does not make a surface.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// Another number of normals than the mesh has vertices.
    #[error("{given} normals for a mesh with {expected} vertices")]
    Count {
        /// Number of normals given.
        given: usize,
        /// Number of vertices.
        expected: usize,
    },
    /// A normal that is zero, infinite or not a number.
    #[error("the normal at vertex {vertex} is {normal}; it must be finite and not zero")]
    Normal {
        /// The vertex.
        vertex: usize,
        /// Its normal.
        normal: DVec3,
    },
    /// A face without area has no plane.
    #[error("face {face} has no area; remove it")]
    FlatFace {
        /// The face.
        face: usize,
    },
    /// The shape control names a face that does not exist.
    #[error("shape control for face {face}, but there are only {count} faces")]
    MissingFace {
        /// The missing face.
        face: usize,
        /// Number of faces.
        count: usize,
    },
    /// A setting that is not a number or out of range.
    #[error("the setting {name} is {value}; it must be {expected}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is accepted.
        expected: &'static str,
    },
}
