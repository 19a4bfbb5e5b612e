//! What the last fit found, so that after a change of the base mesh only the changed neighbourhood is
//! fitted again.
//!
//! Everything is looked up by what it depends on. A vertex has two keys: one of its position, and
//! one of its ring, that is of the positions and the cyclic order of itself and its neighbours. As
//! edges run from the lower to the higher vertex, the order of ids counts too: an edit may put a
//! vertex where another was. A curve depends on the positions of its ends; the rows along an edge
//! depend on the rings of its ends, a smooth patch on the rings of its corners.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh, VertexId, VertexMap};
use g1_triangular::{Earlier, Nothing};

use crate::again::Known;
use crate::curves::{fit_curve, vertex_jets};
use crate::error::FitError;
use crate::measure::{FaceDeviation, face_deviations};
use crate::objectives::Objectives;
use crate::pipeline::{fit_patches, surface};
use crate::progress::{Clock, Stage};
use crate::settings::{SecondForms, Settings};
use crate::source::FitSource;
use crate::surface::G1Surface;

/// The last fit, if there was one.
#[derive(Default)]
pub(crate) struct Memory {
    last: Option<Last>,
}

/// A fit, and where to find its parts.
struct Last {
    surface: Arc<G1Surface>,
    deviations: FaceMap<FaceDeviation>,
    tables: Tables,
}

/// Elements by what the results for them depend on.
struct Tables {
    curves: HashMap<[u64; 2], EdgeId>,
    rows: HashMap<[u64; 2], EdgeId>,
    faces: HashMap<[u64; 4], FaceId>,
}

/// Curves, then patches, then smooth patches, found anew only where the mesh has changed since the
/// fit that is remembered; `memory` then remembers this one. No repair, no fold guard: what is wrong
/// shows in the deviation, and the mesh changes there.
pub(crate) fn fit_again(
    mesh: TriMesh,
    source: &dyn FitSource,
    settings: &Settings,
    memory: &mut Memory,
    clock: &mut Clock<'_>,
) -> Result<(Arc<G1Surface>, FaceMap<FaceDeviation>), FitError> {
    let topology = mesh.topology();
    let [vertices, edges, faces] =
        [topology.vertex_count(), topology.edge_count(), topology.face_count()];
    if settings.second_forms != SecondForms::Given {
        // data at a vertex then depend on its neighbours, which the keys do not know
        *memory = Memory::default();
    }
    let keys = Keys::new(&mesh);
    let last = memory.last.as_ref();
    let known = last.map(|last| last.known(&keys));
    let objectives = Objectives::uniform(topology, settings);

    let jets = clock.run(Stage::Vertices, vertices, || vertex_jets(&mesh, source, settings))?;
    let curves = clock.run(Stage::Curves, edges, || {
        EdgeMap::try_from_fn(edges, |edge| match last.and_then(|last| last.curve(&keys, edge)) {
            Some(same) => Ok(last.expect("invariant: it knows a curve").surface.curves[same]),
            None => fit_curve(&mesh, &jets, source, settings, edge, settings.curve_refinement),
        })
    })?;
    let earlier: &dyn Earlier = known.as_ref().map_or(&Nothing, |known| known);
    let fitted = fit_patches(&mesh, &jets, curves, source, &objectives, earlier, clock)?;
    let deviations = clock.run(Stage::Measure, faces, || {
        face_deviations(&fitted.patches.nets, source, |face| last?.deviation(&keys, face))
    });
    let tables = keys.tables();
    let surface = Arc::new(surface(mesh, jets, fitted, objectives));
    let (kept, deviations_kept) = (Arc::clone(&surface), deviations.clone());
    memory.last = Some(Last { surface: kept, deviations: deviations_kept, tables });
    Ok((surface, deviations))
}

impl Last {
    fn curve(&self, keys: &Keys<'_>, edge: EdgeId) -> Option<EdgeId> {
        self.tables.curves.get(&keys.of_edge(&keys.positions, edge)).copied()
    }

    fn face(&self, keys: &Keys<'_>, face: FaceId) -> Option<FaceId> {
        self.tables.faces.get(&keys.of_face(&keys.rings, face)).copied()
    }

    /// How far the patch of a face is from the surface.
    fn deviation(&self, keys: &Keys<'_>, face: FaceId) -> Option<FaceDeviation> {
        self.face(keys, face).map(|same| self.deviations[same])
    }

    /// What holds on another mesh as well.
    fn known(&self, keys: &Keys<'_>) -> Known<'_> {
        let topology = keys.mesh.topology();
        let rows = EdgeMap::from_fn(topology.edge_count(), |edge| {
            self.tables.rows.get(&keys.of_edge(&keys.rings, edge)).copied()
        });
        let faces = FaceMap::from_fn(topology.face_count(), |face| self.face(keys, face));
        let G1Surface { mesh, patches, failed_feet, .. } = &*self.surface;
        Known::new((mesh, patches, failed_feet), keys.mesh, rows, faces)
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

    fn tables(&self) -> Tables {
        let (own, rings, topology) = (&self.positions, &self.rings, self.mesh.topology());
        Tables {
            curves: topology.edges().map(|edge| (self.of_edge(own, edge), edge)).collect(),
            rows: topology.edges().map(|edge| (self.of_edge(rings, edge), edge)).collect(),
            faces: topology.faces().map(|face| (self.of_face(rings, face), face)).collect(),
        }
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

#[cfg(test)]
mod tests {
    use basemesh::{FieldTarget, SimplifySettings, polygonize_to_faces, remesh, simplify};
    use basemesh::{RemeshSettings, SplitError, split_edges};
    use implicit::NamedShape;

    use super::*;
    use crate::FieldSource;
    use crate::pipeline::fit_mesh;
    use crate::progress::Silent;

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
        let known = memory.last.as_ref().expect("a fit").known(&keys);
        let known = changed.topology().faces().filter(|&face| known.patch(face).is_some()).count();
        assert!(known > 100, "only {known} patches are remembered");
        assert!(known < changed.topology().face_count(), "nothing changed");

        let (local, _) =
            fit_again(changed.clone(), &source, &settings, &mut memory, &mut clock).expect("a fit");
        let whole = fit_mesh(changed, &source, &settings, 0, &mut clock).expect("a fit");
        assert!(whole.retreats.as_slice().iter().all(Option::is_none), "the guard interfered");
        assert!(local.patches.weights == whole.patches.weights, "weights");
        assert!(local.patches.nets == whole.patches.nets, "nets");
    }
}
