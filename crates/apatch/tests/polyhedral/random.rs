//! Random convex solids: all are valid after the retries, or the report says why not.

use apatch::glam::DVec3;
use apatch::polyhedral::{PolyhedralSurface, Polyhedron, Scheme, Settings};
use proptest::prelude::*;

use super::common::{closed_characteristic, convex_solid, jumps, overlapping_pairs, settings};

#[test]
fn forty_random_solids() {
    let (mut invalid, mut flipped) = (Vec::new(), 0);
    for seed in 0..40 {
        let solid = convex_solid(seed);
        let surface = PolyhedralSurface::new(&solid, &Settings::default()).unwrap();
        let report = surface.report();
        let jumps = jumps(&surface);
        let mesh = surface.tessellate(8, 6);
        let fine = jumps.gradient <= 1e-12
            && jumps.angle <= 1e-11
            && report.bad_rays[0] == 0
            && closed_characteristic(&mesh) == Some(2)
            && overlapping_pairs(surface.hull()) == 0;
        flipped += usize::from(mesh.flipped_facets() > 0);
        assert!(fine || !report.is_clean(), "solid {seed} is wrong in silence: {jumps:?}");
        if !report.is_clean() {
            invalid.push(seed);
        }
    }
    assert!(invalid.len() <= 2, "not valid: {invalid:?}");
    // slivers at nearly flat corners: not excluded, but rare
    assert!(flipped <= 1, "meshes with facets that look the wrong way: {flipped}");
}

/// The same in C2. Run with `cargo test -p apatch --release -- --ignored`.
#[test]
#[ignore = "some minutes in the release profile"]
fn forty_random_solids_in_c2() {
    let mut invalid = Vec::new();
    for seed in 0..40 {
        let solid = convex_solid(seed);
        let surface = PolyhedralSurface::new(&solid, &settings(Scheme::C2Quintic)).unwrap();
        let report = surface.report();
        let jumps = jumps(&surface);
        let mesh = surface.tessellate(8, 6);
        let fine = jumps.gradient <= 1e-12
            && jumps.hessian <= 1e-9
            && jumps.angle <= 1e-11
            && report.bad_rays[0] == 0
            && closed_characteristic(&mesh) == Some(2);
        assert!(fine || !report.is_clean(), "solid {seed} is wrong in silence: {jumps:?}");
        if !report.is_clean() {
            invalid.push((seed, report.bad_rays, report.findings.len()));
        }
    }
    assert!(invalid.len() <= 2, "not valid: {invalid:?}");
}

fn scaled(solid: &Polyhedron, factor: f64) -> Polyhedron {
    let vertices = solid.vertices().iter().map(|p| *p * factor).collect();
    let faces = solid.facets().iter().map(|f| f.loops.clone()).collect();
    Polyhedron::new(vertices, faces, &apatch::polyhedral::Planarity::default()).unwrap()
}

#[test]
fn scaling_by_a_power_of_two_is_exact() {
    const FACTOR: f64 = 4096.0;
    for (name, scheme) in [
        ("u-prism", Scheme::C1Cubic),
        ("l-prism", Scheme::C1Cubic),
        ("icosahedron", Scheme::C1Cubic),
        ("octahedron", Scheme::C2Quintic),
        ("l-prism", Scheme::C2Quintic),
    ] {
        let solid = Polyhedron::named(name).unwrap();
        let small = PolyhedralSurface::new(&solid, &settings(scheme)).unwrap();
        let large = PolyhedralSurface::new(&scaled(&solid, FACTOR), &settings(scheme)).unwrap();
        for (p, q) in small.hull().points.iter().zip(&large.hull().points) {
            assert_eq!(*p * FACTOR, *q, "{name}: points of the hull");
        }
        for cell in 0..small.hull().cells.len() {
            let grown: Vec<f64> = small.weights(cell).iter().map(|w| w * FACTOR).collect();
            assert_eq!(grown, large.weights(cell), "{name} {scheme:?}: cell {cell}");
        }
        let (a, b) = (small.tessellate(4, 3), large.tessellate(4, 3));
        assert_eq!(a.triangles, b.triangles, "{name}: facets");
        for (p, q) in a.positions.iter().zip(&b.positions) {
            assert_eq!(*p * FACTOR, *q, "{name} {scheme:?}: points");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_valid_report_means_a_smooth_sheet(seed in 100_u64..100_000, axis in 0..3_usize) {
        let solid = convex_solid(seed);
        // flattened: no symmetry, larger ratios
        let mut shrink = DVec3::ONE;
        shrink[axis] = 0.6;
        let vertices = solid.vertices().iter().map(|p| *p * shrink).collect();
        let faces = solid.facets().iter().map(|f| f.loops.clone()).collect();
        let planarity = apatch::polyhedral::Planarity::default();
        let solid = Polyhedron::new(vertices, faces, &planarity).unwrap();
        let surface = PolyhedralSurface::new(&solid, &Settings::default()).unwrap();
        if surface.report().is_clean() {
            let jumps = jumps(&surface);
            prop_assert!(jumps.gradient <= 1e-11, "{jumps:?}");
            let mesh = surface.tessellate(3, 2);
            prop_assert_eq!(closed_characteristic(&mesh), Some(2));
            prop_assert_eq!(mesh.missing, 0);
        }
    }
}
