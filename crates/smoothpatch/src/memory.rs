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

#[cfg(test)]
mod tests {
    use basemesh::{EdgeId, RemeshSettings, SplitError, split_edges};
    use basemesh::{FieldTarget, SimplifySettings, polygonize_to_faces, remesh, simplify};
    use implicit::NamedShape;

    use super::*;
    use crate::pipeline::{fit_again, fit_mesh};
    use crate::progress::{Clock, Silent};
    use crate::{FieldSource, Settings};

    /// After local changes, what is remembered together with what is fitted anew is the same, bit
    /// for bit, as a fit of the whole changed mesh.
    #[test]
    fn local_fits_give_the_bits_of_a_whole_fit() {
        let shape = NamedShape::find("double-torus").expect("a shape");
        let field = shape.field();
        let settings = Settings::with_faces(800);
        let dense = polygonize_to_faces(&*field, &shape.region, 8000).expect("a mesh").mesh;
        let length = dense.diagonal();
        let target = FieldTarget::new(&*field, length, settings.projection);
        let base = simplify(dense, &target, &SimplifySettings::to_faces(800)).expect("a base mesh");
        let source = FieldSource::new(&*field, length, settings.projection);
        let mut silent = Silent;
        let mut clock = Clock::new(&mut silent);
        let mut memory = Memory::default();
        fit_again(base.mesh.clone(), &source, &settings, &mut memory, &mut clock).expect("a fit");

        let split = |mesh: &TriMesh| -> Result<TriMesh, SplitError> {
            split_edges(mesh, &source, &[10, 400, 700].map(EdgeId::new))
        };
        // collapses as well: vertices take the place of others
        let remeshed = |mesh: &TriMesh| {
            let lengths = VertexMap::from_fn(mesh.topology().vertex_count(), |vertex| {
                (vertex.index() % 50 == 0).then_some(0.08 * length)
            });
            remesh(mesh, &source, &lengths, &RemeshSettings::default()).expect("a mesh").mesh
        };
        let changed = remeshed(&split(&base.mesh).expect("splits"));
        let keys = Keys::new(&changed);
        let recall = Recall { memory: &memory, keys: &keys };
        let known = changed.topology().faces().filter(|&face| recall.patch(face).is_some()).count();
        assert!(known > 100, "only {known} patches are remembered");
        assert!(known < changed.topology().face_count(), "nothing changed");

        let (local, _) =
            fit_again(changed.clone(), &source, &settings, &mut memory, &mut clock).expect("a fit");
        let whole = fit_mesh(changed, &source, &settings, 0, &mut clock).expect("a fit");
        assert!(whole.retreats.as_slice().iter().all(Option::is_none), "the guard interfered");
        assert_eq!(local.patches.weights, whole.patches.weights, "weights");
        assert_eq!(local.patches.nets, whole.patches.nets, "nets");
    }
}
