//! Promises over random triangulations and normals.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use apatch::basemesh::{FaceId, TriMesh, VertexMap};
use apatch::glam::{DQuat, DVec3};
use apatch::rational::{FreeWeightRule, Normals, RationalSurface, Settings, ShapeControl, Side};
use common::Numbers;
use proptest::prelude::*;
use testkit::meshes::{icosphere, torus_grid};

/// A closed or toroidal mesh, its vertices and normals disturbed.
fn random_mesh(seed: u64, torus: bool, amount: f64) -> (TriMesh, VertexMap<DVec3>) {
    let mesh = if torus { torus_grid([2.0, 0.8], 9, 6) } else { icosphere(1) };
    let mut numbers = Numbers::new(seed);
    let mut vector = || DVec3::new(numbers.signed(), numbers.signed(), numbers.signed());
    let normal = |p: DVec3| if torus { common::torus_normal(p) } else { p };
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for &p in mesh.positions().as_slice() {
        positions.push(p + vector() * (0.3 * amount));
        normals.push(normal(p) + vector() * amount);
    }
    (mesh.with_positions(VertexMap::from_vec(positions)).unwrap(), VertexMap::from_vec(normals))
}

fn build(mesh: &TriMesh, normals: &VertexMap<DVec3>) -> RationalSurface {
    let normals = Normals::Given(normals.clone());
    RationalSurface::new(mesh.clone(), normals, &Settings::default()).unwrap()
}

/// Some points of the surface over every face and edge, where it has them.
fn samples(surface: &RationalSurface) -> Vec<Option<(DVec3, DVec3)>> {
    let topology = surface.mesh().topology();
    let faces = topology
        .faces()
        .flat_map(|f| [[0.2, 0.3, 0.5], [0.6, 0.3, 0.1]].map(|x| surface.face_point(f, x)));
    let edges =
        topology.edges().flat_map(|e| [[0.3, 0.2], [0.7, 0.9]].map(|x| surface.edge_point(e, x)));
    faces.chain(edges).map(|p| p.map(|p| (p.point, p.gradient))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// The gradient from the face's tetrahedron is that from the edge's on their common triangle.
    #[test]
    fn smooth_across_common_triangles(seed in 0_u64..1 << 40, torus: bool, amount in 0.0..0.2_f64) {
        let (mesh, normals) = random_mesh(seed, torus, amount);
        let surface = build(&mesh, &normals);
        let topology = surface.mesh().topology();
        let mut numbers = Numbers::new(seed ^ 1);
        for edge in topology.edges() {
            let h = topology.canonical(edge);
            for side in Side::BOTH {
                if surface.edge_tetrahedron(edge, side).is_none() {
                    continue;
                }
                let [i, j, apex] = numbers.weights();
                let mut at = [0.0, 0.0, 0.0, apex];
                (at[h.corner()], at[h.next().corner()]) = (i, j);
                let a = surface.face_value(h.face(), side, at).unwrap();
                let b = surface.edge_value(edge, side, [0.0, i, j, apex]).unwrap();
                let scale = surface.face(h.face()).sides[side.index()].unwrap().scale();
                prop_assert!((a.0 - b.0).abs() <= 1e-12 * scale, "value {} {}", a.0, b.0);
                // flat edge tetrahedra of disturbed meshes lose digits of the gradient
                let tetrahedron = surface.edge_tetrahedron(edge, side).unwrap();
                let allowed = 1e-14 / tetrahedron.flatness() * a.1.length().max(1.0);
                prop_assert!(a.1.distance(b.1) <= allowed.max(1e-12), "gradient {} {}", a.1, b.1);
            }
        }
    }

    /// A clean report is the truth on a grid that the construction did not see.
    #[test]
    fn one_sheet(seed in 0_u64..1 << 40, torus: bool, amount in 0.0..0.2_f64) {
        let (mesh, normals) = random_mesh(seed, torus, amount);
        let surface = build(&mesh, &normals);
        if surface.report().not_single.is_empty() {
            let (bad, all) = surface.count_bad_transversals(17);
            prop_assert!(bad == 0, "{} of {}", bad, all);
        }
    }

    #[test]
    fn scaling_by_powers_of_two_is_exact(seed in 0_u64..1 << 40, torus: bool, amount in 0.0..0.25_f64) {
        let (mesh, normals) = random_mesh(seed, torus, amount);
        let factor = 4096.0;
        let large = common::mapped(&mesh, |p| p * factor);
        let (a, b) = (build(&mesh, &normals), build(&large, &normals));
        for (a, b) in samples(&a).into_iter().zip(samples(&b)) {
            let scaled = a.map(|(p, n)| (p * factor, n));
            prop_assert_eq!(scaled, b);
        }
    }

    #[test]
    fn rigid_motions_move_the_surface(
        seed in 0_u64..1 << 40, torus: bool, turn in (-3.0..3.0_f64, -3.0..3.0_f64, -3.0..3.0_f64),
    ) {
        let (mesh, normals) = random_mesh(seed, torus, 0.05);
        let turn = DQuat::from_scaled_axis(DVec3::from(turn));
        let shift = DVec3::new(0.3, -1.2, 0.7);
        let moved = common::mapped(&mesh, |p| turn * p + shift);
        let turned = normals.map(|_, &n| turn * n);
        let (a, b) = (build(&mesh, &normals), build(&moved, &turned));
        prop_assume!(a.report().moved_apices == 0 && b.report().moved_apices == 0);
        for (a, b) in samples(&a).into_iter().zip(samples(&b)) {
            let (Some((p, n)), Some((q, m))) = (a, b) else {
                prop_assert!(a.is_none() && b.is_none());
                continue;
            };
            prop_assert!((turn * p + shift).distance(q) <= 1e-10, "{} {}", p, q);
            prop_assert!((turn * n).distance(m) <= 1e-8 * m.length(), "{} {}", n, m);
        }
    }

    /// Faces in another order, with other first corners: the same surface.
    #[test]
    fn faces_in_any_order(seed in 0_u64..1 << 40, torus: bool) {
        let (mesh, normals) = random_mesh(seed, torus, 0.05);
        let mut faces = mesh.face_indices();
        faces.reverse();
        faces.iter_mut().for_each(|f| f.rotate_left(1));
        let other = TriMesh::new(mesh.positions().as_slice().to_vec(), &faces).unwrap();
        let (a, b) = (build(&mesh, &normals), build(&other, &normals));
        prop_assume!(a.report().moved_apices == 0);
        let count = faces.len();
        for f in 0..count {
            let p = a.face_point(FaceId::new(f), [0.2, 0.3, 0.5]);
            let q = b.face_point(FaceId::new(count - 1 - f), [0.3, 0.5, 0.2]);
            match (p, q) {
                (Some(p), Some(q)) => prop_assert!(p.point.distance(q.point) <= 1e-12),
                (p, q) => prop_assert!(p.is_none() && q.is_none()),
            }
        }
    }

    /// Positive tension pulls to the mesh, negative lets out; always one sheet.
    #[test]
    fn tension_moves_the_surface(seed in 0_u64..1 << 40, torus: bool) {
        let (mesh, normals) = random_mesh(seed, torus, 0.05);
        let along = |tension: f64| {
            let settings = Settings {
                shape: ShapeControl::uniform(tension),
                rule: FreeWeightRule::Clamped,
                ..Settings::default()
            };
            let normals = Normals::Given(normals.clone());
            let surface = RationalSurface::new(mesh.clone(), normals, &settings).unwrap();
            let (bad, _) = surface.count_bad_transversals(9);
            assert_eq!(bad, 0, "tension {tension}: {:?}", surface.report());
            let at = |f: FaceId| surface.face_point(f, [0.35, 0.3, 0.35]).unwrap().t;
            surface.mesh().topology().faces().map(at).sum::<f64>()
        };
        let [out, middle, tight] = [-0.9, 0.0, 2.0].map(along);
        prop_assert!(out > middle && middle > tight, "{} {} {}", out, middle, tight);
    }
}
