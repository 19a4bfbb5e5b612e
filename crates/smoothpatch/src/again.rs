//! What stays the same when some patches are made again with other objectives.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh};
use bezier_core::SepticTriangle;
use g1_triangular::{Earlier, EdgeRows, Plan, PositionalPatch, PositionalPatches, SmoothPatches};
use hermite_sqp::EdgeOutcome;

/// The results before, and what has changed since.
pub(crate) struct Unchanged<'a> {
    mesh: &'a TriMesh,
    positional: &'a PositionalPatches,
    patches: &'a SmoothPatches,
    new_positional: FaceMap<bool>,
    new_rows: EdgeMap<bool>,
    new_patches: FaceMap<bool>,
}

impl<'a> Unchanged<'a> {
    /// Compares curves and objectives: those before, and those from now on.
    pub(crate) fn new(
        mesh: &'a TriMesh,
        [old_curves, curves]: [&EdgeMap<EdgeOutcome>; 2],
        [old_plan, plan]: [&Plan; 2],
        positional: &'a PositionalPatches,
        patches: &'a SmoothPatches,
    ) -> Self {
        let topology = mesh.topology();
        let new_positional = FaceMap::from_fn(topology.face_count(), |face| {
            plan.fill[face] != old_plan.fill[face]
                || face
                    .halfedges()
                    .map(|h| topology.edge(h))
                    .into_iter()
                    .any(|edge| curves[edge].curve != old_curves[edge].curve)
        });
        // rows depend on all faces around both ends
        let near = |edge: EdgeId| {
            let ends = topology.edge_vertices(edge);
            ends.iter().any(|&v| topology.fan(v).any(|h| new_positional[h.face()]))
        };
        let new_rows = EdgeMap::from_fn(topology.edge_count(), |edge| {
            plan.rows[edge] != old_plan.rows[edge] || near(edge)
        });
        let new_patches = FaceMap::from_fn(topology.face_count(), |face| {
            plan.inner_points[face] != old_plan.inner_points[face]
                || face.halfedges().into_iter().any(|h| new_rows[topology.edge(h)])
        });
        Self { mesh, positional, patches, new_positional, new_rows, new_patches }
    }
}

impl Earlier for Unchanged<'_> {
    fn positional(&self, face: FaceId) -> Option<PositionalPatch> {
        let known = || PositionalPatch {
            net: self.positional.nets[face],
            failed_feet: self.positional.failed_feet[face],
        };
        (!self.new_positional[face]).then(known)
    }

    fn rows(&self, edge: EdgeId) -> Option<EdgeRows> {
        if self.new_rows[edge] { None } else { self.patches.edge_rows(self.mesh, edge) }
    }

    fn patch(&self, face: FaceId) -> Option<SepticTriangle> {
        (!self.new_patches[face]).then(|| self.patches.nets[face])
    }
}
