//! What is refused, and what is reported.

use apatch::glam::{DVec2, DVec3};
use apatch::polyhedral::{
    Finding, HullError, Planarity, PolyhedralSurface, Polyhedron, Settings, ShapeControl,
};

use super::common::{convex_solid, overlapping_pairs, prism, read, solid};

fn cube() -> (Vec<DVec3>, Vec<Vec<Vec<usize>>>) {
    let cube = given("cube");
    (cube.vertices().to_vec(), cube.facets().iter().map(|f| f.loops.clone()).collect())
}

fn given(name: &str) -> Polyhedron {
    solid(&read("solids")["solids"][name])
}

#[test]
fn bad_solids_are_refused_by_id() {
    let message = |change: fn(&mut Vec<DVec3>, &mut Vec<Vec<Vec<usize>>>)| {
        let (mut vertices, mut faces) = cube();
        change(&mut vertices, &mut faces);
        Polyhedron::new(vertices, faces, &Planarity::default()).unwrap_err().to_string()
    };
    let starts = |found: String, wanted: &str| assert!(found.starts_with(wanted), "{found}");
    starts(message(|v, _| v[3].x = f64::NAN), "vertex 3 has the position");
    starts(message(|v, _| v[3] *= 1.1), "face 3 is not planar: vertex 2 is ");
    starts(message(|_, f| f[2][0][1] = 70), "face 2 uses vertex 70, but there are only 8");
    starts(message(|_, f| f[2][0].truncate(2)), "face 2 has a loop of 2 corners");
    starts(
        message(|_, f| f[2][0].reverse()),
        "faces 0 and 2 disagree about the orientation of edge 6-4",
    );
    starts(message(|_, f| drop(f.remove(5))), "edge 5-1 of face 1 has no face");
    starts(
        message(|_, f| f.iter_mut().for_each(|f| f[0].reverse())),
        "the solid has the volume -8",
    );
    starts(message(|_, f| f.clear()), "the solid has no faces");
    starts(
        message(|_, f| {
            let l = f[0][0].clone();
            f[0] = vec![vec![l[0], l[1], l[2]]];
            f.push(vec![vec![l[0], l[2], l[3]]]);
        }),
        "faces 0 and 6 lie in one plane",
    );
}

#[test]
fn nearly_planar_faces_are_accepted_up_to_the_tolerance() {
    let (mut vertices, faces) = cube();
    vertices[3] *= 1.0 + 1e-7;
    let solid = Polyhedron::new(vertices, faces, &Planarity::default()).unwrap();
    let surface = PolyhedralSurface::new(&solid, &Settings::default()).unwrap();
    assert!(surface.report().is_clean(), "{:?}", surface.report());
}

/// The corner of a thin sheet that bends around by 300 degrees: faces above, below and all around.
#[test]
fn a_corner_without_normal_above() {
    let ray = |k: usize| {
        // out at the lower latitude and back at the upper one
        let (step, z) = if k < 6 { (k, -0.2) } else { (11 - k, 0.2) };
        let p = DVec2::from_angle(std::f64::consts::FRAC_PI_3 * step as f64);
        DVec3::new(p.x, p.y, z)
    };
    let area: DVec3 = (0..12).map(|k| ray(k).cross(ray((k + 1) % 12))).sum();
    let mut vertices = vec![DVec3::ZERO, 3.0 * area.normalize()];
    vertices.extend((0..12).map(ray));
    let side = |k: usize| [2 + k, 2 + (k + 1) % 12];
    let sheet = (0..12).map(side).map(|[a, b]| vec![vec![b, a, 0]]);
    let rest = (0..12).map(side).map(|[a, b]| vec![vec![a, b, 1]]);
    let faces = sheet.chain(rest).collect();
    let solid = Polyhedron::new(vertices, faces, &Planarity::default()).unwrap();
    let error = PolyhedralSurface::new(&solid, &Settings::default()).unwrap_err();
    assert_eq!(error, HullError::NoAboveNormal { vertex: 0 });
}

#[test]
fn a_bad_hull_is_found_and_replaced() {
    let mut found = 0;
    for seed in [0, 1, 6, 18, 26] {
        let solid = convex_solid(seed);
        let mut settings = Settings::default();
        settings.hull.retry = false;
        settings.hull.alpha = Some(0.1);
        let bad = PolyhedralSurface::new(&solid, &settings).unwrap();
        let overlaps = bad.report().findings.iter();
        let overlaps = overlaps.filter(|f| matches!(f, Finding::Overlap { .. })).count();
        let pairs = overlapping_pairs(bad.hull());
        assert!(pairs <= overlaps, "solid {seed}: {pairs} pairs overlap, {overlaps} were found");
        if bad.report().is_clean() {
            continue;
        }
        found += 1;
        settings.hull.retry = true;
        let good = PolyhedralSurface::new(&solid, &settings).unwrap();
        assert!(good.report().hulls > 1, "others were tried");
        assert!(good.report().findings.len() < bad.report().findings.len(), "and were better");
    }
    assert!(found >= 3, "some were bad: {found}");
}

#[test]
fn bad_settings_are_refused() {
    let solid = Polyhedron::named("cube").unwrap();
    let refused = |settings: Settings, wanted: &str| {
        let error = PolyhedralSurface::new(&solid, &settings).unwrap_err().to_string();
        assert!(error.starts_with(wanted), "{error}");
    };
    let mut settings = Settings::default();
    settings.hull.tau = 0.5;
    refused(settings.clone(), "the setting hull.tau is 0.5");
    settings.hull = Settings::default().hull;
    settings.shape = ShapeControl { faces: [(6, 1.0)].into(), ..ShapeControl::default() };
    refused(settings.clone(), "shape control for face 6, but there are only 6");
    settings.shape = ShapeControl { cut: f64::NAN, ..ShapeControl::default() };
    refused(settings, "the setting shape cut is NaN");
}

/// A face like the letter M: guards in the three legs, and none that joins them without a branch.
#[test]
fn faces_that_need_a_branching_net() {
    let comb = [0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 5.0, 5.0, 0.0];
    let height = [0.0, 0.0, 3.0, 3.0, 0.0, 0.0, 3.0, 3.0, 0.0, 0.0, 4.0, 4.0];
    let outline: Vec<_> = comb.into_iter().zip(height).map(|(x, y)| [x, y]).collect();
    let error = PolyhedralSurface::new(&prism(&outline), &Settings::default()).unwrap_err();
    assert_eq!(error, HullError::BranchingGuards { face: 12 });
    assert!(error.to_string().starts_with("the corners of face 12 need several points"), "{error}");
}
