//! Results depend on nothing but the field, the region and the number of cells.

use basemesh::TriMesh;
use implicit::glam::DVec3;
use implicit::{Aabb, BoundedField, ImplicitField, NamedShape, Sphere};

use crate::fields::{Custom, mesh_of, unbounded};

#[test]
fn exact_scaling() {
    let scale = 4096.0;
    for name in ["sphere", "torus", "deccube"] {
        let shape = NamedShape::find(name).unwrap();
        let field = shape.field();
        let shrunk = |part: &Aabb| Aabb { min: part.min / scale, max: part.max / scale };
        // values are scaled as well, by another power of two
        let scaled = Custom {
            value: |p: DVec3| field.value(p / scale) / 32.0,
            enclosure: |part: &Aabb| {
                let mut enclosure = field.enclosure(&shrunk(part));
                enclosure.lo /= 32.0;
                enclosure.hi /= 32.0;
                enclosure
            },
        };
        let region = Aabb { min: scale * shape.region.min, max: scale * shape.region.max };
        let small = mesh_of(&field, &shape.region, 41).unwrap();
        let large = mesh_of(&scaled, &region, 41).unwrap();
        assert_eq!(small.topology(), large.topology(), "{name}");
        let expected: Vec<DVec3> =
            small.positions().as_slice().iter().map(|&p| p * scale).collect();
        assert_eq!(large.positions().as_slice(), expected, "{name}");
    }
}

#[test]
fn discarding_boxes_changes_nothing() {
    for name in ["sphere", "double-torus", "deccube"] {
        let shape = NamedShape::find(name).unwrap();
        let field = shape.field();
        let sampled_everywhere = unbounded(|p| field.value(p));
        assert_eq!(
            mesh_of(&sampled_everywhere, &shape.region, 45),
            mesh_of(&field, &shape.region, 45),
            "{name}"
        );
    }
}

/// FNV-1a over all bits of a mesh.
fn digest(mesh: &TriMesh) -> u64 {
    let coordinates = mesh.positions().as_slice().iter().flat_map(DVec3::to_array);
    let indices = mesh.face_indices().into_iter().flatten().map(|i| i as u64);
    coordinates
        .map(f64::to_bits)
        .chain(indices)
        .flat_map(u64::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}

#[test]
fn the_same_bits_with_and_without_threads() {
    let mesh = || mesh_of(&Sphere::default(), &Aabb::from_half_size(1.25), 70).unwrap();
    // only operations with exactly defined rounding are involved: the same on every machine
    assert_eq!(
        digest(&mesh()),
        4_158_331_707_057_565_473,
        "the digest is written down for both features"
    );
    #[cfg(feature = "rayon")]
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(mesh), mesh(), "{threads} threads");
    }
}
