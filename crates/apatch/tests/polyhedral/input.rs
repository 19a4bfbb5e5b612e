//! What is refused, and what is reported.

use apatch::glam::{DVec2, DVec3};
use apatch::polyhedral::{
    Finding, HullError, Planarity, PolyhedralSurface, Polyhedron, Settings, ShapeControl,
};

fn cube() -> (Vec<DVec3>, Vec<Vec<Vec<usize>>>) {
    let cube = Polyhedron::named("cube").unwrap();
    (cube.vertices().to_vec(), cube.facets().iter().map(|f| f.loops.clone()).collect())
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
    starts(message(|v, _| v[3] *= 1.1), "face 1 is not planar: vertex 3 is 5.");
    starts(message(|_, f| f[2][0][1] = 70), "face 2 uses vertex 70, but there are only 8");
    starts(message(|_, f| f[2][0].truncate(2)), "face 2 has a loop of 2 corners");
    starts(message(|_, f| f[2][0].reverse()), "faces 0 and 2 disagree");
    starts(message(|_, f| drop(f.remove(5))), "edge 3-7 of face 1 has no face");
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

/// Two hollows that meet in a corner: no direction looks at all faces from above.
#[test]
fn a_corner_without_normal_above() {
    // a pyramid over a plan that winds up: fold a star around its tip, up and down by turns
    let corner = |k: usize| {
        let angle = std::f64::consts::PI * k as f64 / 4.0;
        let z = if k % 2 == 0 { 2.0 } else { -2.0 };
        DVec3::new(angle.cos(), angle.sin(), z)
    };
    let mut vertices: Vec<DVec3> = (0..8).map(corner).collect();
    vertices.extend([DVec3::ZERO, DVec3::new(0.0, 0.0, -6.0)]);
    let side = |k: usize, tip: usize, up: bool| {
        let (a, b) = (k, (k + 1) % 8);
        vec![if up { vec![a, b, tip] } else { vec![b, a, tip] }]
    };
    let faces = (0..8).map(|k| side(k, 8, true)).chain((0..8).map(|k| side(k, 9, false))).collect();
    let solid = Polyhedron::new(vertices, faces, &Planarity::default()).unwrap();
    match PolyhedralSurface::new(&solid, &Settings::default()) {
        Err(HullError::NoAboveNormal { vertex: 8 }) => {}
        Err(other) => panic!("{other}"),
        Ok(surface) => panic!("{:?}", surface.report()),
    }
}

#[test]
fn a_bad_hull_is_found() {
    // a needle: guards far from its tip, and no other places are tried
    let points: Vec<DVec3> = (0..5)
        .map(|k| DVec2::from_angle(f64::from(k) * 1.3))
        .map(|p| DVec3::new(p.x, 3.0 * p.y, 0.05 * p.x))
        .chain([DVec3::new(0.9, 2.5, 0.4)])
        .collect();
    let solid = Polyhedron::convex_hull(&points).unwrap();
    let mut settings = Settings::default();
    settings.hull.retry = false;
    settings.hull.alpha = Some(0.02);
    let bad = PolyhedralSurface::new(&solid, &settings).unwrap();
    assert!(!bad.report().is_clean(), "{:?}", bad.report());
    let overlaps = bad.report().findings.iter().filter(|f| matches!(f, Finding::Overlap { .. }));
    assert!(overlaps.count() > 0, "{:?}", bad.report().findings);
    settings.hull.retry = true;
    let more = PolyhedralSurface::new(&solid, &settings).unwrap();
    assert!(more.report().hulls > 1, "others were tried");
    assert!(more.report().findings.len() < bad.report().findings.len(), "and were better");
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
