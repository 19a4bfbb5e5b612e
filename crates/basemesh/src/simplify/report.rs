//! What a simplification did and why it may have stopped early.

use thiserror::Error;

use crate::ids::VertexId;
use crate::improve::guard::Refusal;

/// Why a mesh cannot be simplified as asked.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SimplifyError {
    /// The mesh has a boundary.
    #[error("edge {a}-{b} has one face only; close the surface first")]
    Open {
        /// Lower end of the first boundary edge.
        a: usize,
        /// Higher end.
        b: usize,
    },
    /// Closed triangle meshes have an even number of faces.
    #[error(
        "a closed triangle mesh cannot have {faces} faces, the number is always even; \
         ask for {below} or {above}"
    )]
    OddFaces {
        /// Faces asked for.
        faces: usize,
        /// The even number below.
        below: usize,
        /// The even number above.
        above: usize,
    },
    /// Fewer faces than a mesh of this topology can have.
    #[error(
        "{faces} faces cannot keep {components} components of Euler characteristic {euler} in all; \
         ask for at least {needed}"
    )]
    TooFewFaces {
        /// Faces asked for.
        faces: usize,
        /// Smallest number of faces of a mesh of this topology.
        needed: usize,
        /// Connected components of the input.
        components: usize,
        /// Euler characteristic of the input.
        euler: i64,
    },
}

/// How often the guards refused a collapse, by reason; an edge counts each time it is tried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Refusals {
    /// The surface would not stay a manifold of the same topology.
    pub link: usize,
    /// A vertex would have too few edges.
    pub valence: usize,
    /// No surface point was found near the merged vertex.
    pub foot: usize,
    /// A face would lean away from the surface.
    pub orientation: usize,
    /// A face would turn over.
    pub flip: usize,
    /// A triangle would become a sliver.
    pub quality: usize,
    /// The surface would turn too far along an edge.
    pub turning: usize,
}

impl Refusals {
    pub(super) fn count(&mut self, refusal: Refusal) {
        let counter = match refusal {
            Refusal::Link => &mut self.link,
            Refusal::Valence => &mut self.valence,
            Refusal::Foot => &mut self.foot,
            Refusal::Orientation => &mut self.orientation,
            Refusal::Flip => &mut self.flip,
            Refusal::Quality => &mut self.quality,
            Refusal::Turning => &mut self.turning,
        };
        *counter += 1;
    }
}

/// How far the guards had to give way to reach the number of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Relaxation {
    /// All guards held.
    #[default]
    None,
    /// Vertices of valence 3 were allowed.
    Valence,
    /// ... and triangles of less than half the quality, and faces that lean farther.
    Quality,
    /// ... and edges along which the surface turns by up to one and a half times as much.
    Turning,
    /// ... and any change that keeps the topology and the orientation.
    Everything,
}

/// What a simplification did.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SimplifyReport {
    /// Faces of the input.
    pub faces_before: usize,
    /// Faces of the result.
    pub faces: usize,
    /// Whether more faces are left than asked for, although the guards were relaxed. The mesh is
    /// usable.
    pub stalled: bool,
    /// Guards that had to give way.
    pub relaxation: Relaxation,
    /// Refused collapses.
    pub refusals: Refusals,
    /// Rounds that moved vertices to where the surface turned too far along an edge.
    pub exchanges: usize,
    /// Edges flipped.
    pub flips: usize,
    /// Vertices moved by smoothing.
    pub moves: usize,
    /// Euler characteristic of the input.
    pub euler_before: i64,
    /// Euler characteristic of the result; always the same.
    pub euler: i64,
    /// Largest angle between the surface normals at the ends of an edge, degrees.
    pub max_turning_deg: f64,
    /// Smallest angle of a triangle, degrees.
    pub min_angle_deg: f64,
    /// Vertices around which patches will fold, see [`invalid_fans`](crate::invalid_fans).
    pub invalid_fans: Vec<VertexId>,
    /// Vertices near which no surface point was found. They keep their place, and their normals are
    /// those of the faces around them.
    pub off_surface: Vec<VertexId>,
}
