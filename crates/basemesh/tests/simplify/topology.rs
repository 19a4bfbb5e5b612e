//! What every simplification keeps, whatever the input.

use basemesh::glam::DVec3;
use basemesh::{
    Relaxation, Simplified, SimplifyError, SimplifySettings, SurfaceTarget, TriMesh, simplify,
};
use proptest::prelude::*;

use crate::support::{
    Above, Spheres, Torus, largest_distance, map_positions, noise, sphere_mesh, together,
    torus_mesh,
};

/// Simplifies and asserts the promises that hold for every input: `TriMesh` itself proves that the
/// result is an oriented manifold.
fn check(mesh: TriMesh, target: &dyn SurfaceTarget, faces: usize) -> Simplified {
    let (euler, components) =
        (mesh.topology().euler_characteristic(), mesh.topology().component_count());
    let diagonal = mesh.diagonal();
    let s = simplify(mesh, target, &SimplifySettings::to_faces(faces)).unwrap();
    let t = s.mesh.topology();
    assert!(t.is_closed(), "closed");
    assert_eq!(t.euler_characteristic(), euler, "Euler characteristic");
    assert_eq!(t.component_count(), components, "components");
    assert_eq!(s.report.faces, t.face_count(), "reported faces");
    assert_eq!(s.report.stalled, t.face_count() > faces, "stalled means too many faces");
    assert!(s.report.off_surface.is_empty(), "off the surface: {:?}", s.report.off_surface);
    let distance = largest_distance(&s.mesh, target);
    assert!(distance <= 1e-12 * diagonal, "distance {distance} from the surface");
    for (v, n) in s.normals.iter() {
        assert!((n.length() - 1.0).abs() < 1e-12, "normal of vertex {v}: {n}");
    }
    s
}

/// Noise in the tangent plane of a sphere around the origin and across it.
fn noisy(mesh: TriMesh, seed: u64, size: f64) -> TriMesh {
    map_positions(mesh, |i, p| p + size * noise(seed, i))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn noisy_spheres(n in 6_usize..16, seed: u64, size in 0.0..1.0, half in 4_usize..80) {
        let mesh = noisy(sphere_mesh(n, DVec3::ZERO), seed, 0.5 * size / n as f64);
        let faces = (2 * half).min(mesh.topology().face_count());
        let s = check(mesh, &Spheres::unit(), faces);
        prop_assert_eq!(s.report.faces, faces);
        prop_assert_eq!(s.report.invalid_fans.len(), 0);
    }

    #[test]
    fn noisy_tori(n in 16_usize..32, m in 8_usize..16, seed: u64, size in 0.0..1.0) {
        let torus = Torus { major: 1.0, minor: 0.4 };
        let mesh = noisy(torus_mesh(&torus, n, m), seed, 0.3 / n as f64 * size);
        let s = check(mesh, &torus, 200);
        prop_assert_eq!(s.report.faces, 200);
        prop_assert_eq!(s.report.invalid_fans.len(), 0);
        prop_assert!(s.report.max_turning_deg <= 50.0 + 1e-6, "{}", s.report.max_turning_deg);
    }

    /// Two sheets much nearer to each other than the triangles are large.
    #[test]
    fn thin_rings(seed: u64, thickness in 0.005..0.05) {
        let torus = Torus { major: 1.0, minor: thickness };
        let mesh = torus_mesh(&torus, 200, 6);
        let mesh = map_positions(mesh, |i, p| p + 0.1 * thickness * noise(seed, i));
        let s = check(mesh, &torus, 600);
        prop_assert_eq!(s.report.faces, 600);
    }
}

#[test]
fn components_survive() {
    let centers: Vec<DVec3> = (0..5).map(|i| 3.0 * f64::from(i) * DVec3::X).collect();
    let meshes: Vec<TriMesh> =
        [4, 6, 8, 10, 12].iter().zip(&centers).map(|(&n, &c)| sphere_mesh(n, c)).collect();
    let target = Spheres { centers, radius: 1.0 };
    let s = check(together(&meshes), &target, 400);
    assert_eq!((s.report.faces, s.report.relaxation), (400, Relaxation::None), "{:?}", s.report);
    // five tetrahedra
    let least = check(together(&meshes), &target, 20);
    assert!(least.report.faces >= 20, "{:?}", least.report);
    let refused = simplify(together(&meshes), &target, &SimplifySettings::to_faces(18));
    let expected = SimplifyError::TooFewFaces { faces: 18, needed: 20, components: 5, euler: 10 };
    assert_eq!(refused.unwrap_err(), expected);
}

#[test]
fn smallest_meshes_are_left_alone() {
    let tetrahedron = TriMesh::new(
        vec![
            DVec3::new(1.0, 1.0, 1.0),
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
        ],
        &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    )
    .unwrap();
    let sphere = Spheres::unit();
    let s = check(tetrahedron, &sphere, 4);
    assert_eq!(s.report.faces, 4);
    let octahedron = sphere_mesh(1, DVec3::ZERO);
    assert_eq!(check(octahedron.clone(), &sphere, 8).mesh, octahedron, "already perfect");
    // more than there are: improved only
    assert_eq!(check(octahedron, &sphere, 100).report.faces, 8);
    // from an octahedron to a tetrahedron the guards must give way
    let s = check(sphere_mesh(1, DVec3::ZERO), &sphere, 4);
    assert!(s.report.relaxation > Relaxation::None, "{:?}", s.report);
}

#[test]
fn refusals_say_what_to_do() {
    let sphere = Spheres::unit();
    let refuse = |mesh: TriMesh, faces| {
        simplify(mesh, &sphere, &SimplifySettings::to_faces(faces)).unwrap_err().to_string()
    };
    let odd = refuse(sphere_mesh(4, DVec3::ZERO), 31);
    assert!(odd.contains("31") && odd.contains("30") && odd.contains("32"), "{odd}");
    let few = refuse(sphere_mesh(4, DVec3::ZERO), 2);
    assert!(few.contains("at least 4"), "{few}");
    let few = refuse(torus_mesh(&Torus { major: 1.0, minor: 0.4 }, 12, 6), 12);
    assert!(few.contains("at least 14"), "{few}");
    let open = TriMesh::new(vec![DVec3::X, DVec3::Y, DVec3::Z], &[[0, 1, 2]]).unwrap();
    let open = refuse(open, 4);
    assert!(open.contains("edge 0-1"), "{open}");
}

#[test]
fn vertices_without_a_foot_are_reported() {
    let sphere = Spheres::unit();
    let target = Above { inner: &sphere, floor: -0.5 };
    let mesh = sphere_mesh(12, DVec3::ZERO);
    let s = simplify(mesh, &target, &SimplifySettings::to_faces(200)).unwrap();
    assert!(!s.report.off_surface.is_empty(), "the south cap has no feet");
    assert_eq!(s.mesh.topology().euler_characteristic(), 2);
    for &v in &s.report.off_surface {
        assert!(s.mesh.position(v).z < -0.5, "vertex {v} at {}", s.mesh.position(v));
        assert!(s.normals[v].dot(s.mesh.position(v)) > 0.9, "outward normal of {v}");
    }
}
