//! The mesh converges to the surface.

use basemesh::TriMesh;
use implicit::{ImplicitField, NamedShape, Sphere};

use crate::fields::mesh_of;
use implicit::Aabb;

/// Volume by the divergence theorem; positive if triangles are counter-clockwise seen from outside.
fn volume(mesh: &TriMesh) -> f64 {
    mesh.topology()
        .faces()
        .map(|face| {
            let [a, b, c] = mesh.triangle(face);
            a.dot(b.cross(c)) / 6.0
        })
        .sum()
}

/// Orders of decrease between successive refinements by two.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

#[test]
fn volume_of_the_sphere_converges_with_order_two() {
    let exact = 4.0 / 3.0 * std::f64::consts::PI;
    let errors = [16, 32, 64, 128].map(|cells| {
        let mesh = mesh_of(&Sphere::default(), &Aabb::from_half_size(1.3), cells).unwrap();
        let volume = volume(&mesh);
        assert!(volume > 0.0 && volume < exact, "{cells} cells: inscribed, volume {volume}");
        exact - volume
    });
    for order in orders(&errors) {
        assert!((order - 2.0).abs() < 0.1, "errors {errors:?}");
    }
}

#[test]
fn quadratic_surfaces_have_their_vertices_on_them() {
    // the parabola through three values is exact
    let mesh = mesh_of(&Sphere::default(), &Aabb::from_half_size(1.3), 40).unwrap();
    let worst =
        mesh.positions().as_slice().iter().map(|p| (p.length() - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst < 64.0 * f64::EPSILON, "a vertex is {worst} away");
}

#[test]
fn vertices_converge_to_the_surface() {
    let shape = NamedShape::find("deccube").unwrap();
    let field = shape.field();
    let errors = [32, 64, 128, 256].map(|cells| {
        let mesh = mesh_of(&field, &shape.region, cells).unwrap();
        let squared = mesh.positions().as_slice().iter().map(|&p| {
            let (value, gradient) = field.value_gradient(p);
            (value / gradient.length()).powi(2)
        });
        (squared.sum::<f64>() / mesh.positions().len() as f64).sqrt()
    });
    // 4, but 3 for the share of edges that are almost tangent, which is proportional to the cell size
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!(order > 3.3, "order {order}, root mean square distances {errors:?}");
}
