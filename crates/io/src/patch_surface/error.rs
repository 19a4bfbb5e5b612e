//! What can be wrong with a surface of patches.

use glam::DVec3;
use thiserror::Error;

/// Why patches do not form a surface. Faces and vertices count from 0.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PatchSurfaceError {
    /// A control point is infinite or not a number.
    #[error("control point {point} of face {face} is {position}, which is not finite")]
    NotFinite {
        /// The face.
        face: usize,
        /// Rank of the point in the net of the face.
        point: usize,
        /// The point.
        position: DVec3,
    },
    /// Two faces have different control points for one edge.
    #[error(
        "faces {} and {} disagree about control point {step} of edge {lower}-{higher}: {} against \
         {}; copy the boundary row of one to the other",
        faces[0], faces[1], positions[0], positions[1]
    )]
    Edge {
        /// The lower vertex of the edge.
        lower: usize,
        /// Its higher vertex.
        higher: usize,
        /// The point, from the lower vertex.
        step: usize,
        /// The faces, the lower first.
        faces: [usize; 2],
        /// What they say.
        positions: [DVec3; 2],
    },
    /// Two faces have different positions for one vertex.
    #[error(
        "faces {} and {} disagree about vertex {vertex}: {} against {}; copy the corner of one to \
         the other",
        faces[0], faces[1], positions[0], positions[1]
    )]
    Vertex {
        /// The vertex.
        vertex: usize,
        /// The faces, the lower first.
        faces: [usize; 2],
        /// What they say.
        positions: [DVec3; 2],
    },
    /// More than two faces at an edge.
    #[error(
        "edge {lower}-{higher} belongs to {faces} faces; a shell of a solid has at most two there: \
         take the surface apart"
    )]
    TooManyFaces {
        /// The lower vertex of the edge.
        lower: usize,
        /// Its higher vertex.
        higher: usize,
        /// Number of faces.
        faces: usize,
    },
    /// The two faces of an edge run through it in the same direction.
    #[error(
        "faces {} and {} are turned against each other at edge {lower}-{higher}; turn one of them \
         over",
        faces[0], faces[1]
    )]
    Turned {
        /// The lower vertex of the edge.
        lower: usize,
        /// Its higher vertex.
        higher: usize,
        /// The faces.
        faces: [usize; 2],
    },
}
