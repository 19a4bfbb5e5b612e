//! Convexity of edges and faces, from the normals at the vertices alone.

use basemesh::{EdgeId, EdgeMap, FaceId, TriMesh, VertexMap};
use glam::DVec3;

use super::block::EdgeBlock;

/// One of the two sides of the triangulation.
///
/// The normals point to the positive side. On the negative side everything is done as on the
/// positive one with the signs of the function reversed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// Where the normals point to.
    Positive,
    /// The other one.
    Negative,
}

impl Side {
    /// Both sides, the positive one first.
    pub const BOTH: [Self; 2] = [Self::Positive, Self::Negative];

    /// 1 or -1.
    #[inline]
    #[must_use]
    pub const fn sign(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }

    /// 0 or 1, as a place in an array.
    #[inline]
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// Convexity of an edge or a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Convexity {
    /// The surface lies on the positive side.
    Positive,
    /// The surface lies on the negative side.
    Negative,
    /// The surface is on both sides.
    Nonconvex,
    /// The surface is the edge or the face itself.
    Zero,
}

impl Convexity {
    /// Whether the surface has a part on this side.
    #[inline]
    #[must_use]
    pub const fn has(self, side: Side) -> bool {
        match self {
            Self::Positive => matches!(side, Side::Positive),
            Self::Negative => matches!(side, Side::Negative),
            Self::Nonconvex => true,
            Self::Zero => false,
        }
    }

    /// Of a face whose edges have these \[XHB01 2.2\].
    #[must_use]
    pub(crate) fn of_face(edges: [Self; 3]) -> Self {
        if edges.iter().all(|&e| e == Self::Zero) {
            Self::Zero
        } else if edges.iter().all(|&e| matches!(e, Self::Positive | Self::Zero)) {
            Self::Positive
        } else if edges.iter().all(|&e| matches!(e, Self::Negative | Self::Zero)) {
            Self::Negative
        } else {
            Self::Nonconvex
        }
    }
}

/// An edge by the weights next to its ends: `[e_ab, e_ba]` with `a` its lower vertex,
/// `e_ab = (p_b - p_a)·n_a / 3`; its convexity; and the block of all weights next to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeData {
    pub(crate) weights: [f64; 2],
    pub(crate) convexity: Convexity,
    pub(crate) block: EdgeBlock,
}

/// Every edge; weights that count as zero are zero \[XHB01 2.2\].
pub(crate) fn edges(
    mesh: &TriMesh,
    normals: &VertexMap<DVec3>,
    straight: f64,
) -> EdgeMap<EdgeData> {
    EdgeMap::from_fn(mesh.topology().edge_count(), |edge| {
        let ends = sorted_ends(mesh, edge);
        let (points, normals) = (ends.map(|v| mesh.position(v)), ends.map(|v| normals[v]));
        let chord = points[1] - points[0];
        let weight = |direction: DVec3, normal: DVec3| {
            let height = direction.dot(normal);
            let lengths = direction.length_squared() * normal.length_squared();
            if height * height <= straight * straight * lengths { 0.0 } else { height / 3.0 }
        };
        let weights = [weight(chord, normals[0]), weight(-chord, normals[1])];
        let convexity = match weights {
            [0.0, 0.0] => Convexity::Zero,
            [x, y] if x <= 0.0 && y <= 0.0 => Convexity::Positive,
            [x, y] if x >= 0.0 && y >= 0.0 => Convexity::Negative,
            _ => Convexity::Nonconvex,
        };
        EdgeData { weights, convexity, block: EdgeBlock::new(points, normals, weights) }
    })
}

/// Ends of an edge, the lower vertex first (the canonical half-edge of a boundary may run down).
pub(crate) fn sorted_ends(mesh: &TriMesh, edge: EdgeId) -> [basemesh::VertexId; 2] {
    let [a, b] = mesh.topology().edge_vertices(edge);
    if a < b { [a, b] } else { [b, a] }
}

/// Convexity of a face.
#[inline]
pub(crate) fn of_face(mesh: &TriMesh, edges: &EdgeMap<EdgeData>, face: FaceId) -> Convexity {
    let topology = mesh.topology();
    Convexity::of_face(face.halfedges().map(|h| edges[topology.edge(h)].convexity))
}
