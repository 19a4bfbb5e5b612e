//! Figures of a whole mesh.

use glam::DVec3;

use super::{angle_between, edge_turning, projected_edge, triangle_quality};
use crate::ids::VertexId;
use crate::maps::{EdgeMap, FaceMap, VertexMap};
use crate::mesh::TriMesh;

/// What a G1 construction wants to know about its base mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct MeshQuality {
    /// Smallest angle of a triangle, degrees.
    pub min_angle_deg: f64,
    /// Largest angle of a triangle, degrees.
    pub max_angle_deg: f64,
    /// Smallest triangle quality, see [`triangle_quality`](crate::triangle_quality); in 0..=1.
    pub min_quality: f64,
    /// Mean triangle quality, in 0..=1.
    pub mean_quality: f64,
    /// Largest angle between the surface normals at the ends of an edge, degrees.
    pub max_turning_deg: f64,
    /// How evenly the two faces of an edge share the tangent plane at its ends: the smaller of both
    /// projected areas over their sum, smallest over all edges and ends.
    ///
    /// Zero or less where a fan folds back. It is min(λ₀, 1 - λ₀) of the G1 condition, taken with
    /// straight edges instead of curves. Boundary edges do not count.
    pub min_fan_share: f64,
    /// Number of vertices by valence: `valences[k]` vertices have `k` faces.
    pub valences: Vec<usize>,
}

impl MeshQuality {
    /// Measures a mesh with one unit surface normal per vertex.
    ///
    /// # Panics
    ///
    /// If there is not one normal per vertex.
    #[must_use]
    pub fn measure(mesh: &TriMesh, normals: &VertexMap<DVec3>) -> Self {
        let t = mesh.topology();
        assert_eq!(normals.len(), t.vertex_count(), "one normal per vertex");
        let angles = FaceMap::from_fn(t.face_count(), |f| angle_range(mesh.triangle(f)));
        let qualities = FaceMap::from_fn(t.face_count(), |f| triangle_quality(mesh.triangle(f)));
        let turnings = EdgeMap::from_fn(t.edge_count(), |e| edge_turning(mesh, normals, e));
        let shares = VertexMap::from_fn(t.vertex_count(), |v| fan_share(mesh, v, normals[v]));
        let sum: f64 = qualities.as_slice().iter().sum();
        Self {
            min_angle_deg: smallest(angles.as_slice().iter().map(|a| a[0])).to_degrees(),
            max_angle_deg: largest(angles.as_slice().iter().map(|a| a[1])).to_degrees(),
            min_quality: smallest(qualities.as_slice().iter().copied()),
            mean_quality: sum / qualities.len() as f64,
            max_turning_deg: largest(turnings.as_slice().iter().copied()).to_degrees(),
            min_fan_share: smallest(shares.as_slice().iter().copied()),
            valences: valence_histogram(mesh),
        }
    }
}

fn smallest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::NEG_INFINITY, f64::max)
}

/// Smallest and largest angle of a triangle in radians.
fn angle_range(triangle: [DVec3; 3]) -> [f64; 2] {
    let angles = [0, 1, 2].map(|k| {
        let [p, q, r] = [0, 1, 2].map(|i| triangle[(k + i) % 3]);
        angle_between(q - p, r - p)
    });
    [smallest(angles.into_iter()), largest(angles.into_iter())]
}

fn fan_share(mesh: &TriMesh, v: VertexId, normal: DVec3) -> f64 {
    let t = mesh.topology();
    let area = |h: crate::ids::HalfedgeId| {
        let [first, second] = [h, h.previous()].map(|g| projected_edge(mesh, v, g, normal));
        first.cross(second).dot(normal)
    };
    let share = |h| {
        let right = t.rotated_cw(h)?;
        let (left, right) = (area(h), area(right));
        let total = left.abs() + right.abs();
        Some(if total > 0.0 { left.min(right) / total } else { 0.0 })
    };
    // half a share is what a symmetric fan has
    smallest(t.fan(v).filter_map(share).chain([0.5]))
}

fn valence_histogram(mesh: &TriMesh) -> Vec<usize> {
    let t = mesh.topology();
    let mut histogram = Vec::new();
    for v in t.vertices() {
        let valence = t.valence(v);
        if histogram.len() <= valence {
            histogram.resize(valence + 1, 0);
        }
        histogram[valence] += 1;
    }
    histogram
}
