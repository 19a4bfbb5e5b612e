//! Meshes whose hull overlaps: repaired, or each fault reported.
#![allow(clippy::print_stdout, reason = "figures, for runs with --nocapture")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use apatch::basemesh::TriMesh;
use apatch::glam::DVec3;
use apatch::rational::{
    Normals, NormalsUsed, RationalSurface, RepairSettings, Settings, Side, loop_limit_normals,
};
use common::{double_torus, given, l_block, noisy_sphere};

/// Edge tetrahedra that are not valid, straight from the surface.
fn invalid(surface: &RationalSurface) -> usize {
    let topology = surface.mesh().topology();
    let wedges = topology.edges().flat_map(|e| Side::BOTH.map(|side| surface.wedge(e, side)));
    wedges.flatten().filter(|wedge| !wedge.is_valid()).count()
}

fn check(name: &str, mesh: &TriMesh) {
    let plain = Settings { repair: RepairSettings::NONE, ..Settings::default() };
    let before = RationalSurface::new(mesh.clone(), Normals::Estimated, &plain).unwrap();
    assert!(invalid(&before) > 0, "{name} needs no repair: the test shows nothing");
    assert_eq!(before.report().invalid_edges.len(), invalid(&before), "{name}: all reported");
    let after =
        RationalSurface::new(mesh.clone(), Normals::Estimated, &Settings::default()).unwrap();
    let report = after.report();
    println!(
        "{name}: {} -> {}, {:?}, {} Loop steps, {} moved",
        invalid(&before),
        invalid(&after),
        report.normals,
        report.loop_steps,
        report.moved_apices
    );
    assert_eq!(invalid(&after), 0, "{name}: {report:?}");
    assert!(report.is_clean(), "{name}: {report:?}");
    let (bad, all) = after.count_bad_transversals(30);
    assert_eq!(bad, 0, "{name}: of {all}");
}

#[test]
fn noisy_spheres() {
    for seed in 1..4 {
        check("20 %", &noisy_sphere(0.2, seed));
        check("30 %", &noisy_sphere(0.3, seed));
    }
}

#[test]
fn voxel_double_torus() {
    let mesh = double_torus();
    assert_eq!(mesh.topology().euler_characteristic(), -2, "genus 2");
    check("double torus", &mesh);
}

#[test]
fn l_shaped_block() {
    check("L block", &l_block());
}

/// Given normals belong to given vertices: only apices move, and what remains is reported.
#[test]
fn given_normals_and_their_mesh_are_kept() {
    let mesh = noisy_sphere(0.3, 2);
    let normals = given(&mesh, DVec3::normalize);
    let surface = RationalSurface::new(mesh.clone(), normals, &Settings::default()).unwrap();
    assert_eq!(surface.mesh(), &mesh);
    for (v, p) in mesh.positions().iter() {
        assert_eq!(surface.normals()[v], p.normalize(), "vertex {v}");
    }
    assert_eq!(surface.report().invalid_edges.len(), invalid(&surface), "all reported");
    for found in &surface.report().invalid_edges {
        assert!(!(found.angle > 0.0 && found.angle < std::f64::consts::PI), "{found:?}");
    }
}

/// Moving apices alone mends most edges, and leaves vertices, normals and smoothness as they are.
#[test]
fn given_normals_with_moved_apices() {
    let mut sums = [0; 2];
    for seed in 1..4 {
        let mesh = noisy_sphere(0.2, seed);
        let normals = loop_limit_normals(&mesh);
        let build = |repair| {
            let settings = Settings { repair, ..Settings::default() };
            let normals = Normals::Given(normals.clone());
            RationalSurface::new(mesh.clone(), normals, &settings).unwrap()
        };
        let before = build(RepairSettings::NONE);
        let after = build(RepairSettings::default());
        let report = after.report();
        println!("{} -> {}, {} moved", invalid(&before), invalid(&after), report.moved_apices);
        assert_eq!((after.mesh(), after.normals()), (&mesh, &normals), "the data are kept");
        assert_eq!((report.normals, report.loop_steps), (NormalsUsed::Given, 0));
        assert!(report.moved_apices > 0 && before.report().moved_apices == 0, "{report:?}");
        assert!(invalid(&after) < invalid(&before), "moving helps");
        sums = [sums[0] + invalid(&before), sums[1] + invalid(&after)];
        assert_eq!(report.invalid_edges.len(), invalid(&after), "all reported");
        // a moved apex is over the positive side of all weights next to the face
        for face in mesh.topology().faces() {
            for side in Side::BOTH {
                let Some(s) = &after.face(face).sides[side.index()] else { continue };
                let weights = s.l1v.iter().chain(&s.l1e);
                assert!(weights.copied().all(|w| side.sign() * w > 0.0), "face {face}: {s:?}");
            }
        }
        for (p, vertex) in after.tessellate(3, 2).positions.iter().zip(mesh.positions().as_slice())
        {
            assert_eq!(p, vertex, "the first points are the vertices");
        }
    }
    assert!(2 * sums[1] <= sums[0], "half of the faults and more are mended: {sums:?}");
}

#[test]
fn apices_are_on_their_sides() {
    let surface =
        RationalSurface::new(double_torus(), Normals::Estimated, &Settings::default()).unwrap();
    for face in surface.mesh().topology().faces() {
        let [a, b, c] = surface.mesh().triangle(face);
        let normal = (b - a).cross(c - a);
        for side in Side::BOTH {
            if let Some(t) = surface.face_tetrahedron(face, side) {
                assert!(side.sign() * (t.corners[3] - a).dot(normal) > 0.0, "face {face}");
            }
        }
    }
}
