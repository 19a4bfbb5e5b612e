//! The construction, step by step [TK09, section 6].

use basemesh::{
    EdgeMap, FaceId, FaceMap, HalfedgeId, HalfedgeMap, SurfaceTarget, Topology, TriMesh, VertexMap,
};
use bezier_core::{MultiIndex, SepticTriangle, SurfaceJet};

use crate::earlier::{Earlier, Nothing};
use crate::edge_system::{EdgeRows, EdgeSystem};
use crate::error::JoinError;
use crate::faces::{back_to_face, corner_halfedges, first_corner, local_edge};
use crate::interior;
use crate::network::CurveNetwork;
use crate::plan::{InnerPoints, Plan, Rows};
use crate::residual::g1_residual;
use crate::tangent_planes;
use crate::vertex_system::{SpokeSolution, solve_vertices};
use crate::weights::{EdgeWeights, NO_WEIGHTS, origin_weights};

/// Patches whose tangent planes agree along every edge.
#[derive(Clone, Debug)]
pub struct SmoothPatches {
    /// Control nets by face.
    pub nets: FaceMap<SepticTriangle>,
    /// The weight functions that prove the smoothness of each edge; zero on a boundary, where there
    /// is nothing to prove.
    pub weights: EdgeMap<EdgeWeights>,
}

impl SmoothPatches {
    /// The rows along an edge; `None` on a boundary.
    #[must_use]
    pub fn edge_rows(&self, mesh: &TriMesh, edge: basemesh::EdgeId) -> Option<EdgeRows> {
        let h = mesh.topology().canonical(edge);
        let w = mesh.topology().twin(h)?;
        let [_, _, a, b, c, ..] = self.nets[h.face()].first_inner_row::<7>(local_edge(h));
        let [_, _, e, d, f, ..] = self.nets[w.face()].first_inner_row::<7>(local_edge(w));
        Some(EdgeRows { left: [a, b, c], right: [f, d, e], weights: self.weights[edge] })
    }

    /// Largest coefficient of the smoothness condition along an edge, in chord lengths: zero, up to
    /// round-off, for every edge.
    #[must_use]
    pub fn edge_residual(
        &self,
        mesh: &TriMesh,
        network: &CurveNetwork,
        edge: basemesh::EdgeId,
    ) -> Option<f64> {
        let h = mesh.topology().canonical(edge);
        let w = mesh.topology().twin(h)?;
        let left = self.nets[h.face()].first_inner_row::<7>(local_edge(h));
        let mut right = self.nets[w.face()].first_inner_row::<7>(local_edge(w));
        right.reverse();
        let rows = g1_residual(&network.curves()[edge], &left, &right, &self.weights[edge]);
        Some(rows.iter().map(|row| row.length()).fold(0.0, f64::max))
    }
}

/// Turns positional patches into smooth ones: the boundary curves stay, twist points, first inner
/// rows and (by [`Plan::inner_points`]) inner points move.
///
/// An edge whose tangent planes cannot be compared with the surface (a foot is missing) gets the
/// nearest rows instead. Along a boundary the rows of the positional patches stay, but for the twists.
///
/// # Errors
///
/// [`JoinError`] where the curves around a vertex do not fan out.
///
/// # Panics
///
/// If jets, curves, patches or plan are not for this mesh.
pub fn join(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    network: &CurveNetwork,
    positional: FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
    plan: &Plan,
) -> Result<SmoothPatches, JoinError> {
    join_reusing(mesh, jets, network, positional, target, plan, &Nothing)
}

/// [`join`] that finds only those rows and patches anew that `earlier` does not know.
///
/// # Errors
///
/// As [`join`].
///
/// # Panics
///
/// As [`join`].
#[allow(clippy::too_many_arguments, reason = "the arguments of join and one more")]
pub fn join_reusing(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    network: &CurveNetwork,
    mut nets: FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
    plan: &Plan,
    earlier: &dyn Earlier,
) -> Result<SmoothPatches, JoinError> {
    let topology = mesh.topology();
    assert_eq!(jets.len(), topology.vertex_count(), "one jet per vertex");
    assert_eq!(network.curves().len(), topology.edge_count(), "one curve per edge");
    assert_eq!(nets.len(), topology.face_count(), "one patch per face");
    assert_eq!(plan.rows.len(), topology.edge_count(), "one choice per edge");
    assert_eq!(plan.inner_points.len(), topology.face_count(), "one choice per face");

    let edges = edge_rows(mesh, jets, network, &mut nets, target, plan, earlier)?;
    nets.change(|face, net| {
        if let Some(known) = earlier.patch(face) {
            *net = known;
            return;
        }
        set_rows(net, topology, face, &edges);
        if plan.inner_points[face] != InnerPoints::Keep {
            let first = first_corner(topology, face);
            *net = interior::choose(&net.starting_at(first), plan.inner_points[face], target)
                .starting_at(back_to_face(first));
        }
    });
    let weights = edges.map(|_, rows| rows.map_or(NO_WEIGHTS, |rows| rows.weights));
    Ok(SmoothPatches { nets, weights })
}

/// Makes the twist points of the patches final, and finds the rows along all edges with two
/// faces whose tangent planes shall agree.
#[allow(clippy::too_many_arguments, reason = "those of join_reusing")]
fn edge_rows(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    network: &CurveNetwork,
    nets: &mut FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
    plan: &Plan,
    earlier: &dyn Earlier,
) -> Result<EdgeMap<Option<EdgeRows>>, JoinError> {
    let topology = mesh.topology();
    let origin = origin_weights(mesh, jets, network)?;
    let twist = |h: HalfedgeId| nets[h.face()][MultiIndex::along(local_edge(h), 5, 1, 1)];
    let spokes = solve_vertices(mesh, jets, network, &origin, &twist)?;
    nets.change(|face, net| set_twists(net, face, &spokes));
    EdgeMap::try_from_fn(topology.edge_count(), |edge| {
        if let Some(rows) = earlier.rows(edge) {
            return Ok(Some(rows));
        }
        let Some(system) = EdgeSystem::new(topology, network, nets, &origin, &spokes, edge) else {
            return Ok(None);
        };
        let rows = match plan.rows[edge] {
            Rows::Nearest => None,
            Rows::TangentPlanes => tangent_planes::solve(&system, target),
        };
        let vertex = topology.origin(topology.canonical(edge)).index();
        rows.or_else(|| system.nearest()).map(Some).ok_or(JoinError::DegenerateFan { vertex })
    })
}

fn set_twists(net: &mut SepticTriangle, face: FaceId, spokes: &HalfedgeMap<SpokeSolution>) {
    for h in corner_halfedges(face) {
        net.set_first_inner(local_edge(h), 1, spokes[h].twist);
    }
}

fn set_rows(
    net: &mut SepticTriangle,
    topology: &Topology,
    face: FaceId,
    edges: &EdgeMap<Option<EdgeRows>>,
) {
    for h in corner_halfedges(face) {
        let edge = topology.edge(h);
        let Some(rows) = &edges[edge] else { continue };
        let middle = if topology.canonical(edge) == h {
            rows.left
        } else {
            let [a, b, c] = rows.right;
            [c, b, a]
        };
        for (i, point) in middle.into_iter().enumerate() {
            net.set_first_inner(local_edge(h), 2 + i, point);
        }
    }
}
