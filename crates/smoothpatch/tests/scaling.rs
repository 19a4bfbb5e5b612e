//! No hidden length: everything 2¹² times as large or as small gives the same surface in large or
//! in small, bit for bit, from the field to the last control point. One tolerance without a length
//! anywhere on the way makes this fail.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use smoothpatch::implicit::{Aabb, ImplicitSurface, NamedShape};
use smoothpatch::{G1Surface, Method, Settings, Silent, fit};
use testkit::fields::Scaled;

fn run(field: &dyn ImplicitSurface, region: &Aabb, faces: usize, method: Method) -> G1Surface {
    fit(field, region, &Settings::with_faces(faces).with_method(method), &mut Silent).unwrap()
}

/// The first stage whose results are not exactly `scale` times as large.
fn first_difference(small: &G1Surface, large: &G1Surface, scale: f64) -> Option<&'static str> {
    let equal_positions = || {
        let expected = small.mesh.positions().map(|_, &p| p * scale);
        *large.mesh.positions() == expected
    };
    let equal_jets = || {
        small.jets.as_slice().iter().zip(large.jets.as_slice()).all(|(s, l)| {
            s.normal == l.normal
                && s.second_fundamental_form * (1.0 / scale) == l.second_fundamental_form
        })
    };
    let equal_curves = || {
        let expected = small.network.curves().map(|_, curve| curve.points.map(|p| p * scale));
        large.network.curves().map(|_, curve| curve.points) == expected
    };
    let equal_nets = || {
        let expected = small.patches.nets.map(|_, net| net.net().map(|p| p * scale));
        large.patches.nets.map(|_, net| *net.net()) == expected
    };
    if small.mesh.topology() != large.mesh.topology() {
        Some("connectivity of the base mesh")
    } else if !equal_positions() {
        Some("vertices of the base mesh")
    } else if !equal_jets() {
        Some("normals and second forms")
    } else if !equal_curves() {
        Some("curves")
    } else if small.patches.weights != large.patches.weights {
        Some("weight functions")
    } else if !equal_nets() {
        Some("control points")
    } else {
        None
    }
}

#[test]
fn powers_of_two_are_exact() {
    for (name, faces) in [("torus", 300), ("dodecahedron", 300), ("double-torus", 500)] {
        let shape = NamedShape::find(name).unwrap();
        let field = shape.field();
        for method in [Method::Published, Method::Refined] {
            let small = run(&*field, &shape.region, faces, method);
            for (length, value) in
                [(4096.0, 1.0), (1.0 / 4096.0, 1.0), (1.0, 1024.0), (4096.0, 1.0 / 1024.0)]
            {
                let scaled = Scaled { field: &*field, length, value };
                let region =
                    Aabb { min: shape.region.min * length, max: shape.region.max * length };
                let large = run(&scaled, &region, faces, method);
                assert_eq!(
                    first_difference(&small, &large, length),
                    None,
                    "{name}, {method:?}: lengths times {length}, values times {value}"
                );
            }
        }
    }
}
