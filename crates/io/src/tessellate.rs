//! Patches to flat triangles without cracks.

use basemesh::{FaceMap, Topology};
use bezier_core::{Barycentric, BezierTriangle, MultiIndex};
use glam::DVec3;

use crate::lattice::Lattice;

/// A triangle mesh that approximates a patch surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tessellation {
    /// Points on the surface. The first ones are the vertices of the patch surface, in id order.
    pub positions: Vec<DVec3>,
    /// Unit normal at each point; zero where every patch at the point is singular.
    pub normals: Vec<DVec3>,
    /// Corners of each triangle, counter-clockwise seen from outside. The triangles of one patch
    /// follow each other, `divisions²` of them, in face order.
    pub triangles: Vec<[usize; 3]>,
}

/// Cuts every patch into `divisions²` triangles.
///
/// Corners are taken once per vertex, edge points are evaluated once per edge (on the patch of the
/// canonical half-edge), so neighbours use the same points and a closed surface stays closed. The
/// normal at a shared point is the normalised sum of the unit normals of the patches there; on a G1
/// surface they are equal.
///
/// # Panics
///
/// If `divisions` is zero or there is not one patch per face.
#[must_use]
pub fn tessellate<const P: usize>(
    topology: &Topology,
    nets: &FaceMap<BezierTriangle<DVec3, P>>,
    divisions: usize,
) -> Tessellation {
    assert_eq!(nets.len(), topology.face_count(), "one patch per face");
    let lattice = Lattice::new(topology, divisions);
    let parameters: Vec<_> = Barycentric::lattice(divisions).collect();
    let pattern = triangle_pattern(divisions);
    let mut positions = vec![DVec3::ZERO; lattice.point_count()];
    let mut normals = vec![DVec3::ZERO; lattice.point_count()];
    let mut triangles = Vec::with_capacity(pattern.len() * nets.len());
    for (face, patch) in nets.iter() {
        for (rank, &at) in parameters.iter().enumerate() {
            let (id, owner) = lattice.locate(face, rank);
            let (point, area_normal) = patch.point_and_area_normal(at);
            if owner == face {
                positions[id] = lattice.corner_of(patch, rank).unwrap_or(point);
            }
            normals[id] += area_normal.normalize_or_zero();
        }
        triangles.extend(pattern.iter().map(|t| t.map(|rank| lattice.locate(face, rank).0)));
    }
    for normal in &mut normals {
        *normal = normal.normalize_or_zero();
    }
    Tessellation { positions, normals, triangles }
}

/// The largest distance between the flat triangles of [`tessellate`] and the patches at the same
/// parameters: at the middles of their sides and at their centres.
///
/// # Panics
///
/// If `flat` is not the tessellation of these patches with these divisions.
#[must_use]
pub fn tessellation_gap<const P: usize>(
    nets: &FaceMap<BezierTriangle<DVec3, P>>,
    divisions: usize,
    flat: &Tessellation,
) -> f64 {
    let parameters: Vec<_> = Barycentric::lattice(divisions).map(Barycentric::to_array).collect();
    let pattern = triangle_pattern(divisions);
    let third = 1.0 / 3.0;
    let places = [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [third; 3]];
    assert_eq!(flat.triangles.len(), pattern.len() * nets.len(), "triangles of each patch");
    let mut gap: f64 = 0.0;
    for ((_, patch), triangles) in nets.iter().zip(flat.triangles.chunks_exact(pattern.len())) {
        for (ranks, corners) in pattern.iter().zip(triangles) {
            let [a, b, c] = corners.map(|id| flat.positions[id]);
            for [u, v, w] in places {
                let [p, q, r] = ranks.map(|rank| parameters[rank]);
                let at = std::array::from_fn(|k| p[k] * u + q[k] * v + r[k] * w);
                let on_patch = patch.eval(Barycentric::from_array(at));
                gap = gap.max(on_patch.distance(a * u + b * v + c * w));
            }
        }
    }
    gap
}

/// Ranks of the corners of the small triangles in one face.
pub(crate) fn triangle_pattern(divisions: usize) -> Vec<[usize; 3]> {
    let raised = |m: MultiIndex, i, j, k| MultiIndex::new(m.i + i, m.j + j, m.k + k).rank();
    let upright = MultiIndex::all(divisions - 1)
        .map(|m| [raised(m, 1, 0, 0), raised(m, 0, 1, 0), raised(m, 0, 0, 1)]);
    let mut pattern: Vec<_> = upright.collect();
    if divisions >= 2 {
        let inverted = MultiIndex::all(divisions - 2)
            .map(|m| [raised(m, 0, 1, 1), raised(m, 1, 0, 1), raised(m, 1, 1, 0)]);
        pattern.extend(inverted);
    }
    pattern
}
