//! Local refinement by splitting edges.

use std::collections::BTreeMap;

use glam::DVec3;
use thiserror::Error;

use crate::ids::{EdgeId, FaceId, VertexId};
use crate::mesh::{MeshError, TriMesh};
use crate::target::SurfaceTarget;

/// Why edges cannot be split.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SplitError {
    /// The mesh has no such edge.
    #[error("edge {edge} does not exist, there are {count} edges")]
    MissingEdge {
        /// The edge asked for.
        edge: usize,
        /// Number of edges.
        count: usize,
    },
    /// The surface was not found near the middle of an edge.
    #[error("no surface point near the middle of edge {a}-{b}; leave this edge out")]
    NoFoot {
        /// Lower end.
        a: usize,
        /// Higher end.
        b: usize,
    },
    /// The result would not be a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Cuts edges in two, and with them the faces on both sides.
///
/// The new vertices are the middles of the edges moved onto the surface; they follow the old
/// vertices, which keep their ids, in the order of edge ids. A face with several such edges is cut
/// from its longest one first (ties: the lower edge id), so that the result does not depend on the
/// order of `edges`. Repeated edges count once. Boundary edges are allowed.
///
/// # Errors
///
/// [`SplitError`], with the lowest offending edge. A surface point farther from the middle than half
/// the length of the edge counts as none.
pub fn split_edges(
    mesh: &TriMesh,
    target: &dyn SurfaceTarget,
    edges: &[EdgeId],
) -> Result<TriMesh, SplitError> {
    let mut middles: BTreeMap<EdgeId, usize> = edges.iter().map(|&e| (e, 0)).collect();
    let mut positions = mesh.positions().as_slice().to_vec();
    for (&edge, vertex) in &mut middles {
        *vertex = positions.len();
        positions.push(middle_on_surface(mesh, target, edge)?);
    }
    let mut faces = Vec::with_capacity(mesh.topology().face_count() + 2 * middles.len());
    for face in mesh.topology().faces() {
        cut(Piece::whole(mesh, face, &middles), &mut faces);
    }
    Ok(TriMesh::new(positions, &faces)?)
}

fn middle_on_surface(
    mesh: &TriMesh,
    target: &dyn SurfaceTarget,
    edge: EdgeId,
) -> Result<DVec3, SplitError> {
    let count = mesh.topology().edge_count();
    if edge.index() >= count {
        return Err(SplitError::MissingEdge { edge: edge.index(), count });
    }
    let [a, b] = mesh.topology().edge_vertices(edge);
    let (pa, pb) = (mesh.position(a), mesh.position(b));
    let middle = 0.5 * (pa + pb);
    match target.foot(middle) {
        Some(foot) if foot.point.distance(middle) <= 0.5 * pa.distance(pb) => Ok(foot.point),
        _ => {
            let [a, b] = [a.min(b), a.max(b)].map(VertexId::index);
            Err(SplitError::NoFoot { a, b })
        }
    }
}

/// A triangle with, along its side from corner `k` to `k + 1`, perhaps an edge still to be cut.
#[derive(Clone, Copy)]
struct Piece {
    corners: [usize; 3],
    sides: [Option<Side>; 3],
}

#[derive(Clone, Copy)]
struct Side {
    edge: EdgeId,
    length: f64,
    middle: usize,
}

impl Piece {
    fn whole(mesh: &TriMesh, face: FaceId, middles: &BTreeMap<EdgeId, usize>) -> Self {
        let sides = face.halfedges().map(|h| {
            let edge = mesh.topology().edge(h);
            let side = |&middle| Side { edge, length: mesh.edge_length(edge), middle };
            middles.get(&edge).map(side)
        });
        Self { corners: mesh.topology().corners(face).map(VertexId::index), sides }
    }
}

/// Appends the pieces of a triangle, cut from the longest marked side until none is left.
fn cut(piece: Piece, faces: &mut Vec<[usize; 3]>) {
    let longest = (0..3)
        .filter_map(|k| piece.sides[k].map(|side| (k, side)))
        .max_by(|x, y| x.1.length.total_cmp(&y.1.length).then(y.1.edge.cmp(&x.1.edge)));
    let Some((k, Side { middle, .. })) = longest else {
        faces.push(piece.corners);
        return;
    };
    let [a, b, c] = [0, 1, 2].map(|i| piece.corners[(k + i) % 3]);
    let [bc, ca] = [1, 2].map(|i| piece.sides[(k + i) % 3]);
    cut(Piece { corners: [a, middle, c], sides: [None, None, ca] }, faces);
    cut(Piece { corners: [middle, b, c], sides: [None, bc, None] }, faces);
}
