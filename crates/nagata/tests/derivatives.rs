//! Derivatives against differences, curvature and area against known values.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::GridMesh as _;

use std::f64::consts::PI;

use common::{SPHERE, TORUS, build};
use nagata::basemesh::FaceId;
use nagata::bezier_core::{Barycentric, Corner, ParametricPatch, PatchJet};
use nagata::glam::DVec3;
use nagata::{Patch, Settings};

/// Derivatives of `point` by central differences with step `h`.
fn differences(point: impl Fn(f64, f64) -> DVec3, u: f64, v: f64, h: f64) -> [DVec3; 5] {
    let at = |i: f64, j: f64| point(u + i * h, v + j * h);
    let centre = at(0.0, 0.0);
    [
        (at(1.0, 0.0) - at(-1.0, 0.0)) / (2.0 * h),
        (at(0.0, 1.0) - at(0.0, -1.0)) / (2.0 * h),
        (at(1.0, 0.0) - centre * 2.0 + at(-1.0, 0.0)) / (h * h),
        (at(1.0, 1.0) - at(1.0, -1.0) - at(-1.0, 1.0) + at(-1.0, -1.0)) / (4.0 * h * h),
        (at(0.0, 1.0) - centre * 2.0 + at(0.0, -1.0)) / (h * h),
    ]
}

/// The differences converge to the jet with the second power of the step.
fn check(jet: &PatchJet, point: impl Fn(f64, f64) -> DVec3, u: f64, v: f64) {
    let exact = [jet.du, jet.dv, jet.duu, jet.duv, jet.dvv];
    let error = |h: f64| {
        let got = differences(&point, u, v, h);
        std::array::from_fn::<f64, 5, _>(|k| got[k].distance(exact[k]))
    };
    assert_eq!(jet.point, point(u, v), "at {u} {v}");
    let (coarse, fine) = (error(2e-3), error(1e-3));
    for (k, (coarse, fine)) in coarse.into_iter().zip(fine).enumerate() {
        // round-off of second differences is 1e-16 / h²
        let order_two = fine <= 0.3 * coarse;
        assert!(order_two || fine <= 2e-9, "derivative {k} at {u} {v}: {coarse:.1e} {fine:.1e}");
    }
}

const INNER: [[f64; 2]; 5] = [[0.3, 0.3], [0.6, 0.1], [0.1, 0.2], [0.05, 0.85], [0.4, 0.55]];

#[test]
fn derivatives_of_triangles() {
    let waves = |x: f64, y: f64| (3.0 * x).sin() * (2.0 * y).cos() * 0.5;
    let mesh = common::graph(3, waves, 5).mesh();
    let normals = nagata::CornerNormals::from_fn(&mesh, |p| {
        let (sx, cx) = (3.0 * p.x).sin_cos();
        let (sy, cy) = (2.0 * p.y).sin_cos();
        Some(DVec3::new(-1.5 * cx * cy, sx * sy, 1.0))
    });
    let mut cubic = 0;
    for settings in [Settings::position(), Settings::published(), Settings::tangent_plane()] {
        let surface = build(&mesh, &normals, settings);
        cubic += surface.report().cubic;
        for face in mesh.faces() {
            for [u, v] in INNER {
                let at = Barycentric::new(u, v);
                match surface.patch(face) {
                    Patch::Triangle(p) => {
                        check(&p.jet(at), |u, v| p.point(Barycentric::new(u, v)), u, v);
                    }
                    Patch::TangentPlane(p) => {
                        let jet = p.jet(at);
                        check(&jet, |u, v| p.point(Barycentric::new(u, v)), u, v);
                        let [d0, d1, d2] = p.partials(at);
                        assert!(jet.du.distance(d0 - d2) <= 1e-13, "{u} {v}");
                        assert!(jet.dv.distance(d1 - d2) <= 1e-13, "{u} {v}");
                    }
                    Patch::Quad(_) => panic!("no quadrilaterals here"),
                }
            }
        }
    }
    assert!(cubic > 0, "no cubic edge was tested");
}

#[test]
fn derivatives_of_quadrilaterals() {
    let mesh = common::torus(7, 5, false).mesh();
    let surface = build(&mesh, &common::smooth(&mesh, &TORUS), Settings::position());
    for face in mesh.faces().take(5) {
        let Patch::Quad(patch) = surface.patch(face) else { panic!("a triangle") };
        for [u, v] in INNER {
            check(&patch.jet([u, v]), |u, v| patch.point([u, v]), u, v);
        }
    }
}

#[test]
fn first_derivatives_have_limits_at_the_corners() {
    let mesh = common::sphere(1).mesh();
    for settings in [Settings::published(), Settings::tangent_plane()] {
        let surface = build(&mesh, &common::smooth(&mesh, &SPHERE), settings);
        let Patch::TangentPlane(patch) = surface.patch(FaceId::new(0)) else { panic!("not G1") };
        let at_corner = patch.partials(Barycentric::at(Corner::First));
        for direction in [0.0, 0.3, 0.5, 1.0] {
            for r in [1e-3, 1e-6, 1e-12, 1e-100, 1e-300] {
                let at = Barycentric::from_array([1.0 - r, r * (1.0 - direction), r * direction]);
                let near = patch.partials(at);
                for (a, b) in near.into_iter().zip(at_corner) {
                    assert!(a.distance(b) <= 10.0 * r + 1e-15, "{r:e}: {a} {b}");
                }
                let normal = patch.normal(at).unwrap();
                let corner = patch.corner_normal(Corner::First).unwrap();
                assert!(normal.distance(corner) <= 10.0 * r + 1e-15, "{r:e}: {normal} {corner}");
            }
        }
        assert_eq!(patch.curvature(Barycentric::at(Corner::First)), None);
    }
}

#[test]
fn curvature_of_spheres_converges() {
    // C0: principal curvatures -1 with an error of order h²; at fixed parameters inside the patch
    let worst = |n: usize, settings: Settings| {
        let mesh = common::sphere(n).mesh();
        let surface = build(&mesh, &common::smooth(&mesh, &SPHERE), settings);
        let mut worst: f64 = 0.0;
        for face in mesh.faces() {
            for [u, v] in INNER {
                let at = Barycentric::new(u, v);
                let jet = match surface.patch(face) {
                    Patch::Triangle(p) => p.jet(at),
                    Patch::TangentPlane(p) => p.jet(at),
                    Patch::Quad(p) => p.jet([u, v]),
                };
                for k in jet.surface_jet().unwrap().principal_curvatures() {
                    worst = worst.max((k + 1.0).abs());
                }
            }
        }
        worst
    };
    let (coarse, fine) = (worst(8, Settings::position()), worst(16, Settings::position()));
    assert!((coarse / fine).log2() >= 1.8, "{coarse} {fine}");
    assert!(fine <= 0.02, "{fine}");
}

#[test]
fn areas_of_spheres_converge_and_are_as_accurate_as_promised() {
    let area = |n: usize, accuracy: f64| {
        let mesh = common::sphere(n).mesh();
        build(&mesh, &common::smooth(&mesh, &SPHERE), Settings::position()).area(accuracy)
    };
    let precise = area(4, 1e-13);
    for accuracy in [1e-3, 1e-6, 1e-9] {
        let rough = area(4, accuracy);
        let error = (rough.value - precise.value).abs();
        assert!(error <= accuracy * precise.value, "{accuracy:e}: {error:e}");
        assert!(rough.error <= accuracy * precise.value, "{rough:?}");
    }
    let [coarse, fine] = [8, 16].map(|n| (area(n, 1e-12).value - 4.0 * PI).abs());
    assert!((coarse / fine).log2() >= 3.8, "{coarse:e} {fine:e}");
    // of a G1 surface and of quadrilaterals
    let mesh = common::torus(24, 12, true).mesh();
    let normals = common::smooth(&mesh, &TORUS);
    let torus = build(&mesh, &normals, Settings::tangent_plane()).area(1e-6);
    assert!((torus.value / (8.0 * PI * PI) - 1.0).abs() <= 2e-3, "{torus:?}");
    let mesh = common::torus(24, 12, false).mesh();
    let normals = common::smooth(&mesh, &TORUS);
    let torus = build(&mesh, &normals, Settings::position()).area(1e-9);
    assert!((torus.value / (8.0 * PI * PI) - 1.0).abs() <= 1e-3, "{torus:?}");
}
