//! Improvement, local refinement and the measures that both are judged by.

use basemesh::glam::DVec3;
use basemesh::{
    EdgeId, ImproveError, ImproveSettings, MeshQuality, SplitError, TriMesh, VertexId, VertexMap,
    edge_turning, improve, invalid_fans, split_edges, triangle_quality,
};
use proptest::prelude::*;

use crate::support::{
    Above, Spheres, Torus, largest_distance, map_positions, noise, sphere_mesh, torus_mesh,
};

const TORUS: Torus = Torus { major: 1.0, minor: 0.4 };

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Noise along the surface makes slivers; improvement must not lose faces, topology or the
    /// surface, and must leave better triangles.
    #[test]
    fn noisy_tori_get_better(seed: u64, size in 0.1..0.4) {
        let mesh = torus_mesh(&TORUS, 40, 20);
        let mesh = map_positions(mesh, |i, p| p + 0.15 * size * noise(seed, i));
        let before = improve(&mesh, &TORUS, &ImproveSettings { rounds: 0, ..ImproveSettings::default() })
            .unwrap();
        let after = improve(&mesh, &TORUS, &ImproveSettings::default()).unwrap();
        prop_assert_eq!(after.mesh.topology().face_count(), mesh.topology().face_count());
        prop_assert_eq!(after.mesh.topology().euler_characteristic(), 0);
        prop_assert!(largest_distance(&after.mesh, &TORUS) < 1e-12);
        let [a, b] = [&before, &after].map(|i| MeshQuality::measure(&i.mesh, &i.normals));
        prop_assert!(b.min_quality > a.min_quality, "{} {}", a.min_quality, b.min_quality);
        prop_assert!(b.max_turning_deg <= a.max_turning_deg.max(50.0) + 1e-6);
        prop_assert!(after.report.flips > 0 && after.report.moves > 0);
    }

    #[test]
    fn split_edges_conform(picks in prop::collection::vec(0_usize..1200, 1..60)) {
        let mesh = torus_mesh(&TORUS, 20, 20);
        let edges: Vec<EdgeId> = picks.into_iter().map(EdgeId::new).collect();
        let split = split_edges(&mesh, &TORUS, &edges).unwrap();
        let mut unique = edges.clone();
        unique.sort_unstable();
        unique.dedup();
        let (old, new) = (mesh.topology(), split.topology());
        prop_assert_eq!(new.vertex_count(), old.vertex_count() + unique.len());
        prop_assert_eq!(new.face_count(), old.face_count() + 2 * unique.len());
        prop_assert_eq!(new.euler_characteristic(), 0);
        prop_assert!(new.is_closed());
        for v in old.vertices() {
            prop_assert_eq!(split.position(v), mesh.position(v), "old vertices stay");
        }
        prop_assert!(largest_distance(&split, &TORUS) < 1e-14);
        let mut backwards = edges;
        backwards.reverse();
        prop_assert_eq!(split_edges(&mesh, &TORUS, &backwards).unwrap(), split);
    }
}

#[test]
fn all_edges_of_a_sphere() {
    let mesh = sphere_mesh(4, DVec3::ZERO);
    let edges: Vec<EdgeId> = mesh.topology().edges().collect();
    let split = split_edges(&mesh, &Spheres::unit(), &edges).unwrap();
    assert_eq!(split.topology().face_count(), 4 * mesh.topology().face_count());
    let normals = split.positions().clone();
    assert_eq!(invalid_fans(&split, &normals), [], "fans stay in order");
}

#[test]
fn refused_splits_name_the_edge() {
    let sphere = Spheres::unit();
    let target = Above { inner: &sphere, floor: 0.0 };
    let mesh = sphere_mesh(1, DVec3::ZERO);
    let missing = split_edges(&mesh, &sphere, &[EdgeId::new(12)]).unwrap_err();
    assert_eq!(missing, SplitError::MissingEdge { edge: 12, count: 12 });
    let low = mesh
        .topology()
        .edges()
        .find(|&e| mesh.topology().edge_vertices(e).iter().any(|&v| mesh.position(v).z < 0.0));
    let refused = split_edges(&mesh, &target, &[low.unwrap()]).unwrap_err();
    assert!(matches!(refused, SplitError::NoFoot { .. }), "{refused}");
}

#[test]
fn open_meshes_can_be_split_but_not_improved() {
    let plane = sphere_mesh(1, DVec3::ZERO);
    let open = TriMesh::new(plane.positions().as_slice()[..3].to_vec(), &[[0, 1, 2]]).unwrap();
    let refused = improve(&open, &Spheres::unit(), &ImproveSettings::default()).unwrap_err();
    assert_eq!(refused, ImproveError::Open { a: 0, b: 1 });
    let edges: Vec<EdgeId> = open.topology().edges().collect();
    for count in 1..=3 {
        let split = split_edges(&open, &Spheres::unit(), &edges[..count]).unwrap();
        assert_eq!(split.topology().face_count(), 1 + count);
        assert_eq!(split.topology().euler_characteristic(), 1);
    }
}

/// A hexagonal pyramid, flat or steep, as the fan of vertex 0.
fn hexagon(angles_deg: [f64; 6], height: f64) -> (TriMesh, VertexMap<DVec3>) {
    let rim = angles_deg.map(|a| DVec3::new(a.to_radians().cos(), a.to_radians().sin(), height));
    let mut positions = vec![DVec3::ZERO];
    positions.extend(rim);
    positions.push(DVec3::new(0.0, 0.0, -5.0));
    let mut faces = Vec::new();
    for k in 0..6 {
        let (a, b) = (1 + k, 1 + (k + 1) % 6);
        faces.extend([[0, a, b], [7, b, a]]);
    }
    let mesh = TriMesh::new(positions, &faces).unwrap();
    let normals = mesh.positions().map(|v, p| match v.index() {
        0 => DVec3::Z,
        7 => -DVec3::Z,
        _ => p.with_z(0.0).normalize(),
    });
    (mesh, normals)
}

#[test]
fn planted_bad_fans_are_found() {
    let is_bad = |angles: [f64; 6], scale: f64| {
        let (mesh, normals) = hexagon(angles, 0.0);
        let mesh = map_positions(mesh, |_, p| scale * p);
        invalid_fans(&mesh, &normals).contains(&VertexId::new(0))
    };
    for scale in [1.0, 1e-9, 1e9] {
        let regular = [0.0, 60.0, 120.0, 180.0, 240.0, 300.0];
        assert!(!is_bad(regular, scale), "regular");
        assert!(!is_bad([0.0, 1.0, 2.0, 3.0, 170.0, 250.0], scale), "crowded but in order");
        assert!(is_bad([0.0, 60.0, 50.0, 180.0, 240.0, 300.0], scale), "two edges out of order");
        assert!(is_bad([0.0, 60.0, 60.0, 180.0, 240.0, 300.0], scale), "two edges alike");
        assert!(is_bad([0.0, 10.0, 20.0, 30.0, 100.0, 170.0], scale), "more than half a turn open");
        assert!(is_bad([0.0, 120.0, 240.0, 0.0, 120.0, 240.0], scale), "twice around");
    }
}

#[test]
fn measures_of_known_meshes() {
    let mesh = sphere_mesh(1, DVec3::ZERO);
    let q = MeshQuality::measure(&mesh, &mesh.positions().clone());
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}");
    close(q.min_angle_deg, 60.0);
    close(q.max_angle_deg, 60.0);
    close(q.max_turning_deg, 90.0);
    close(q.min_quality, 1.0);
    close(q.mean_quality, 1.0);
    close(q.min_fan_share, 0.5);
    assert_eq!(q.valences, [0, 0, 0, 0, 6]);
    // 3-4-5
    close(
        triangle_quality([DVec3::ZERO, 4.0 * DVec3::X, 3.0 * DVec3::Y]),
        2.0 * 3.0_f64.sqrt() * 12.0 / 50.0,
    );
    assert!(triangle_quality([DVec3::X; 3]).abs() < f64::EPSILON, "a point");
    // an angle far below the resolution of an arc cosine
    let mut normals = mesh.positions().clone();
    let [a, b] = mesh.topology().edge_vertices(EdgeId::new(0));
    normals[b] = (normals[a] + 1e-10 * normals[b]).normalize();
    let turning = edge_turning(&mesh, &normals, EdgeId::new(0));
    assert!((turning - 1e-10).abs() < 1e-20, "{turning}");
}
