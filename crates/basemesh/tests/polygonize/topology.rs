//! Known surfaces have their known topology at every sensible resolution.

use crate::fields::{Custom, mesh_of};
use implicit::glam::DVec3;
use implicit::{Aabb, BoundedField, Formula, ImplicitField, Interval, NamedShape, Sphere};

struct Case {
    name: &'static str,
    euler_characteristic: i64,
    cells: &'static [usize],
}

#[test]
fn euler_characteristic_of_named_shapes() {
    let cases = [
        Case { name: "sphere", euler_characteristic: 2, cells: &[3, 10, 31, 64] },
        Case { name: "ellipsoid", euler_characteristic: 2, cells: &[12, 32, 63] },
        Case { name: "torus", euler_characteristic: 0, cells: &[20, 48, 77] },
        Case { name: "double-torus", euler_characteristic: -2, cells: &[40, 64, 101] },
        Case { name: "dodecahedron", euler_characteristic: 2, cells: &[24, 48, 64] },
        Case { name: "mcmullen", euler_characteristic: 2, cells: &[24, 48, 64] },
        Case { name: "chair", euler_characteristic: -4, cells: &[40, 64, 90] },
        Case { name: "deccube", euler_characteristic: -24, cells: &[40, 64, 96, 128] },
    ];
    for Case { name, euler_characteristic, cells } in cases {
        let shape = NamedShape::find(name).unwrap();
        for &cells in cells {
            let mesh = mesh_of(&shape.field(), &shape.region, cells)
                .unwrap_or_else(|error| panic!("{name} with {cells} cells: {error}"));
            let topology = mesh.topology();
            let found = (topology.euler_characteristic(), topology.component_count());
            assert_eq!(found, (euler_characteristic, 1), "{name} with {cells} cells");
            assert!(topology.is_closed(), "{name} with {cells} cells");
        }
    }
}

#[test]
fn all_components_are_found() {
    let cases = [
        ("min((x-1.5)^2+y^2+z^2-1, (x+1.5)^2+y^2+z^2-0.04)", 2),
        // a ball in a hollow ball
        ("min((x^2+y^2+z^2-4)*(x^2+y^2+z^2-1), x^2+y^2+z^2-0.25)", 3),
        // 4 x 4 x 4 balls
        ("cos(3*x)^2+cos(3*y)^2+cos(3*z)^2-0.5+max(0,x^2-4)+max(0,y^2-4)+max(0,z^2-4)", 64),
    ];
    for (text, components) in cases {
        let field = Formula::parse(text).unwrap();
        let mesh = mesh_of(&field, &Aabb::from_half_size(3.0), 90).unwrap();
        let topology = mesh.topology();
        assert_eq!(topology.component_count(), components, "{text}");
        assert_eq!(topology.euler_characteristic(), 2 * components as i64, "{text}");
    }
}

#[test]
fn surface_is_followed_where_the_enclosure_is_wrong() {
    let sphere = Sphere::default();
    let region = Aabb::from_half_size(1.5);
    let wrong = Custom {
        value: |p| sphere.value(p),
        // the truth near the pole only
        enclosure: |part: &Aabb| {
            if part.contains(DVec3::X) {
                sphere.enclosure(part)
            } else {
                Interval { lo: 1.0, hi: 2.0 }
            }
        },
    };
    assert_eq!(mesh_of(&wrong, &region, 40), mesh_of(&sphere, &region, 40));
}

#[test]
fn a_flat_region_of_few_cells() {
    let flat = Aabb { min: DVec3::new(-1.5, -1.5, -0.2), max: DVec3::new(1.5, 1.5, 0.2) };
    let lens = Formula::parse("x^2+y^2+100*z^2-1").unwrap();
    let mesh = mesh_of(&lens, &flat, 31).unwrap();
    assert_eq!(mesh.topology().euler_characteristic(), 2);
}
