//! From a list of faces to a [`Topology`], or the reason why not.

use thiserror::Error;

use crate::ids::{EdgeId, HalfedgeId, VertexId};
use crate::maps::{EdgeMap, FaceMap, HalfedgeMap, VertexMap};
use crate::topology::Topology;

/// Why a list of faces is not an oriented manifold triangle mesh.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TopologyError {
    /// There is nothing to build from.
    #[error("the mesh has no faces")]
    Empty,
    /// More elements than 32-bit ids can number.
    #[error("the mesh has {faces} faces; at most {max} are supported")]
    TooLarge {
        /// Faces given.
        faces: usize,
        /// Largest number of faces.
        max: usize,
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
    DegenerateFace {
        /// Index of the face.
        face: usize,
        /// The repeated vertex.
        vertex: usize,
    },
    /// No face uses this vertex.
    #[error("vertex {vertex} belongs to no face; remove it")]
    IsolatedVertex {
        /// The vertex.
        vertex: usize,
    },
    /// An edge with more than two faces.
    #[error("edge {a}-{b} is shared by {count} faces; at most 2 are supported")]
    NonManifoldEdge {
        /// Lower end.
        a: usize,
        /// Higher end.
        b: usize,
        /// Number of faces.
        count: usize,
    },
    /// Two faces run through their common edge in the same direction.
    #[error("faces {first} and {second} disagree about the orientation of edge {a}-{b}")]
    InconsistentOrientation {
        /// Lower end.
        a: usize,
        /// Higher end.
        b: usize,
        /// One face.
        first: usize,
        /// The other face.
        second: usize,
    },
    /// The faces around a vertex form more than one fan.
    #[error("the faces around vertex {vertex} form several fans that meet only in this point")]
    NonManifoldVertex {
        /// The vertex.
        vertex: usize,
    },
}

const MAX_FACES: usize = (u32::MAX as usize) / 3;

impl Topology {
    /// Builds the connectivity of `faces` over the vertices `0..vertex_count`.
    ///
    /// Every face is three vertex indices, counter-clockwise seen from outside. Open surfaces are
    /// accepted. Time and memory are linear in the number of faces.
    ///
    /// # Errors
    ///
    /// [`TopologyError`], with the ids of the first offending element.
    pub fn from_faces(vertex_count: usize, faces: &[[usize; 3]]) -> Result<Self, TopologyError> {
        check_faces(vertex_count, faces)?;
        let faces: FaceMap<[VertexId; 3]> =
            FaceMap::from_vec(faces.iter().map(|f| f.map(VertexId::new)).collect());
        let (twins, edge_of, canonical) = pair_halfedges(vertex_count, &faces)?;
        let outgoing = find_outgoing(vertex_count, &faces, &twins)?;
        Ok(Self { faces, twins, edge_of, canonical, outgoing })
    }
}

fn check_faces(vertex_count: usize, faces: &[[usize; 3]]) -> Result<(), TopologyError> {
    if faces.is_empty() {
        return Err(TopologyError::Empty);
    }
    if faces.len() > MAX_FACES {
        return Err(TopologyError::TooLarge { faces: faces.len(), max: MAX_FACES });
    }
    let mut used = vec![false; vertex_count];
    for (face, &[a, b, c]) in faces.iter().enumerate() {
        for vertex in [a, b, c] {
            if vertex >= vertex_count {
                return Err(TopologyError::MissingVertex { face, vertex, count: vertex_count });
            }
            used[vertex] = true;
        }
        if a == b || a == c {
            return Err(TopologyError::DegenerateFace { face, vertex: a });
        }
        if b == c {
            return Err(TopologyError::DegenerateFace { face, vertex: b });
        }
    }
    match used.iter().position(|&used| !used) {
        Some(vertex) => Err(TopologyError::IsolatedVertex { vertex }),
        None => Ok(()),
    }
}

type Pairing = (HalfedgeMap<Option<HalfedgeId>>, HalfedgeMap<EdgeId>, EdgeMap<HalfedgeId>);

/// Matches half-edges that run between the same two vertices, by a counting sort on the lower one.
fn pair_halfedges(
    vertex_count: usize,
    faces: &FaceMap<[VertexId; 3]>,
) -> Result<Pairing, TopologyError> {
    let halfedge_count = 3 * faces.len();
    let ends = |h: HalfedgeId| {
        let corners = faces[h.face()];
        (corners[h.corner()], corners[h.next().corner()])
    };
    let mut bucket_start = vec![0_u32; vertex_count + 1];
    for h in (0..halfedge_count).map(HalfedgeId::new) {
        let (a, b) = ends(h);
        bucket_start[a.min(b).index() + 1] += 1;
    }
    for i in 0..vertex_count {
        bucket_start[i + 1] += bucket_start[i];
    }
    let mut fill = bucket_start.clone();
    // the higher end and the half-edge in one word, so that sorting looks nothing up
    let mut sorted = vec![0_u64; halfedge_count];
    for h in (0..halfedge_count).map(HalfedgeId::new) {
        let (a, b) = ends(h);
        let slot = &mut fill[a.min(b).index()];
        sorted[*slot as usize] = (a.max(b).index() as u64) << 32 | h.index() as u64;
        *slot += 1;
    }
    let higher = |word: u64| (word >> 32) as usize;
    let halfedge = |word: u64| HalfedgeId::new((word & 0xffff_ffff) as usize);

    let mut twins = HalfedgeMap::from_vec(vec![None; halfedge_count]);
    let mut edge_of = HalfedgeMap::from_vec(vec![EdgeId::new(0); halfedge_count]);
    let mut canonical = Vec::with_capacity(halfedge_count / 2 + 1);
    for lower in 0..vertex_count {
        let bucket = &mut sorted[bucket_start[lower] as usize..bucket_start[lower + 1] as usize];
        bucket.sort_unstable();
        for group in bucket.chunk_by(|&g, &h| higher(g) == higher(h)) {
            let edge = EdgeId::new(canonical.len());
            for &word in group {
                edge_of[halfedge(word)] = edge;
            }
            let (a, b) = (lower, higher(group[0]));
            match *group {
                [g] => canonical.push(halfedge(g)),
                [g, h] => {
                    let (g, h) = (halfedge(g), halfedge(h));
                    if ends(g).0 == ends(h).0 {
                        let (first, second) = (g.face().index(), h.face().index());
                        return Err(TopologyError::InconsistentOrientation { a, b, first, second });
                    }
                    twins[g] = Some(h);
                    twins[h] = Some(g);
                    canonical.push(if ends(g).0.index() == lower { g } else { h });
                }
                _ => return Err(TopologyError::NonManifoldEdge { a, b, count: group.len() }),
            }
        }
    }
    Ok((twins, edge_of, EdgeMap::from_vec(canonical)))
}

/// One outgoing half-edge per vertex, and the proof that all its faces form one fan.
fn find_outgoing(
    vertex_count: usize,
    faces: &FaceMap<[VertexId; 3]>,
    twins: &HalfedgeMap<Option<HalfedgeId>>,
) -> Result<VertexMap<HalfedgeId>, TopologyError> {
    let mut valence = vec![0_usize; vertex_count];
    let mut outgoing: Vec<Option<HalfedgeId>> = vec![None; vertex_count];
    for h in (0..twins.len()).map(HalfedgeId::new) {
        let vertex = faces[h.face()][h.corner()].index();
        valence[vertex] += 1;
        // the lowest half-edge, unless a boundary fixes where the fan starts
        if outgoing[vertex].is_none() || twins[h].is_none() {
            outgoing[vertex] = Some(h);
        }
    }
    let mut result = Vec::with_capacity(vertex_count);
    for (vertex, start) in outgoing.into_iter().enumerate() {
        let start = start.expect("invariant: every vertex is used by a face");
        let mut fan = 1;
        let mut h = start;
        while let Some(next) = twins[h.previous()].filter(|&next| next != start) {
            fan += 1;
            h = next;
        }
        if fan != valence[vertex] {
            return Err(TopologyError::NonManifoldVertex { vertex });
        }
        result.push(start);
    }
    Ok(VertexMap::from_vec(result))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

    #[test]
    fn tetrahedron() {
        let t = Topology::from_faces(4, &TETRAHEDRON).unwrap();
        assert_eq!((t.vertex_count(), t.edge_count(), t.face_count()), (4, 6, 4));
        assert_eq!(t.euler_characteristic(), 2);
        assert!(t.is_closed());
        assert_eq!(t.component_count(), 1);
        for h in t.halfedges() {
            let twin = t.twin(h).unwrap();
            assert_eq!(t.twin(twin), Some(h));
            assert_eq!((t.origin(h), t.target(h)), (t.target(twin), t.origin(twin)));
        }
        for e in t.edges() {
            let [a, b] = t.edge_vertices(e);
            assert!(a < b, "the canonical half-edge of {e} runs upwards");
        }
    }

    #[test]
    fn edge_numbering_does_not_depend_on_face_order() {
        let mut turned = TETRAHEDRON;
        turned.reverse();
        turned.iter_mut().for_each(|f| f.rotate_left(1));
        let (a, b) = (
            Topology::from_faces(4, &TETRAHEDRON).unwrap(),
            Topology::from_faces(4, &turned).unwrap(),
        );
        for e in a.edges() {
            assert_eq!(a.edge_vertices(e), b.edge_vertices(e));
        }
    }

    #[test]
    fn refusals_name_the_element() {
        let check = |n, faces: &[[usize; 3]], expected: TopologyError| {
            assert_eq!(Topology::from_faces(n, faces), Err(expected));
        };
        check(0, &[], TopologyError::Empty);
        check(3, &[[0, 1, 3]], TopologyError::MissingVertex { face: 0, vertex: 3, count: 3 });
        check(3, &[[0, 1, 1]], TopologyError::DegenerateFace { face: 0, vertex: 1 });
        check(4, &[[0, 1, 2]], TopologyError::IsolatedVertex { vertex: 3 });
        check(
            5,
            &[[0, 1, 2], [1, 0, 3], [0, 1, 4]],
            TopologyError::NonManifoldEdge { a: 0, b: 1, count: 3 },
        );
        check(
            4,
            &[[0, 1, 2], [0, 1, 3]],
            TopologyError::InconsistentOrientation { a: 0, b: 1, first: 0, second: 1 },
        );
        check(5, &[[0, 1, 2], [0, 3, 4]], TopologyError::NonManifoldVertex { vertex: 0 });
    }
}
