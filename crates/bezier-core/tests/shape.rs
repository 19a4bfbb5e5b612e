//! Normals and fundamental forms against surfaces whose shape is known, and under changes of the
//! parametrisation.

mod common;

use bezier_core::glam::{DMat3, DVec3};
use bezier_core::{
    Barycentric, BezierTriangle, MultiIndex, ParametricPatch, QuadraticTriangle, SepticTriangle,
};
use common::{parameters, points};
use proptest::prelude::*;

/// The graph `z = a x² / 2 + b x y + c y² / 2` over a triangle of the plane.
fn graph([a, b, c]: [f64; 3], corners: [[f64; 2]; 3]) -> QuadraticTriangle {
    BezierTriangle::from_fn(|m| {
        let exponents = [m.i, m.j, m.k];
        let twice: Vec<[f64; 2]> =
            (0..3).flat_map(|k| std::iter::repeat_n(corners[k], exponents[k])).collect();
        let [p, q] = [twice[0], twice[1]];
        // the polar form of the height
        let height = 0.5 * (a * p[0] * q[0] + b * (p[0] * q[1] + p[1] * q[0]) + c * p[1] * q[1]);
        DVec3::new(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), height)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_graph_of_a_quadratic(
        form in prop::array::uniform3(-1.0..1.0_f64),
        jitter in prop::array::uniform3(prop::array::uniform2(-0.2..0.2_f64)),
        at in parameters(),
    ) {
        let regular = [[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.8]];
        let corners = std::array::from_fn(|i| [regular[i][0] + jitter[i][0], regular[i][1] + jitter[i][1]]);
        let [a, b, c] = form;
        let patch: SepticTriangle = graph(form, corners).elevate_to();
        let jet = patch.jet(at).surface_jet().expect("the corners are not collinear");
        let DVec3 { x, y, z } = jet.point;
        let tolerance = 1e-11;
        prop_assert!((z - (0.5 * a * x * x + b * x * y + 0.5 * c * y * y)).abs() <= tolerance);
        let slope = DVec3::new(-(a * x + b * y), -(b * x + c * y), 1.0);
        prop_assert!(jet.normal.distance(slope.normalize()) <= tolerance);
        // II = Hessian of the height over the length of the slope vector, on horizontal directions
        for ([dx, dy], [ex, ey]) in [([1.0, 0.0], [1.0, 0.0]), ([1.0, 0.0], [0.0, 1.0]), ([0.3, -0.8], [0.5, 0.9])] {
            let lift = |dx: f64, dy: f64| DVec3::new(dx, dy, -(slope.x * dx + slope.y * dy));
            let expected = (a * dx * ex + b * (dx * ey + dy * ex) + c * dy * ey) / slope.length();
            let found = jet.second_form(lift(dx, dy), lift(ex, ey));
            prop_assert!((found - expected).abs() <= tolerance, "{found} for {expected}");
        }
        prop_assert!((jet.second_fundamental_form * jet.normal).length() <= tolerance);
    }

    /// The geometry does not depend on which corner comes first, nor on the motion of the whole.
    #[test]
    fn shape_is_geometric(
        offsets in points::<36>(),
        at in parameters(),
        axis in prop::array::uniform3(-1.0..1.0_f64),
        angle in -3.0..3.0_f64,
    ) {
        let corners = [DVec3::X, DVec3::new(-0.5, 0.8, 0.0), DVec3::new(-0.5, -0.8, 0.0)];
        let patch = SepticTriangle::from_fn(|m| {
            let flat = (corners[0] * m.i as f64 + corners[1] * m.j as f64 + corners[2] * m.k as f64) / 7.0;
            flat + offsets[m.rank()] * 0.003
        });
        let jet = patch.jet(at).surface_jet().expect("nearly flat");

        let turned = SepticTriangle::from_fn(|m| patch[MultiIndex::new(m.k, m.i, m.j)]);
        let same = turned.jet(Barycentric { u: at.v, v: at.w, w: at.u }).surface_jet().unwrap();
        prop_assert!(same.point.distance(jet.point) <= 1e-12);
        prop_assert!(same.normal.distance(jet.normal) <= 1e-12);
        prop_assert!(largest(same.second_fundamental_form - jet.second_fundamental_form) <= 1e-9);

        let axis = DVec3::from_array(axis).try_normalize().unwrap_or(DVec3::Z);
        let rotation = DMat3::from_axis_angle(axis, angle);
        let moved = BezierTriangle::new(patch.net().map(|p| rotation * p + DVec3::ONE));
        let moved = moved.jet(at).surface_jet().unwrap();
        prop_assert!(moved.normal.distance(rotation * jet.normal) <= 1e-12);
        let expected = rotation * jet.second_fundamental_form * rotation.transpose();
        prop_assert!(largest(moved.second_fundamental_form - expected) <= 1e-9);

        // mirrored corners: the other side
        let mirrored = SepticTriangle::from_fn(|m| patch[MultiIndex::new(m.j, m.i, m.k)]);
        let other = mirrored.jet(Barycentric { u: at.v, v: at.u, w: at.w }).surface_jet().unwrap();
        prop_assert!(other.normal.distance(-jet.normal) <= 1e-12);
        prop_assert!(largest(other.second_fundamental_form + jet.second_fundamental_form) <= 1e-9);
    }
}

fn largest(m: DMat3) -> f64 {
    m.to_cols_array().map(f64::abs).into_iter().fold(0.0, f64::max)
}

#[test]
fn collapsed_patches_have_no_normal() {
    let line = SepticTriangle::from_fn(|m| DVec3::X * m.i as f64);
    assert_eq!(line.jet(Barycentric::CENTROID).normal(), None);
    assert_eq!(line.jet(Barycentric::CENTROID).surface_jet(), None);
    let point = SepticTriangle::new([DVec3::ONE; 36]);
    assert_eq!(point.jet(Barycentric::CENTROID).surface_jet(), None);
}
