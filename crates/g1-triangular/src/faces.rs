//! How half-edges of the mesh and edges of a patch correspond.

use basemesh::{FaceId, HalfedgeId, Topology};
use bezier_core::{Corner, LocalEdge};

/// The half-edges of a face in the order of [`LocalEdge::ALL`]: corner `k` of the face is corner
/// `k` of its patch.
pub(crate) fn corner_halfedges(face: FaceId) -> [HalfedgeId; 3] {
    face.halfedges()
}

/// The corner of a face with the lowest vertex. Patches are fitted from there, so that the same
/// bits come out however a file or an edit turns the face.
pub(crate) fn first_corner(topology: &Topology, face: FaceId) -> Corner {
    let [a, b, c] = topology.corners(face);
    if a < b && a < c {
        Corner::First
    } else if b < c {
        Corner::Second
    } else {
        Corner::Third
    }
}

/// The corner of the patch fitted from `first` that is the first one of the face.
pub(crate) fn back_to_face(first: Corner) -> Corner {
    match first {
        Corner::First => Corner::First,
        Corner::Second => Corner::Third,
        Corner::Third => Corner::Second,
    }
}

/// The edge of a patch along a half-edge of its face.
pub(crate) fn local_edge(h: HalfedgeId) -> LocalEdge {
    LocalEdge::starting_at(Corner::ALL[h.corner()])
}
