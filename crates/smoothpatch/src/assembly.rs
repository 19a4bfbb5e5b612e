//! Surfaces of pieces, put together.

use basemesh::{EdgeMap, FaceId, FaceMap, TriMesh, VertexId, VertexMap};
use bezier_core::{SepticTriangle, SurfaceJet};
use g1_triangular::{CurveNetwork, EdgeWeights, SmoothPatches};
use hermite_sqp::EdgeOutcome;

use crate::objectives::Retreat;
use crate::progress::StageTimes;
use crate::surface::{BaseMeshOrigin, G1Surface, Rim};

/// The parts that have been added; each element belongs to one piece.
pub(crate) struct Assembly {
    mesh: TriMesh,
    jets: VertexMap<Option<SurfaceJet>>,
    curves: EdgeMap<Option<(EdgeOutcome, EdgeWeights)>>,
    patches: FaceMap<Option<(SepticTriangle, usize, Option<Retreat>)>>,
    times: StageTimes,
}

impl Assembly {
    /// Nothing yet, for a mesh of several components.
    pub(crate) fn new(mesh: TriMesh) -> Self {
        let topology = mesh.topology();
        let jets = VertexMap::from_vec(vec![None; topology.vertex_count()]);
        let curves = EdgeMap::from_vec(vec![None; topology.edge_count()]);
        let patches = FaceMap::from_vec(vec![None; topology.face_count()]);
        Self { mesh, jets, curves, patches, times: StageTimes::default() }
    }

    /// Adds a piece whose faces and vertices have these numbers here, in the same order.
    pub(crate) fn add(&mut self, piece: G1Surface, faces: &[FaceId], vertices: &[VertexId]) {
        let local = piece.mesh.topology();
        for (v, jet) in piece.jets.iter() {
            self.jets[vertices[v.index()]] = Some(*jet);
        }
        for (edge, outcome) in piece.curves.iter() {
            let h = local.canonical(edge);
            let here = faces[h.face().index()].halfedges()[h.corner()];
            let here = self.mesh.topology().edge(here);
            self.curves[here] = Some((*outcome, piece.patches.weights[edge]));
        }
        for (face, net) in piece.patches.nets.iter() {
            let patch = (*net, piece.failed_feet[face], piece.retreats[face]);
            self.patches[faces[face.index()]] = Some(patch);
        }
        piece.times.iter().for_each(|(stage, seconds)| self.times.add(stage, seconds));
    }

    /// The whole surface.
    pub(crate) fn finish(self, rim: Rim) -> G1Surface {
        const WHOLE: &str = "invariant: the pieces make up the whole";
        let jets = self.jets.map(|_, jet| jet.expect(WHOLE));
        let curves = self.curves.map(|_, known| known.expect(WHOLE).0);
        let weights = self.curves.map(|_, known| known.expect(WHOLE).1);
        let nets = self.patches.map(|_, known| known.expect(WHOLE).0);
        G1Surface {
            network: CurveNetwork::new(curves.map(|_, outcome| outcome.curve)),
            mesh: self.mesh,
            jets,
            curves,
            failed_feet: self.patches.map(|_, known| known.expect(WHOLE).1),
            retreats: self.patches.map(|_, known| known.expect(WHOLE).2),
            patches: SmoothPatches { nets, weights },
            origin: BaseMeshOrigin::default(),
            times: self.times,
            rim: Some(rim),
        }
    }
}
