//! Jets of degree 1: for vertices whose neighbours no polynomial fits.
//!
//! The normal is the mean of the faces. Curvatures are those that normals at both ends ask for along
//! the edges: with the chord's elevations `β` over the tangent planes and the length `L` of the arc,
//! the cubic through them has at its start the curvature `(4 β_a + 2 β_b) / L`.

use basemesh::{TriMesh, VertexId, VertexMap};
use glam::{DMat3, DVec3};

use crate::jet::{FitQuality, VertexJet};
use crate::polynomial::Polynomial;
use crate::rings::neighbours;

/// Weight of no curvature at all against that of one edge.
const INERTIA: f64 = 1e-2;
/// Largest curvature times the mean length of the edges; on a circle, an edge over 120° has 1.7.
const MOST_BEND: f64 = 1.5;

/// The jet of degree 1 at a vertex; `None` if a number is not finite.
pub(crate) fn plain_jet(
    mesh: &TriMesh,
    normals: &VertexMap<DVec3>,
    vertex: VertexId,
) -> Option<VertexJet> {
    let origin = mesh.position(vertex);
    let normal = normals[vertex];
    let (x, y) = normal.any_orthonormal_pair();
    let around = neighbours(mesh, vertex, 1, |_, _| true).vertices;
    let offsets: Vec<DVec3> = around.iter().map(|&v| mesh.position(v) - origin).collect();
    let length = offsets.iter().map(|o| o.length()).sum::<f64>() / offsets.len() as f64;
    let radius = offsets.iter().map(|o| o.length()).fold(0.0, f64::max);

    let mut matrix = DMat3::from_diagonal(DVec3::splat(INERTIA));
    let mut rhs = DVec3::ZERO;
    for (&v, &offset) in around.iter().zip(&offsets) {
        let Some(direction) = offset.try_normalize() else { continue };
        let tangent = direction - normal * normal.dot(direction);
        let Some(tangent) = tangent.try_normalize() else { continue };
        let (u, w) = (tangent.dot(x), tangent.dot(y));
        let row = DVec3::new(u * u, 2.0 * u * w, w * w);
        matrix += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        rhs += row * curvature_along(normal, normals[v], offset, direction);
    }
    let form = matrix.inverse() * rhs;
    let most = largest_curvature(form);
    let limit = MOST_BEND / length;
    let form = if most > limit { form * (limit / most) } else { form };

    let second = [0.5 * form.x, form.y, 0.5 * form.z].map(|c| c * radius);
    let polynomial = Polynomial::new(2, &[0.0, 0.0, second[0], second[1], second[2]]);
    let is_finite = second.iter().all(|c| c.is_finite()) && radius > 0.0;
    let quality = FitQuality {
        degree: 1,
        points: around.len(),
        rings: 1,
        condition: 1.0,
        residual: 0.0,
        normal_error: 0.0,
        radius,
    };
    let mut jet = VertexJet { origin, axes: [x, y, normal], polynomial, quality };
    let square = |&v: &VertexId| (jet.height(mesh.position(v).to_array()) / radius).powi(2);
    let squares: f64 = around.iter().map(square).sum();
    jet.quality.residual = (squares / around.len() as f64).sqrt();
    is_finite.then_some(jet)
}

/// The curvature at the start of an edge that positions and normals at both ends ask for.
fn curvature_along(start: DVec3, end: DVec3, chord: DVec3, direction: DVec3) -> f64 {
    let [at_start, at_end] = [start, end].map(|n| n.dot(direction).clamp(-1.0, 1.0).asin());
    let half_turn = 0.5 * (at_start - at_end);
    let stretch = if half_turn == 0.0 { 1.0 } else { half_turn / half_turn.sin() };
    (4.0 * at_start + 2.0 * at_end) / (chord.length() * stretch)
}

/// The larger principal curvature, without its sign, of the form with these entries.
fn largest_curvature(form: DVec3) -> f64 {
    let (mean, half) = (0.5 * (form.x + form.z), 0.5 * (form.x - form.z));
    mean.abs() + half.hypot(form.y)
}
