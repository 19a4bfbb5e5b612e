//! Second fundamental forms that agree with positions and normals along edges.
//!
//! Estimated forms may contradict estimated normals, and on nearly flat edges the quartic curves, which
//! must meet both, then get end tangents of absurd lengths. Along an edge, positions and normals at both
//! ends say what the curvature must be about: with the chord's elevations `β` over the tangent planes and
//! the length `L` of the arc, the cubic through them has at its start the curvature `(4 β_a + 2 β_b) / L`.
//! It is exact on circles, elsewhere of second order.

use basemesh::glam::{DMat3, DVec3};
use basemesh::{HalfedgeId, TriMesh, VertexId, VertexMap};
use bezier_core::SurfaceJet;

/// Forms whose curvatures along all edges differ by no more than this part of the largest one stay.
const AGREEMENT: f64 = 0.05;
/// Weight of the given form against one edge.
const INERTIA: f64 = 1e-2;

/// The same jets with other forms at vertices where these contradict the edges: the nearest ones, by
/// least squares, to what the edges say.
pub(crate) fn reconciled(mesh: &TriMesh, jets: &VertexMap<SurfaceJet>) -> VertexMap<SurfaceJet> {
    jets.map(|vertex, jet| {
        let form = jet.second_fundamental_form + correction(mesh, jets, vertex);
        SurfaceJet { second_fundamental_form: form, ..*jet }
    })
}

fn correction(mesh: &TriMesh, jets: &VertexMap<SurfaceJet>, vertex: VertexId) -> DMat3 {
    let jet = &jets[vertex];
    let (x, y) = jet.normal.any_orthonormal_pair();
    let (mut largest, mut difference) = (0.0_f64, 0.0_f64);
    let mut matrix = DMat3::from_diagonal(DVec3::splat(INERTIA));
    let mut rhs = DVec3::ZERO;
    for h in mesh.topology().fan(vertex) {
        let Some((tangent, wanted)) = along_edge(mesh, jets, h) else { continue };
        let given = jet.normal_curvature(tangent);
        let (u, v) = (tangent.dot(x), tangent.dot(y));
        let row = DVec3::new(u * u, 2.0 * u * v, v * v);
        matrix += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        rhs += row * (wanted - given);
        largest = largest.max(wanted.abs()).max(given.abs());
        difference = difference.max((wanted - given).abs());
    }
    if difference <= AGREEMENT * largest {
        return DMat3::ZERO;
    }
    let change = matrix.inverse() * rhs;
    let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
    let form =
        outer(x, x) * change.x + (outer(x, y) + outer(y, x)) * change.y + outer(y, y) * change.z;
    if form.is_finite() { form } else { DMat3::ZERO }
}

/// The unit tangent at the start of a half-edge towards its end, and the normal curvature that positions
/// and normals at both ends ask for in this direction.
fn along_edge(mesh: &TriMesh, jets: &VertexMap<SurfaceJet>, h: HalfedgeId) -> Option<(DVec3, f64)> {
    let topology = mesh.topology();
    let [start, end] = [topology.origin(h), topology.target(h)];
    let chord = mesh.position(end) - mesh.position(start);
    let direction = chord.try_normalize()?;
    let [at_start, at_end] =
        [start, end].map(|v| jets[v].normal.dot(direction).clamp(-1.0, 1.0).asin());
    let half_turn = 0.5 * (at_start - at_end);
    let stretch = if half_turn == 0.0 { 1.0 } else { half_turn / half_turn.sin() };
    let curvature = (4.0 * at_start + 2.0 * at_end) / (chord.length() * stretch);
    let tangent = jets[start].tangential(direction).try_normalize()?;
    curvature.is_finite().then_some((tangent, curvature))
}

#[cfg(test)]
mod tests {
    use testkit::meshes::{icosphere, torus_grid};

    use super::*;

    /// A sphere's jets, with forms that are off by a part of the curvature.
    fn sphere(off: f64) -> (TriMesh, VertexMap<SurfaceJet>) {
        let mesh = icosphere(2);
        let jets = mesh.positions().map(|_, &point| {
            let normal = point.normalize();
            let outer = DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
            let second_fundamental_form = (outer - DMat3::IDENTITY) * (1.0 + off);
            SurfaceJet { point, normal, second_fundamental_form }
        });
        (mesh, jets)
    }

    #[test]
    fn a_sphere_is_restored() {
        let (mesh, exact) = sphere(0.0);
        let (_, wrong) = sphere(0.3);
        for (v, jet) in reconciled(&mesh, &wrong).iter() {
            for curvature in jet.principal_curvatures() {
                assert!((curvature + 1.0).abs() < 2e-3, "vertex {v}: {curvature}");
            }
        }
        assert_eq!(reconciled(&mesh, &exact), exact, "what agrees stays");
        let (_, nearly) = sphere(0.04);
        assert_eq!(reconciled(&mesh, &nearly), nearly, "small differences stay");
    }

    #[test]
    fn edges_of_a_flat_circle_of_a_torus_stay_flat() {
        let mesh = torus_grid([3.0, 1.0], 24, 12);
        let jets = mesh.positions().map(|_, &point| {
            let ring = DVec3::new(point.x, point.y, 0.0).normalize() * 3.0;
            let normal = (point - ring).normalize();
            let (x, y) = normal.any_orthonormal_pair();
            let outer = |a: DVec3| DMat3::from_cols(a * a.x, a * a.y, a * a.z);
            // a saddle everywhere, which is wrong
            let second_fundamental_form = outer(x) - outer(y);
            SurfaceJet { point, normal, second_fundamental_form }
        });
        for (v, jet) in reconciled(&mesh, &jets).iter() {
            let ring = DVec3::new(jet.point.x, jet.point.y, 0.0).normalize();
            let along = DVec3::Z.cross(ring);
            let expected = -jet.normal.dot(ring) / jet.point.dot(ring);
            assert!((jet.normal_curvature(along) - expected).abs() < 0.05, "vertex {v}");
            let across = jet.normal.cross(along);
            assert!((jet.normal_curvature(across) + 1.0).abs() < 0.05, "vertex {v}");
        }
    }
}
