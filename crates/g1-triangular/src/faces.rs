//! How half-edges of the mesh and edges of a patch correspond.

use basemesh::{FaceId, HalfedgeId};
use bezier_core::{Corner, LocalEdge, MultiIndex};

/// The half-edges of a face in the order of [`LocalEdge::ALL`]: corner `k` of the face is corner
/// `k` of its patch.
pub(crate) fn corner_halfedges(face: FaceId) -> [HalfedgeId; 3] {
    face.halfedges()
}

/// The edge of a patch along a half-edge of its face.
pub(crate) fn local_edge(h: HalfedgeId) -> LocalEdge {
    LocalEdge::starting_at(Corner::ALL[h.corner()])
}

/// Whether a control point lies on no edge of the net.
pub(crate) fn is_inner(m: MultiIndex) -> bool {
    m.i > 0 && m.j > 0 && m.k > 0
}
