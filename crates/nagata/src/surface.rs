//! Surfaces: patches over a mesh that share their edge curves.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

use crate::corner_normals::CornerNormals;
use crate::curvature_parameter::{EdgeNormals, EdgeStatus, curvature_parameter, end_misfit};
use crate::edge_blocks::EdgeBlocks;
use crate::edge_curve::EdgeCurve;
use crate::error::SurfaceError;
use crate::ids::Side;
use crate::polygon_mesh::PolygonMesh;
use crate::quad::NagataQuad;
use crate::settings::{Continuity, Settings};
use crate::tangent_continuous::G1Triangle;
use crate::triangle::NagataTriangle;

/// One patch of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "patches are made where they are used")]
pub enum Patch {
    /// C0, three corners.
    Triangle(NagataTriangle),
    /// C0, four corners.
    Quad(NagataQuad),
    /// G1, three corners.
    TangentPlane(G1Triangle),
}

/// A surface of Nagata patches over a mesh with normals.
///
/// It stores what neighbours share, the curve of each edge, computed once with the lower vertex id
/// first. Patches are put together when they are asked for; those of neighbours agree along their
/// edge bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct NagataSurface {
    mesh: PolygonMesh,
    normals: CornerNormals,
    settings: Settings,
    edges: EdgeBlocks,
    /// Cubic parts of the few curves that have one, ascending by edge.
    skews: Vec<(EdgeId, DVec3)>,
}

impl NagataSurface {
    /// The surface over a mesh with these normals.
    ///
    /// # Errors
    ///
    /// [`SurfaceError`] if the normals belong to another mesh, a setting is no use, or common tangent
    /// planes are asked for a quadrilateral. Numerical trouble of one edge is no error: see
    /// [`edge_status`](Self::edge_status).
    pub fn new(
        mesh: PolygonMesh,
        normals: CornerNormals,
        settings: Settings,
    ) -> Result<Self, SurfaceError> {
        settings.check()?;
        normals.check(&mesh)?;
        if settings.continuity != Continuity::Position
            && let Some(face) = mesh.faces().find(|f| mesh.corners(*f).len() == 4)
        {
            return Err(SurfaceError::Quadrilateral { face: face.index() });
        }
        let (edges, skews) = curves(&mesh, &normals, &settings, None);
        Ok(Self { mesh, normals, settings, edges, skews })
    }

    /// Moves all vertices and takes other normals, as in each step of a simulation: the surface that
    /// [`new`](Self::new) would make, in the memory of this one.
    ///
    /// # Errors
    ///
    /// [`SurfaceError`] if there is not one position for each vertex, one is not finite, or the normals belong
    /// to another mesh; then the surface stays as it is.
    pub fn update(
        &mut self,
        positions: &[DVec3],
        normals: CornerNormals,
    ) -> Result<(), SurfaceError> {
        normals.check(&self.mesh)?;
        self.mesh.set_positions(positions)?;
        self.normals = normals;
        let old = std::mem::take(&mut self.edges);
        (self.edges, self.skews) = curves(&self.mesh, &self.normals, &self.settings, Some(old));
        Ok(())
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &PolygonMesh {
        &self.mesh
    }

    /// The normals.
    #[must_use]
    pub fn normals(&self) -> &CornerNormals {
        &self.normals
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// How the curve of an edge was found.
    #[must_use]
    pub fn edge_status(&self, edge: EdgeId) -> EdgeStatus {
        self.edges.status(edge)
    }

    /// The curve of an edge, from its lower to its higher vertex.
    #[inline]
    #[must_use]
    pub fn edge_curve(&self, edge: EdgeId) -> EdgeCurve {
        let cubic = self.edges.status(edge).cubic;
        let skew = if cubic { self.skew(edge) } else { DVec3::ZERO };
        EdgeCurve { curvature: self.edges.curvature(edge), skew }
    }

    fn skew(&self, edge: EdgeId) -> DVec3 {
        let at = self.skews.binary_search_by_key(&edge, |(edge, _)| *edge);
        self.skews[at.expect("invariant: every cubic edge is listed")].1
    }

    /// The curve of a side, in its direction.
    #[inline]
    #[must_use]
    pub fn side_curve(&self, side: Side) -> EdgeCurve {
        let curve = self.edge_curve(self.mesh.edge(side));
        if self.mesh.runs_forward(side) { curve } else { curve.reversed() }
    }

    /// The normals that an edge respects at its lower and at its higher vertex.
    #[must_use]
    pub fn edge_normals(&self, edge: EdgeId) -> [Vec<DVec3>; 2] {
        normals_at(&self.mesh, &self.normals, edge)
    }

    /// How far the end tangents of an edge are from being orthogonal to the normals there: the largest
    /// `|n·x'| / |d|`, for small values the angle in radians; round-off where the normals are met.
    #[must_use]
    pub fn edge_misfit(&self, edge: EdgeId) -> f64 {
        let [start, end] = self.edge_normals(edge);
        let chord = chord(&self.mesh, edge);
        misfit(chord, &self.edge_curve(edge), EdgeNormals { start: &start, end: &end })
    }

    /// The point at parameter `u` of an edge, from its lower to its higher vertex.
    #[must_use]
    pub fn edge_point(&self, edge: EdgeId, u: f64) -> DVec3 {
        let ends = self.mesh.edge_vertices(edge).map(|v| self.mesh.position(v));
        self.edge_curve(edge).point(ends, u)
    }

    /// The patch of a face.
    #[inline]
    #[must_use]
    pub fn patch(&self, face: FaceId) -> Patch {
        match *self.mesh.corners(face) {
            [a, b, c] => self.triangle(face, [a, b, c].map(|v| self.mesh.position(v))),
            [a, b, c, d] => Patch::Quad(NagataQuad {
                corners: [a, b, c, d].map(|v| self.mesh.position(v)),
                curvature: [0, 1, 2, 3].map(|corner| self.curvature_of(face, corner)),
            }),
            _ => unreachable!("a face has three or four corners"),
        }
    }

    /// The quadratic patch of a triangle.
    #[inline]
    pub(crate) fn quadratic(&self, face: FaceId, corners: [DVec3; 3]) -> NagataTriangle {
        let curvature = [1, 2, 0].map(|corner| self.curvature_of(face, corner));
        NagataTriangle { corners, curvature }
    }

    #[inline]
    fn triangle(&self, face: FaceId, corners: [DVec3; 3]) -> Patch {
        match self.settings.continuity {
            Continuity::Position => Patch::Triangle(self.quadratic(face, corners)),
            Continuity::TangentPlane(planes) => {
                let curve = |corner| self.side_curve(Side { face, corner });
                let normal = |corner| self.normals.at(&self.mesh, face, corner);
                let (edges, given) =
                    ([curve(1), curve(2), curve(0)], [normal(0), normal(1), normal(2)]);
                let settings = &self.settings.correction;
                Patch::TangentPlane(G1Triangle::new(corners, edges, given, planes, settings))
            }
        }
    }

    #[inline]
    fn curvature_of(&self, face: FaceId, corner: usize) -> DVec3 {
        self.edges.curvature(self.mesh.edge(Side { face, corner }))
    }

    /// Bytes on the heap, without what allocators add.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.mesh.bytes() + self.normals.bytes() + self.edges.bytes() + size_of_val(&*self.skews)
    }
}

/// What a surface stores for its edges, in the memory of `old`.
fn curves(
    mesh: &PolygonMesh,
    normals: &CornerNormals,
    settings: &Settings,
    old: Option<EdgeBlocks>,
) -> (EdgeBlocks, Vec<(EdgeId, DVec3)>) {
    let solved = |edge| solve(mesh, normals, edge, settings);
    let edges = EdgeBlocks::new(mesh, normals, settings, old, |edge| {
        let (curve, status) = solved(edge);
        (curve.curvature, status)
    });
    if settings.max_misfit().is_none() {
        return (edges, Vec::new());
    }
    let cubic = mesh.edges().filter(|edge| edges.status(*edge).cubic);
    let skews = cubic.map(|edge| (edge, solved(edge).0.skew)).collect();
    (edges, skews)
}

/// The curve of an edge, from its lower to its higher vertex: the quadratic one, or a cubic one if it does
/// not meet the normals and common tangent planes are wanted.
#[cold]
fn solve(
    mesh: &PolygonMesh,
    normals: &CornerNormals,
    edge: EdgeId,
    settings: &Settings,
) -> (EdgeCurve, EdgeStatus) {
    let (one_each, any);
    let normals = if let Some(normals) = normals.one_each(mesh, edge) {
        one_each = normals;
        EdgeNormals { start: &one_each[..1], end: &one_each[1..] }
    } else {
        any = normals_at(mesh, normals, edge);
        EdgeNormals { start: &any[0], end: &any[1] }
    };
    let chord = chord(mesh, edge);
    let found = curvature_parameter(chord, normals, &settings.edges);
    let curve = EdgeCurve::quadratic(found.value);
    if let Some(most) = settings.max_misfit()
        && (found.status.lowered.is_some() || misfit(chord, &curve, normals) > most)
    {
        let cubic = EdgeCurve::cubic(chord, normals, &settings.edges);
        return (cubic, EdgeStatus { cubic: true, ..found.status });
    }
    (curve, found.status)
}

fn misfit(chord: DVec3, curve: &EdgeCurve, normals: EdgeNormals<'_>) -> f64 {
    let [start, end] = curve.end_tangents(chord);
    end_misfit(chord, start, end, normals)
}

#[inline]
fn chord(mesh: &PolygonMesh, edge: EdgeId) -> DVec3 {
    let [start, end] = mesh.edge_vertices(edge).map(|v| mesh.position(v));
    end - start
}

fn normals_at(mesh: &PolygonMesh, normals: &CornerNormals, edge: EdgeId) -> [Vec<DVec3>; 2] {
    normals
        .ids_at_edge(mesh, edge)
        .map(|ids| ids.into_iter().map(|id| normals.normal(id)).collect())
}
