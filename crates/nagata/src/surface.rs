//! Surfaces: patches over a mesh that share their edge curves.

use basemesh::{EdgeId, EdgeMap, FaceId};
use glam::DVec3;

use crate::corner_normals::CornerNormals;
use crate::curvature_parameter::{
    CurvatureParameter, EdgeNormals, EdgeStatus, curvature_parameter, end_misfit, one_each,
};
use crate::edge_curve::EdgeCurve;
use crate::error::SurfaceError;
use crate::ids::Side;
use crate::polygon_mesh::PolygonMesh;
use crate::quad::NagataQuad;
use crate::settings::{Continuity, Settings, TangentPlanes};
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
    edges: EdgeMap<SolvedEdge>,
    /// Cubic parts of the few curves that have one, ascending by edge.
    skews: Vec<(EdgeId, DVec3)>,
}

/// What is stored for an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SolvedEdge {
    curvature: DVec3,
    status: EdgeStatus,
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
        let edges = EdgeMap::from_fn(mesh.edge_count(), |edge| {
            let (curve, status) = solve(&mesh, &normals, edge, &settings);
            SolvedEdge { curvature: curve.curvature, status }
        });
        let cubic = edges.iter().filter(|(_, edge)| edge.status.cubic).map(|(id, _)| id);
        let skews = cubic.map(|id| (id, solve(&mesh, &normals, id, &settings).0.skew)).collect();
        Ok(Self { mesh, normals, settings, edges, skews })
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
        self.edges[edge].status
    }

    /// The curve of an edge, from its lower to its higher vertex.
    #[inline]
    #[must_use]
    pub fn edge_curve(&self, edge: EdgeId) -> EdgeCurve {
        let SolvedEdge { curvature, status } = self.edges[edge];
        EdgeCurve { curvature, skew: if status.cubic { self.skew(edge) } else { DVec3::ZERO } }
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
        self.edges[self.mesh.edge(Side { face, corner })].curvature
    }

    /// Bytes on the heap, without what allocators add.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.mesh.bytes()
            + self.normals.bytes()
            + size_of_val(self.edges.as_slice())
            + size_of_val(&*self.skews)
    }
}

/// The curve of an edge, from its lower to its higher vertex.
#[inline(always)]
fn solve(
    mesh: &PolygonMesh,
    normals: &CornerNormals,
    edge: EdgeId,
    settings: &Settings,
) -> (EdgeCurve, EdgeStatus) {
    let chord = chord(mesh, edge);
    if let Some([start, end]) = normals.one_each(mesh, edge) {
        let found = one_each(chord, [start, end], &settings.edges);
        if settings.continuity != Continuity::TangentPlane(TangentPlanes::Robust) {
            return (EdgeCurve::quadratic(found.value), found.status);
        }
        return replaced(chord, EdgeNormals { start: &[start], end: &[end] }, found, settings);
    }
    let [start, end] = normals_at(mesh, normals, edge);
    let ends = EdgeNormals { start: &start, end: &end };
    replaced(chord, ends, curvature_parameter(chord, ends, &settings.edges), settings)
}

/// The quadratic curve, or a cubic one if it does not meet the normals and common tangent planes are
/// wanted.
#[inline]
fn replaced(
    chord: DVec3,
    normals: EdgeNormals<'_>,
    found: CurvatureParameter,
    settings: &Settings,
) -> (EdgeCurve, EdgeStatus) {
    let curve = EdgeCurve::quadratic(found.value);
    if settings.continuity == Continuity::TangentPlane(TangentPlanes::Robust) {
        let missed = || misfit(chord, &curve, normals) > settings.correction.max_misfit;
        if found.status.lowered.is_some() || missed() {
            let cubic = EdgeCurve::cubic(chord, normals, &settings.edges);
            return (cubic, EdgeStatus { cubic: true, ..found.status });
        }
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
