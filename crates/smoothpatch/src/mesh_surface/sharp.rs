//! A mesh with creases or a boundary: smooth pieces that share the curves of their sharp edges.

use basemesh::glam::DVec3;
use basemesh::{
    EdgeId, EdgeMap, FaceId, FaceMap, Foot, HalfedgeId, SurfaceTarget, TriMesh, VertexId,
};
use bezier_core::{LocalEdge, QuarticCurve, SepticCurve, SurfaceJet};
use g1_triangular::{CurveNetwork, SecondOrderData};
use implicit::ProjectionSettings;
use meshfield::{CutMesh, JetError, JetSettings, MeshField, SharpEdges, cut_open, fit_jets};

use super::rims::Rims;
use super::source::MeshSource;
use crate::assembly::Assembly;
use crate::error::FitError;
use crate::pipeline::fit_source;
use crate::progress::Progress;
use crate::settings::{SecondForms, Settings};
use crate::surface::{G1Surface, Rim};

/// A mesh cut along its sharp edges, with a smooth surface for each piece.
#[derive(Clone, Debug)]
pub struct SharpMesh {
    whole: TriMesh,
    cut: CutMesh,
    rim: Rim,
    curves: EdgeMap<Option<QuarticCurve>>,
    pieces: Vec<Piece>,
    /// The piece of each face.
    piece_of: FaceMap<usize>,
}

/// Faces that are connected without crossing a sharp edge.
#[derive(Clone, Debug)]
struct Piece {
    field: MeshField,
    /// The faces, vertices and boundary curves in the numbers of the piece.
    faces: Vec<FaceId>,
    vertices: Vec<VertexId>,
    curves: EdgeMap<Option<QuarticCurve>>,
}

impl SharpMesh {
    /// Cuts a mesh and finds the curves of its sharp edges and a smooth surface for each piece.
    ///
    /// # Errors
    ///
    /// [`JetError`]: vertices without a normal.
    pub fn new(
        whole: TriMesh,
        sharp: &SharpEdges,
        settings: &JetSettings,
    ) -> Result<Self, JetError> {
        let topology = whole.topology();
        let mut is_sharp = EdgeMap::from_vec(vec![false; topology.edge_count()]);
        sharp.creases.iter().chain(&sharp.boundary).for_each(|&edge| is_sharp[edge] = true);
        let cut = cut_open(&whole, &is_sharp);
        cut.uncut.iter().for_each(|&edge| is_sharp[edge] = false);
        let creases = sharp.creases.iter().copied().filter(|&edge| is_sharp[edge]).collect();
        let rims = Rims::new(&whole, &is_sharp);
        let pieces: Vec<Piece> = (0..cut.region_count)
            .map(|region| Piece::new(&whole, &cut, region, &rims, settings))
            .collect::<Result<_, _>>()?;
        let rim = Rim {
            whole: whole.clone(),
            creases,
            boundary: sharp.boundary.clone(),
            smoothed: cut.uncut.clone(),
        };
        let piece_of = cut.regions.clone();
        Ok(Self { whole, cut, rim, curves: rims.curves, pieces, piece_of })
    }

    /// The mesh before it was cut.
    #[must_use]
    pub fn mesh(&self) -> &TriMesh {
        &self.whole
    }

    /// The smooth surfaces of the pieces.
    pub fn fields(&self) -> impl Iterator<Item = &MeshField> {
        self.pieces.iter().map(|piece| &piece.field)
    }

    /// The source of feet for each piece.
    pub(crate) fn sources(&self, projection: ProjectionSettings) -> Vec<PieceSource<'_>> {
        self.pieces.iter().map(|piece| piece.source(projection)).collect()
    }

    /// The piece of a face.
    pub(crate) fn piece_of(&self, face: FaceId) -> usize {
        self.piece_of[face]
    }

    /// A patch for each triangle: exactly G1 inside the pieces, C0 along sharp edges.
    ///
    /// # Errors
    ///
    /// [`FitError`], as for [`fit_source`](crate::fit_source). Numbers in messages are those of a piece.
    pub fn fit(
        &self,
        settings: &Settings,
        progress: &mut dyn Progress,
    ) -> Result<G1Surface, FitError> {
        let settings = &Settings { second_forms: SecondForms::AgreeAlongEdges, ..settings.clone() };
        let mut assembly = Assembly::new(self.cut.mesh.clone());
        for piece in &self.pieces {
            let source = piece.source(settings.projection);
            let mesh = piece.field.mesh().clone();
            let fitted = fit_source(&source, mesh, settings, progress)?;
            assembly.add(fitted, &piece.faces, &piece.vertices);
        }
        let mut surface = assembly.finish(self.rim.clone());
        self.close_creases(&mut surface);
        Ok(surface)
    }

    /// Gives both sides of a sharp edge the same bits: the curve is elevated once, before it is turned.
    fn close_creases(&self, surface: &mut G1Surface) {
        let topology = self.whole.topology();
        let elevated =
            self.curves.map(|_, curve| curve.map(|curve| -> SepticCurve { curve.elevate_to() }));
        surface.patches.nets.change(|face, net| {
            for h in face.halfedges() {
                let edge = topology.edge(h);
                let Some(curve) = elevated[edge] else { continue };
                let forward = topology.canonical(edge) == h;
                let local = LocalEdge::starting_at(bezier_core::Corner::ALL[h.corner()]);
                net.set_boundary(local, &if forward { curve } else { curve.reversed() });
            }
        });
        surface.network = CurveNetwork::new(surface.curves.map(|_, outcome| outcome.curve));
    }
}

impl Piece {
    fn new(
        whole: &TriMesh,
        cut: &CutMesh,
        region: usize,
        rims: &Rims,
        settings: &JetSettings,
    ) -> Result<Self, JetError> {
        let topology = cut.mesh.topology();
        let faces: Vec<FaceId> =
            topology.faces().filter(|&face| cut.regions[face] == region).collect();
        let mut vertices: Vec<VertexId> =
            faces.iter().flat_map(|&face| topology.corners(face)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let local =
            |v: VertexId| vertices.binary_search(&v).expect("invariant: a vertex of the piece");
        let corners: Vec<[usize; 3]> =
            faces.iter().map(|&face| topology.corners(face).map(local)).collect();
        let positions = vertices.iter().map(|&v| cut.mesh.position(v)).collect();
        let mesh =
            TriMesh::new(positions, &corners).expect("invariant: a part of a mesh is a mesh");

        // half-edges of the whole mesh and of the piece are numbered by their faces
        let outer = |h: HalfedgeId| faces[h.face().index()].halfedges()[h.corner()];
        let curves = EdgeMap::from_fn(mesh.topology().edge_count(), |edge: EdgeId| {
            let h = mesh.topology().canonical(edge);
            mesh.topology().is_boundary_edge(edge).then(|| along(whole, rims, outer(h))).flatten()
        });
        let mut jets = fit_jets(&mesh, settings)?;
        for v in mesh.topology().vertices().filter(|&v| mesh.topology().is_boundary_vertex(v)) {
            let fan: Vec<HalfedgeId> = mesh.topology().fan(v).collect();
            let ends = [fan[0], fan[fan.len() - 1].previous()].map(outer);
            let mean = jets[v].surface_jet().map(|jet| jet.normal);
            let turned = mean
                .and_then(|mean| rims.normal(whole, ends, mean))
                .and_then(|normal| jets[v].turned_to(normal));
            let no_normal = JetError::NoNormal { vertex: v.index(), at: mesh.position(v) };
            jets[v] = turned.ok_or(no_normal)?;
        }
        let field = MeshField::new(mesh, jets)?;
        Ok(Self { field, faces, vertices, curves })
    }

    fn source(&self, projection: ProjectionSettings) -> PieceSource<'_> {
        PieceSource { surface: MeshSource::new(&self.field, projection), curves: &self.curves }
    }
}

/// The curve of a sharp edge along a half-edge.
fn along(whole: &TriMesh, rims: &Rims, h: HalfedgeId) -> Option<QuarticCurve> {
    let edge = whole.topology().edge(h);
    let curve = rims.curves[edge]?;
    Some(if whole.topology().canonical(edge) == h { curve } else { curve.reversed() })
}

/// Feet and second-order data of a piece, and the curves of its boundary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceSource<'a> {
    surface: MeshSource<'a>,
    curves: &'a EdgeMap<Option<QuarticCurve>>,
}

impl SurfaceTarget for PieceSource<'_> {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        self.surface.foot(near)
    }

    fn linear_feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        self.surface.linear_feet(points, feet);
    }
}

impl SecondOrderData for PieceSource<'_> {
    fn surface_jet(&self, vertex: VertexId, position: DVec3) -> Option<SurfaceJet> {
        self.surface.surface_jet(vertex, position)
    }

    fn given_curve(&self, edge: EdgeId) -> Option<QuarticCurve> {
        self.curves[edge]
    }
}
