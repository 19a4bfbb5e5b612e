//! Smooth solids: fifteen solids in both schemes, and forty random convex ones.

use anyhow::{Context, Result};
use serde::Deserialize;
use smoothpatch::apatch::polyhedral::{Planarity, PolyhedralSurface, Polyhedron, Scheme, Settings};
use smoothpatch::basemesh::glam::DVec3;
use testkit::solids::sphere_points;

use super::rational::promises::topology_of;
use super::{Case, Effort, Measured};
use crate::check::Check;

const C1: &str = "solid C1";
const C2: &str = "solid C2";
/// Steps along each side of a triangle and across each half of an edge.
const STEPS: usize = 8;
/// Solids that need several large quadratic programs: C2 only where everything is measured.
const DEAR: [&str; 1] = ["random_simplicial"];
const REGULAR: [&str; 5] = ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"];
/// Random solids, and how many of them must be valid.
const RANDOM: u64 = 40;
const VALID: f64 = 0.95;

pub(super) fn cases(effort: Effort) -> Vec<Case> {
    let mut cases = Vec::new();
    for name in NAMES {
        for (scheme, label) in [(Scheme::C1Cubic, C1), (Scheme::C2Quintic, C2)] {
            let dear = DEAR.contains(&name) && scheme == Scheme::C2Quintic;
            if dear && effort == Effort::Usual {
                continue;
            }
            cases.push(Case::new(name.replace('_', " "), label, move |_| {
                promises(name, &solid(name)?, scheme)
            }));
        }
    }
    cases.push(Case::new("40 random convex solids", C1, |_| random(Scheme::C1Cubic)));
    if effort == Effort::Full {
        cases.push(Case::new("40 random convex solids", C2, |_| random(Scheme::C2Quintic)));
    }
    cases
}

const NAMES: [&str; 15] = [
    "tetrahedron",
    "cube",
    "octahedron",
    "dodecahedron",
    "icosahedron",
    "trunc_icosahedron",
    "square_pyramid",
    "l_prism",
    "notched_box",
    "u_prism",
    "frame",
    "random_simple",
    "random_simplicial",
    "schoenhardt",
    "dented_cube",
];

#[derive(Deserialize)]
struct Solid {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<Vec<usize>>>,
}

#[derive(Deserialize)]
struct Solids {
    solids: std::collections::BTreeMap<String, Solid>,
}

fn solid(name: &str) -> Result<Polyhedron> {
    let path = crate::root().join("fixtures/oracle/polyhedra-a-patch/solids.json");
    let mut all: Solids = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let solid = all.solids.remove(name).with_context(|| format!("no solid {name}"))?;
    let vertices = solid.vertices.into_iter().map(DVec3::from_array).collect();
    Ok(Polyhedron::new(vertices, solid.faces, &Planarity::default())?)
}

/// What every smooth solid promises.
fn promises(name: &str, solid: &Polyhedron, scheme: Scheme) -> Result<Measured> {
    let settings = Settings { scheme, ..Settings::default() };
    let surface = PolyhedralSurface::new(solid, &settings)?;
    let (joints, report) = (surface.joints(), surface.report());
    let mesh = surface.tessellate(STEPS, STEPS);
    let (euler, rim) = topology_of(&mesh);
    let count = |n: usize| i64::try_from(n).expect("invariant: counts fit 32 bits");
    let mut checks = vec![
        Check::exactly("findings of the hull", count(report.findings.len()), 0),
        Check::exactly("bad rays", count(report.bad_rays[0]), 0),
        Check::at_most("jump of the gradient", joints.gradient_jump, 1e-13),
        Check::at_most("kink, rad", joints.normal_angle, 1e-12),
        Check::exactly("points without a root", count(mesh.missing), 0),
        Check::exactly("flipped facets", count(mesh.flipped_facets()), 0),
        Check::exactly("open sides", count(rim), 0),
        Check::exactly("Euler characteristic", euler, solid.euler_characteristic() as i64),
    ];
    if scheme == Scheme::C2Quintic {
        checks.push(Check::at_most("jump of second derivatives", joints.hessian_jump, 1e-10));
        checks.push(Check::at_most("jump of curvatures", joints.curvature_jump, 1e-9));
    }
    let mut deviation = None;
    if REGULAR.contains(&name) {
        let facet = &solid.facets()[0];
        let radius = facet.normal.dot(facet.centroid);
        let off = |p: &DVec3| (p.length() / radius - 1.0).abs();
        let worst = mesh.positions.iter().map(off).fold(0.0, f64::max);
        checks.push(Check::at_most("off the inscribed sphere", worst, 1e-10));
        deviation = Some(worst);
    }
    let kink = Some(joints.normal_angle);
    Ok(Measured { faces: solid.facets().len(), euler, kink, deviation, checks, order: None })
}

/// Forty solids: even numbers with triangles for faces, odd ones with three edges at every corner.
fn random(scheme: Scheme) -> Result<Measured> {
    let (mut valid, mut silent, mut faces, mut kink) = (0, 0, 0, 0.0_f64);
    for seed in 0..RANDOM {
        let solid = random_solid(seed)?;
        let settings = Settings { scheme, ..Settings::default() };
        let surface = PolyhedralSurface::new(&solid, &settings)?;
        let (joints, mesh) = (surface.joints(), surface.tessellate(4, 4));
        let (euler, rim) = topology_of(&mesh);
        let smooth = joints.gradient_jump <= 1e-12
            && (scheme == Scheme::C1Cubic || joints.hessian_jump <= 1e-9);
        let sound = smooth && (euler, rim, mesh.missing) == (2, 0, 0);
        let clean = surface.report().is_clean();
        valid += u32::from(clean && sound);
        silent += i64::from(clean && !sound);
        faces += solid.facets().len();
        if clean {
            kink = kink.max(joints.normal_angle);
        }
    }
    let checks = vec![
        Check::at_least("share of valid solids", f64::from(valid) / RANDOM as f64, VALID),
        Check::exactly("wrong in silence", silent, 0),
    ];
    Ok(Measured { faces, euler: 2, kink: Some(kink), checks, ..Measured::default() })
}

fn random_solid(seed: u64) -> Result<Polyhedron> {
    let count = [8, 11, 14, 17, 20][usize::try_from(seed / 2 % 5)?];
    let hull = Polyhedron::convex_hull(&sphere_points(seed, count))?;
    let around = hull.facets().iter().all(|f| f.normal.dot(f.centroid) > 0.1);
    match (seed.is_multiple_of(2), around) {
        (true, _) => Ok(hull),
        (false, true) => Ok(hull.dual()?),
        // the dual of points on one side has no volume
        (false, false) => random_solid(seed + 1000),
    }
}
