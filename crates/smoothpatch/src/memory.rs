//! What earlier fits found, so that after a change of the base mesh only the changed neighbourhood
//! is fitted again.
//!
//! Everything is looked up by what it depends on. A vertex has two keys: one of its position, and
//! one of its ring, that is of the positions and the cyclic order of itself and its neighbours. As
//! edges run from the lower to the higher vertex, the order of ids counts too: an edit may put a
//! vertex where another was. A curve depends on the positions of its ends, a positional patch on
//! those of its corners; the rows along an edge depend on the rings of its ends, a smooth patch on
//! the rings of its corners.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh, VertexId, VertexMap};
use bezier_core::SepticTriangle;
use g1_triangular::{Earlier, EdgeRows, PositionalPatch, PositionalPatches, SmoothPatches};
use hermite_sqp::EdgeOutcome;

use crate::measure::FaceDeviation;

/// Results by key.
#[derive(Default)]
pub(crate) struct Memory {
    curves: HashMap<[u64; 2], EdgeOutcome>,
    positional: HashMap<[u64; 4], PositionalPatch>,
    rows: HashMap<[u64; 2], EdgeRows>,
    patches: HashMap<[u64; 4], (SepticTriangle, FaceDeviation)>,
}

impl Memory {
    /// What one fit found.
    pub(crate) fn of(
        keys: &Keys<'_>,
        curves: &EdgeMap<EdgeOutcome>,
        positional: &PositionalPatches,
        patches: &SmoothPatches,
        deviations: &FaceMap<FaceDeviation>,
    ) -> Self {
        let (own, rings, mesh) = (&keys.positions, &keys.rings, keys.mesh);
        let positional_patch = |face| PositionalPatch {
            net: positional.nets[face],
            failed_feet: positional.failed_feet[face],
        };
        let rows = |edge| Some((keys.of_edge(rings, edge), patches.edge_rows(mesh, edge)?));
        let faces = || mesh.topology().faces();
        Self {
            curves: curves.iter().map(|(edge, curve)| (keys.of_edge(own, edge), *curve)).collect(),
            positional: faces()
                .map(|face| (keys.of_face(own, face), positional_patch(face)))
                .collect(),
            rows: mesh.topology().edges().filter_map(rows).collect(),
            patches: faces()
                .map(|face| (keys.of_face(rings, face), (patches.nets[face], deviations[face])))
                .collect(),
        }
    }
}

/// The keys of a mesh.
pub(crate) struct Keys<'a> {
    mesh: &'a TriMesh,
    positions: VertexMap<u64>,
    rings: VertexMap<u64>,
}

impl<'a> Keys<'a> {
    pub(crate) fn new(mesh: &'a TriMesh) -> Self {
        let topology = mesh.topology();
        let vertices = topology.vertex_count();
        let positions = VertexMap::from_fn(vertices, |vertex| {
            hash(&mesh.position(vertex).to_array().map(f64::to_bits))
        });
        let rings = VertexMap::from_fn(vertices, |vertex| {
            let ring: Vec<(u64, bool, bool)> = topology
                .fan(vertex)
                .map(|h| [topology.target(h), topology.target(h.next())])
                .map(|[other, next]| (positions[other], other < vertex, other < next))
                .collect();
            hash(&(positions[vertex], ring))
        });
        Self { mesh, positions, rings }
    }

    fn of_edge(&self, keys: &VertexMap<u64>, edge: EdgeId) -> [u64; 2] {
        self.mesh.topology().edge_vertices(edge).map(|vertex: VertexId| keys[vertex])
    }

    fn of_face(&self, keys: &VertexMap<u64>, face: FaceId) -> [u64; 4] {
        let corners @ [a, b, c] = self.mesh.topology().corners(face);
        let [x, y, z] = corners.map(|vertex| keys[vertex]);
        [x, y, z, hash(&(a < b, b < c, c < a))]
    }
}

fn hash(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// A memory seen from one mesh.
#[derive(Clone, Copy)]
pub(crate) struct Recall<'a> {
    pub(crate) memory: &'a Memory,
    pub(crate) keys: &'a Keys<'a>,
}

impl Recall<'_> {
    /// The curve of an edge.
    pub(crate) fn curve(&self, edge: EdgeId) -> Option<EdgeOutcome> {
        self.memory.curves.get(&self.keys.of_edge(&self.keys.positions, edge)).copied()
    }

    /// How far the patch of a face is from the surface.
    pub(crate) fn deviation(&self, face: FaceId) -> Option<FaceDeviation> {
        self.memory.patches.get(&self.keys.of_face(&self.keys.rings, face)).map(|known| known.1)
    }
}

impl Earlier for Recall<'_> {
    fn positional(&self, face: FaceId) -> Option<PositionalPatch> {
        self.memory.positional.get(&self.keys.of_face(&self.keys.positions, face)).copied()
    }

    fn rows(&self, edge: EdgeId) -> Option<EdgeRows> {
        self.memory.rows.get(&self.keys.of_edge(&self.keys.rings, edge)).copied()
    }

    fn patch(&self, face: FaceId) -> Option<SepticTriangle> {
        self.memory.patches.get(&self.keys.of_face(&self.keys.rings, face)).map(|known| known.0)
    }
}
