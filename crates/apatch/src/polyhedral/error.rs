//! What nobody can work with.

use basemesh::MeshError;
use glam::DVec3;
use thiserror::Error;

/// Why vertices and faces are not a solid. All numbers count from 0.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PolyhedronError {
    /// No faces.
    #[error("the solid has no faces")]
    Empty,
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has the position {position}, which is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} uses vertex {vertex}, but there are only {count} vertices")]
    MissingVertex {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: usize,
        /// Number of vertices.
        count: usize,
    },
    /// A loop of fewer than three corners.
    #[error("face {face} has a loop of {corners} corners; at least 3 are needed")]
    FewCorners {
        /// The face.
        face: usize,
        /// Corners of the loop.
        corners: usize,
    },
    /// A face without area.
    #[error("face {face} has no area; remove it")]
    NoArea {
        /// The face.
        face: usize,
    },
    /// A corner too far from the plane of its face.
    #[error(
        "face {face} is not planar: vertex {vertex} is {distance:.1e} diameters of the face away \
         from its plane; cut the face into planar ones"
    )]
    NotPlanar {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: usize,
        /// Distance from the plane in diameters of the face.
        distance: f64,
    },
    /// Two faces run through an edge in the same direction.
    #[error("faces {} and {} disagree about the orientation of edge {}-{}, or share it with others",
        faces[0], faces[1], vertices[0], vertices[1])]
    Orientation {
        /// The faces.
        faces: [usize; 2],
        /// Ends of the edge.
        vertices: [usize; 2],
    },
    /// An edge of one face only.
    #[error("edge {}-{} of face {face} has no face on its other side; the solid must be closed",
        vertices[0], vertices[1])]
    OpenEdge {
        /// The face.
        face: usize,
        /// Ends of the edge.
        vertices: [usize; 2],
    },
    /// Faces that meet in one point only.
    #[error("the faces around vertex {vertex} form several fans that meet only in this point")]
    NonManifoldVertex {
        /// The vertex.
        vertex: usize,
    },
    /// A vertex of only two edges.
    #[error("vertex {vertex} has {valence} edges; at least 3 are needed: remove it")]
    FewEdges {
        /// The vertex.
        vertex: usize,
        /// Number of its edges.
        valence: usize,
    },
    /// Two neighbouring faces in one plane, or an edge without length.
    #[error("faces {} and {} lie in one plane along edge {}-{}; merge them",
        faces[0], faces[1], vertices[0], vertices[1])]
    FlatEdge {
        /// The faces.
        faces: [usize; 2],
        /// Ends of the edge.
        vertices: [usize; 2],
    },
    /// The faces are oriented inwards.
    #[error("the solid has the volume {volume}; faces must be counter-clockwise seen from outside")]
    InsideOut {
        /// The signed volume.
        volume: f64,
    },
}

/// Why no hull of tetrahedra can be built over a solid. All numbers count from 0.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum HullError {
    /// No direction looks at all faces of a vertex from above.
    #[error(
        "no normal at vertex {vertex} sees all its faces from above; cut the corner off before"
    )]
    NoAboveNormal {
        /// The vertex.
        vertex: usize,
    },
    /// A corner of a face that no point of it sees from inside both edges, or, of a face with holes, that
    /// none of the points around the holes sees.
    #[error(
        "face {face} has a corner that no point sees from inside both its edges and joins to the \
         others; split the face into star-shaped ones"
    )]
    NoGuards {
        /// The face.
        face: usize,
    },
    /// The points that see the corners of a face cannot be joined without branches or crossings.
    #[error(
        "the corners of face {face} need several points inside to see them, and these only join to a \
         net with branches, which is not built; split the face into star-shaped ones"
    )]
    BranchingGuards {
        /// The face.
        face: usize,
    },
    /// A given guard that does not see a corner of its face, or is not inside its angle.
    #[error("the given guard of face {face} does not see its corner at vertex {vertex}")]
    BadGuard {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: usize,
    },
    /// Shape control for something that does not exist.
    #[error("shape control for {what} {index}, but there are only {count}")]
    Missing {
        /// Vertex or face.
        what: &'static str,
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// The guards do not form a triangulation, as where two faces share two edges.
    #[error("guards and corner points do not form a triangulation: {0} (points of the hull)")]
    Triangulation(MeshError),
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
