//! Why a file is not a mesh.

use std::io;

use basemesh::MeshError;
use glam::DVec3;
use thiserror::Error;

use crate::obj::ObjReadError;
use crate::off::OffReadError;

/// Why a file is not a triangle mesh. Vertices and faces count from 0 in the order of the file, the
/// triangles of an STL file as well; lines count from 1.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MeshFileError {
    /// The operating system failed.
    #[error("cannot read: {0}")]
    Io(#[from] io::Error),
    /// Neither name nor contents tell the format.
    #[error(
        "neither the name nor the contents are those of a mesh; known are .obj, .stl, .ply and .off"
    )]
    UnknownFormat,
    /// An OBJ file is damaged.
    #[error(transparent)]
    Obj(#[from] ObjReadError),
    /// An OFF file is damaged.
    #[error(transparent)]
    Off(#[from] OffReadError),
    /// A PLY file is damaged.
    #[error("{0}")]
    Ply(String),
    /// A PLY file without vertices or faces.
    #[error("the PLY file has no {missing}")]
    PlyWithout {
        /// What is missing.
        missing: &'static str,
    },
    /// A text STL file is damaged.
    #[error("line {line}: expected {expected}, found '{found}'")]
    StlText {
        /// Line in the file.
        line: usize,
        /// What should be there.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// A text STL file ends too early.
    #[error("the file ends where {expected} should follow")]
    StlEnd {
        /// What should be there.
        expected: &'static str,
    },
    /// A binary STL file is shorter than its number of triangles says.
    #[error("the STL file announces {triangles} triangles but ends in triangle {found}")]
    StlShort {
        /// What it says.
        triangles: u32,
        /// Whole triangles.
        found: usize,
    },
    /// There are no faces.
    #[error("there are no faces")]
    NoFaces,
    /// A face uses a vertex that does not exist.
    #[error("face {face} uses vertex {vertex}, but there are only {count} vertices")]
    MissingVertex {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: i64,
        /// Number of vertices.
        count: usize,
    },
    /// A face with one or two corners.
    #[error("face {face} has {corners} corners")]
    FewCorners {
        /// The face.
        face: usize,
        /// How many it has.
        corners: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has the position {position}, which is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// More than two faces at an edge.
    #[error(
        "the edge between vertices {a} and {b}, {at}, has {} faces ({}); at most two can meet", faces.len(),
        list(faces)
    )]
    NonManifoldEdge {
        /// One end.
        a: usize,
        /// The other end.
        b: usize,
        /// Its middle.
        at: DVec3,
        /// The faces.
        faces: Vec<usize>,
    },
    /// The faces around a vertex form several fans.
    #[error(
        "the faces around vertex {vertex}, {at}, meet only in this point; move the parts apart"
    )]
    NonManifoldVertex {
        /// The vertex.
        vertex: usize,
        /// Its position.
        at: DVec3,
    },
    /// No way of turning the faces makes all neighbours agree.
    #[error(
        "the surface has only one side: going round, the faces {first} and {second} disagree at the \
         edge between vertices {a} and {b}"
    )]
    OneSided {
        /// One end of the edge.
        a: usize,
        /// The other end.
        b: usize,
        /// One face.
        first: usize,
        /// The other face.
        second: usize,
    },
    /// Faces whose corners are on one line.
    #[error("{} faces have no area ({}): their corners are on one line", faces.len(), list(faces))]
    FlatFaces {
        /// The faces.
        faces: Vec<usize>,
    },
    /// A polygon that cannot be cut into triangles: it crosses itself or is flat.
    #[error("face {face} cannot be cut into triangles; its outline crosses itself or has no area")]
    NoTriangles {
        /// The face.
        face: usize,
    },
    /// What is left is not a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// The first numbers of many.
fn list(numbers: &[usize]) -> String {
    const NAMED: usize = 6;
    let mut names: Vec<String> = numbers.iter().take(NAMED).map(usize::to_string).collect();
    if numbers.len() > NAMED {
        names.push("…".to_owned());
    }
    names.join(", ")
}
