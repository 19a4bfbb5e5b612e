//! The fifteen solids in both schemes.

use apatch::glam::{DVec2, DVec3};
use apatch::polyhedral::{PolyhedralSurface, Polyhedron, Scheme, Settings};

use super::common::{closed_characteristic, jumps, prism, settings, solids};

/// Jumps of gradients, relative, and angles of normals.
const GRADIENT: f64 = 1e-13;
const ANGLE: f64 = 1e-12;
/// Jumps of second derivatives, relative, and of curvatures.
const HESSIAN: f64 = 1e-10;
const CURVATURE: f64 = 1e-9;

fn check(name: &str, solid: &Polyhedron, settings: &Settings) {
    let surface = PolyhedralSurface::new(solid, settings).unwrap();
    let report = surface.report();
    assert!(report.is_clean(), "{name}: {report:?}");
    assert!(report.bad_rays[1] > 1000, "{name}: rays were tried");
    let jumps = jumps(&surface);
    assert!(jumps.value <= 1e-14 && jumps.gradient <= GRADIENT, "{name}: {jumps:?}");
    assert!(jumps.angle <= ANGLE, "{name}: {jumps:?}");
    if settings.scheme == Scheme::C2Quintic {
        assert!(jumps.hessian <= HESSIAN && jumps.curvature <= CURVATURE, "{name}: {jumps:?}");
    }
    for n in [5, 8] {
        let mesh = surface.tessellate(n, n);
        assert_eq!(mesh.missing, 0, "{name}: points off the surface");
        assert_eq!(mesh.flipped_facets(), 0, "{name}: flipped facets");
        let characteristic = closed_characteristic(&mesh);
        assert_eq!(characteristic, Some(solid.euler_characteristic()), "{name}: closed mesh");
        let volume = mesh.signed_volume();
        assert!(volume > 0.0 && volume < 1.1 * solid.signed_volume(), "{name}: volume {volume}");
    }
}

#[test]
fn c1() {
    for (name, solid) in solids() {
        check(&name, &solid, &settings(Scheme::C1Cubic));
    }
}

/// All but one with many sharp corners, which needs several large quadratic programs.
#[test]
fn c2() {
    for (name, solid) in solids().into_iter().filter(|(name, _)| name != "random_simplicial") {
        check(&name, &solid, &settings(Scheme::C2Quintic));
    }
}

/// Run with `cargo test -p apatch --release -- --ignored`.
#[test]
#[ignore = "a minute in the dev profile"]
fn c2_sharp() {
    for (name, solid) in solids().into_iter().filter(|(name, _)| name == "random_simplicial") {
        check(&name, &solid, &settings(Scheme::C2Quintic));
    }
}

#[test]
fn platonic_solids_become_their_inscribed_spheres() {
    for (name, solid) in solids() {
        let radius = solid.facets()[0].normal.dot(solid.facets()[0].centroid);
        let regular = ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"];
        if !regular.contains(&&*name) {
            continue;
        }
        for scheme in [Scheme::C1Cubic, Scheme::C2Quintic] {
            let surface = PolyhedralSurface::new(&solid, &settings(scheme)).unwrap();
            let mesh = surface.tessellate(6, 4);
            let off = |p: &DVec3| (p.length() / radius - 1.0).abs();
            let worst = mesh.positions.iter().map(off).fold(0.0, f64::max);
            assert!(worst <= 1e-10, "{name} {scheme:?}: {worst}");
        }
    }
}

/// Prisms over a T and a cross, in which rays fall back before the middle weights are changed.
#[test]
fn rays_are_repaired() {
    let letter: &[[f64; 2]] = &[
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, -2.0],
        [2.0, -2.0],
        [2.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [0.0, 1.0],
    ];
    let quarter = |k: usize| DVec2::from_angle(std::f64::consts::FRAC_PI_2 * k as f64);
    let inner = DVec2::new(0.5, 0.5);
    let outer = [DVec2::new(2.5, -0.5), DVec2::new(2.5, 0.5)];
    let cross: Vec<[f64; 2]> = (0..4)
        .flat_map(|k| [outer[0], outer[1], inner].map(|p| quarter(k).rotate(p).to_array()))
        .collect();
    for outline in [letter, &cross] {
        check("prism", &prism(outline), &settings(Scheme::C1Cubic));
        let surface = PolyhedralSurface::new(&prism(outline), &Settings::default()).unwrap();
        assert!(surface.report().repaired_rays > 0, "the repair was needed");
    }
}

#[test]
fn two_sided_and_straight_parts_are_found() {
    let counts = |name: &str| {
        let solid = Polyhedron::named(name).unwrap();
        let surface = PolyhedralSurface::new(&solid, &Settings::default()).unwrap();
        let report = surface.report().clone();
        (surface.hull().base_count(), report.edges, report.two_sided)
    };
    assert_eq!(counts("u-prism"), (12, [26, 2, 2], 4), "two guards in both U-shaped faces");
    assert_eq!(
        counts("frame"),
        (16, [36, 4, 8], 8),
        "a ring of four guards in both faces with holes"
    );
    assert_eq!(counts("l-prism"), (8, [17, 1, 0], 2), "one guard in the kernel");
}
