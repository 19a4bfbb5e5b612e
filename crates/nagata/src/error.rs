//! What nobody can work with.

use glam::DVec3;
use thiserror::Error;

/// Why positions and faces do not make a mesh.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There is nothing to build from.
    #[error("the mesh has no faces")]
    Empty,
    /// More elements than 32-bit ids can number.
    #[error("the mesh has {faces} faces and {vertices} vertices; at most {max} are supported")]
    TooLarge {
        /// Faces given.
        faces: usize,
        /// Vertices given.
        vertices: usize,
        /// Largest number of each.
        max: usize,
    },
    /// A face that is neither a triangle nor a quadrilateral.
    #[error("face {face} has {corners} corners; only 3 and 4 are supported, split it")]
    Corners {
        /// Index of the face.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} uses vertex {vertex}, but there are only {count} vertices")]
    MissingVertex {
        /// Index of the face.
        face: usize,
        /// The missing vertex.
        vertex: usize,
        /// Number of vertices.
        count: usize,
    },
    /// A face uses a vertex twice.
    #[error("face {face} uses vertex {vertex} more than once")]
    RepeatedVertex {
        /// Index of the face.
        face: usize,
        /// The repeated vertex.
        vertex: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has the position {position}, which is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// New positions that are not one for each vertex.
    #[error("{given} positions given; the mesh has {expected} vertices")]
    Positions {
        /// Positions given.
        given: usize,
        /// Number of vertices.
        expected: usize,
    },
}

/// Why normals do not fit a mesh.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NormalsError {
    /// Another number of normals, or of corners with normals, than the mesh has.
    #[error("{given} {what} for a mesh that has {expected}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// Number given.
        given: usize,
        /// Number in the mesh.
        expected: usize,
    },
    /// A normal that is zero, infinite or not a number.
    #[error("normal {index} is {normal}; it must be finite and not zero")]
    NotUsable {
        /// Index of the normal.
        index: usize,
        /// Its value.
        normal: DVec3,
    },
    /// A corner names a normal that does not exist.
    #[error(
        "corner {corner} of face {face} uses normal {normal}, but there are only {count} normals"
    )]
    MissingNormal {
        /// Index of the face.
        face: usize,
        /// The corner, counted from 0.
        corner: usize,
        /// The missing normal.
        normal: usize,
        /// Number of normals.
        count: usize,
    },
    /// More normals than 32-bit ids can number.
    #[error("{given} normals; at most {max} are supported")]
    TooMany {
        /// Normals given.
        given: usize,
        /// Largest number.
        max: usize,
    },
}

/// Why a mesh with normals does not make the surface that was asked for.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// New positions do not fit the mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The normals belong to another mesh.
    #[error(transparent)]
    Normals(#[from] NormalsError),
    /// Common tangent planes are only defined for triangles.
    #[error(
        "face {face} is a quadrilateral; common tangent planes need triangles, split the \
         quadrilaterals or ask for continuity of position"
    )]
    Quadrilateral {
        /// Index of the first such face.
        face: usize,
    },
    /// A setting that is not a number or has the wrong sign.
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
