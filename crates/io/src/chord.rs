//! Surfaces to flat triangles that stay within a distance.
//!
//! Triangles in the parameters of a face are cut until their sides and centres are near enough. Sides
//! on an edge of the mesh are cut before, once for all faces of the edge, so there are no cracks:
//! whether a side is cut depends on that side alone.

mod edges;
mod error;
mod faces;
mod flatness;
mod normals;

use basemesh::{FaceId, FaceMap, Topology, VertexId};
use bezier_core::{Barycentric, BezierTriangle, Corner, LocalEdge, MultiIndex};
use glam::DVec3;

use crate::obj::Polygons;
use crate::polygon::Polygon;
use crate::samples::{CreasedTessellation, FacePoint};

pub use error::ChordError;

/// A tessellation within a distance of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChordTessellation {
    /// The triangles.
    pub tessellation: CreasedTessellation,
    /// Triangles of each face; those of one face follow each other.
    pub triangles_of_face: Vec<usize>,
    /// The largest distance that was measured: from quarters and middles of the sides and centres of
    /// the triangles, all taken on the surface, to the triangles. Unit: length.
    pub gap: f64,
}

/// Cuts each face into as many flat triangles as it takes to stay within `tolerance` of the surface,
/// a length.
///
/// `evaluate` returns the position and unit normal (or zero) of a point of a face. Vertices keep the
/// positions of the mesh; a point inside an edge is taken from the lowest face at the edge. Normals
/// are shared as in [`Samples`](crate::Samples::new). The distance is measured at a few points of each
/// triangle, see [`ChordTessellation::gap`]; between them it can be slightly larger.
///
/// # Errors
///
/// [`ChordError`] if the tolerance is no length, or so small that rounding is larger, or if points
/// are not finite.
///
/// # Panics
///
/// If an index of the mesh does not exist.
pub fn tessellate_within(
    mesh: &Polygons,
    tolerance: f64,
    evaluate: impl Fn(usize, FacePoint) -> (DVec3, DVec3),
) -> Result<ChordTessellation, ChordError> {
    if !(tolerance.is_finite() && tolerance > 0.0) {
        return Err(ChordError::Tolerance { value: tolerance });
    }
    assert_eq!(mesh.faces.len(), mesh.corner_normals.len(), "normals for each face");
    let mut edges = edges::cut_edges(mesh, tolerance, &evaluate)?;
    let mut result = ChordTessellation { gap: edges.gap, ..ChordTessellation::default() };
    let mut normals = normals::SharedNormals::default();
    for face in 0..mesh.faces.len() {
        let mut cutter = faces::FaceCutter::new(mesh, face, tolerance, &mut edges, &evaluate);
        let triangles = cutter.cut()?;
        result.gap = result.gap.max(cutter.gap);
        result.triangles_of_face.push(triangles.len());
        let points = cutter.into_points();
        let ids = normals.add(mesh, &edges, face, &points, &evaluate);
        for corners in triangles {
            result.tessellation.triangles.push(corners.map(|at| points[at].id));
            result.tessellation.triangle_normals.push(corners.map(|at| ids[at]));
        }
    }
    result.tessellation.normals = normals.finish();
    result.tessellation.positions = edges.positions;
    Ok(result)
}

/// Cuts patches into as many flat triangles as it takes to stay within `tolerance`, a length; see
/// [`tessellate_within`]. Patches that share a vertex or an edge share the normals there.
///
/// # Errors
///
/// [`ChordError`].
///
/// # Panics
///
/// If there is not one patch per face.
pub fn tessellate_patches_within<const P: usize>(
    topology: &Topology,
    nets: &FaceMap<BezierTriangle<DVec3, P>>,
    tolerance: f64,
) -> Result<ChordTessellation, ChordError> {
    assert_eq!(nets.len(), topology.face_count(), "one patch per face");
    let corners: Vec<_> =
        topology.faces().map(|face| topology.corners(face).map(VertexId::index)).collect();
    let mut positions = vec![DVec3::ZERO; topology.vertex_count()];
    let degree = BezierTriangle::<DVec3, P>::DEGREE;
    for (face, patch) in nets.iter() {
        for (corner, vertex) in Corner::ALL.into_iter().zip(corners[face.index()]) {
            let index = MultiIndex::along(LocalEdge::starting_at(corner), degree, 0, 0);
            positions[vertex] = patch[index];
        }
    }
    let smooth = |corners: &[usize; 3]| Polygon::triangle(corners.map(Some));
    let mesh = Polygons {
        normals: vec![DVec3::ZERO; positions.len()],
        positions,
        corner_normals: corners.iter().map(smooth).collect(),
        faces: corners.into_iter().map(Polygon::triangle).collect(),
    };
    tessellate_within(&mesh, tolerance, |face, at| {
        let FacePoint::Triangle(at) = at else {
            unreachable!("invariant: all faces are triangles")
        };
        let (point, area_normal) = nets[FaceId::new(face)].point_and_area_normal(at);
        (point, area_normal.normalize_or_zero())
    })
}

/// A point of a side, `t` from 0 at the corner where the side begins.
fn on_side(corners: usize, side: usize, t: f64) -> FacePoint {
    if corners == 3 {
        let edge = LocalEdge::starting_at(Corner::ALL[side]);
        return FacePoint::Triangle(Barycentric::on_edge(edge, t));
    }
    FacePoint::Quad(match side {
        0 => [t, 0.0],
        1 => [1.0, t],
        2 => [1.0 - t, 1.0],
        _ => [0.0, 1.0 - t],
    })
}

/// The point between two points of a face.
fn between(a: FacePoint, b: FacePoint, t: f64) -> FacePoint {
    let mix = |a: f64, b: f64| a * (1.0 - t) + b * t;
    match (a, b) {
        (FacePoint::Triangle(a), FacePoint::Triangle(b)) => {
            FacePoint::Triangle(Barycentric::from_array([
                mix(a.u, b.u),
                mix(a.v, b.v),
                mix(a.w, b.w),
            ]))
        }
        (FacePoint::Quad(a), FacePoint::Quad(b)) => {
            FacePoint::Quad([mix(a[0], b[0]), mix(a[1], b[1])])
        }
        _ => unreachable!("invariant: points of one face"),
    }
}
