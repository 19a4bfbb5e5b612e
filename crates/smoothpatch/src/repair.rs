//! Local refinement where the base mesh does not resolve the surface.
//!
//! Two tests predict where patches would fold [TK09, with our measurements in docs/math]: the edges
//! around a vertex, projected into its tangent plane, must turn counter-clockwise, each by less
//! than half a turn; and the curves must have end tangents of sensible lengths. At a vertex that
//! fails, the edge whose normals turn most is split.

use basemesh::{
    EdgeId, EdgeMap, FaceId, SurfaceTarget, Topology, TriMesh, VertexMap, edge_turning,
    invalid_fans,
};
use bezier_core::SurfaceJet;
use hermite_sqp::EdgeOutcome;

use crate::error::FitError;

/// The edges to split, in id order; no two of them share a face.
pub(crate) fn edges_to_split(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    curves: &EdgeMap<EdgeOutcome>,
) -> Vec<EdgeId> {
    let topology = mesh.topology();
    let normals = jets.map(|_, jet| jet.normal);
    let mut wanted: Vec<(f64, EdgeId)> = invalid_fans(mesh, &normals)
        .into_iter()
        .filter_map(|vertex| {
            topology
                .fan(vertex)
                .map(|h| topology.edge(h))
                .map(|edge| (edge_turning(mesh, &normals, edge), edge))
                .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
        })
        .collect();
    wanted.extend(
        curves
            .iter()
            .filter(|(_, outcome)| outcome.status.is_fallback())
            .map(|(edge, _)| (edge_turning(mesh, &normals, edge), edge)),
    );
    apart(topology, wanted)
}

/// The edges of folded patches along which the normals turn most, in id order; no two of them share a face.
pub(crate) fn edges_of_folds(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    folds: &[FaceId],
) -> Vec<EdgeId> {
    let topology = mesh.topology();
    let normals = jets.map(|_, jet| jet.normal);
    let turning = |edge: EdgeId| (edge_turning(mesh, &normals, edge), edge);
    let most = |face: &FaceId| {
        let edges = face.halfedges().map(|h| turning(topology.edge(h)));
        edges.into_iter().max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
    };
    apart(topology, folds.iter().filter_map(most).collect())
}

/// Edges without common faces, those that turn most first.
fn apart(topology: &Topology, mut wanted: Vec<(f64, EdgeId)>) -> Vec<EdgeId> {
    wanted.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut touched = vec![false; topology.face_count()];
    let mut chosen = Vec::new();
    for (_, edge) in wanted {
        let h = topology.canonical(edge);
        let faces: Vec<usize> =
            std::iter::once(h).chain(topology.twin(h)).map(|h| h.face().index()).collect();
        if faces.iter().all(|&f| !touched[f]) {
            faces.into_iter().for_each(|f| touched[f] = true);
            chosen.push(edge);
        }
    }
    chosen.sort_unstable();
    chosen
}

/// The mesh with these edges split at points of the surface.
pub(crate) fn refine(
    mesh: &TriMesh,
    target: &dyn SurfaceTarget,
    edges: &[EdgeId],
) -> Result<TriMesh, FitError> {
    Ok(basemesh::split_edges(mesh, target, edges)?)
}
