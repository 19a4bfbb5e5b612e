//! Enclosures of the Hessian: outward, tight on small boxes, honest at kinks and jumps.

#![allow(clippy::missing_assert_message, reason = "helpers of tests fail like tests")]

mod boxes;
mod common;

use boxes::{cube, formula, samples};
use common::{FORMULAS, any_box, formula_region};
use implicit::glam::{DMat3, DVec3};
use implicit::{
    Aabb, BoundedField, Closure, ImplicitSurface, Interval, Level, Sphere, Torus, catalogue,
};
use proptest::prelude::*;
use testkit::conformance::field::sample_points;

const ZERO: Interval = Interval { lo: 0.0, hi: 0.0 };

/// xx, yy, zz, xy, yz, zx.
fn six(hessian: DMat3) -> [f64; 6] {
    let [x, y, z] = [hessian.x_axis, hessian.y_axis, hessian.z_axis];
    [x.x, y.y, z.z, x.y, y.z, z.x]
}

fn rows([xx, yy, zz, xy, yz, zx]: [Interval; 6]) -> [[Interval; 3]; 3] {
    [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
}

/// The Hessians at sampled points are inside, to the last bit.
#[track_caller]
fn check(name: &str, field: &dyn ImplicitSurface, region: &Aabb, count: u32) {
    let enclosure = field.hessian_enclosure(region);
    assert!(enclosure.iter().all(|h| h.lo <= h.hi), "{name}: {enclosure:?}");
    for p in samples(region, count) {
        let jet = field.jet(p);
        if jet.value.is_nan() {
            continue;
        }
        for (k, (second, bounds)) in six(jet.hessian).into_iter().zip(enclosure).enumerate() {
            assert!(
                bounds.contains(second) || second.is_nan(),
                "{name}: no. {k}, {second}, at {p} is outside {bounds:?} over {region:?}"
            );
        }
    }
}

/// The slopes of the gradient between sampled points are inside, up to the rounding of the gradients.
#[track_caller]
fn check_slopes(name: &str, field: &dyn ImplicitSurface, region: &Aabb) {
    let rows = rows(field.hessian_enclosure(region));
    let points: Vec<DVec3> = samples(region, 20).collect();
    let rounding_at = |p: DVec3| field.gradient_enclosure(&cube(p, 0.0)).map(Interval::width);
    for (i, &p) in points.iter().enumerate() {
        for &q in &points[i + 1..] {
            let change = field.value_gradient(q).1 - field.value_gradient(p).1;
            let rounding = [rounding_at(p), rounding_at(q)];
            for (axis, row) in rows.iter().enumerate() {
                let terms = row.iter().zip((q - p).to_array());
                let reach = terms.fold(ZERO, |sum, (&h, d)| sum + h * Interval::new(d, d));
                let excess = rounding[0][axis] + rounding[1][axis];
                let change = change[axis];
                assert!(
                    change.is_nan() || (reach.lo - excess <= change && change <= reach.hi + excess),
                    "{name}: from {p} to {q} derivative {axis} changes by {change}, outside {reach:?}"
                );
            }
        }
    }
}

fn check_shrinks(name: &str, field: &dyn ImplicitSurface, points: &[DVec3], size: f64) {
    let width = |p: DVec3, size: f64| {
        let enclosure = field.hessian_enclosure(&cube(p, size));
        enclosure.iter().map(|h| h.width()).fold(0.0, f64::max)
    };
    for &p in points {
        let (coarse, fine) = (width(p, size), width(p, size / 16.0));
        let order = (coarse / fine).log2() / 4.0;
        let largest = six(field.jet(p).hessian).into_iter().map(f64::abs).fold(0.0, f64::max);
        let rounding = 256.0 * f64::EPSILON * largest;
        assert!(
            order >= 0.8 || coarse <= rounding,
            "{name}: order {order} at {p}, widths {coarse} and {fine}"
        );
    }
}

#[test]
fn named_shapes() {
    for shape in catalogue() {
        let field = shape.field();
        let size = shape.region.size().min_element();
        let points = sample_points(&shape.region, 40);
        check(shape.name, &field, &shape.region, 500);
        for (&p, share) in points.iter().zip([0.0, 1e-9, 1e-3, 0.1].into_iter().cycle()) {
            check(shape.name, &field, &cube(p, share * size), 50);
            check_slopes(shape.name, &field, &cube(p, share * size));
        }
        check_shrinks(shape.name, &field, &points, 0.02 * size);
    }
}

#[test]
fn named_shapes_as_formulas() {
    for shape in catalogue() {
        let field = formula(shape.formula);
        let size = shape.region.size().min_element();
        for p in sample_points(&shape.region, 40) {
            check(shape.formula, &field, &cube(p, 0.05 * size), 50);
        }
    }
}

#[test]
fn formulas_with_every_function() {
    for text in FORMULAS {
        let field = formula(text);
        let points = sample_points(&formula_region().expanded(0.9), 40);
        check(text, &field, &formula_region(), 500);
        for (&p, size) in points.iter().zip([0.0, 1e-9, 1e-3, 0.1].into_iter().cycle()) {
            check(text, &field, &cube(p, size), 50);
            check_slopes(text, &field, &cube(p, size));
        }
        check_shrinks(text, &field, &points, 0.02);
    }
}

/// Where every operation is tight, so is the result.
#[test]
fn polynomials_are_tight() {
    let region = Aabb { min: DVec3::new(-1.0, 2.0, 0.0), max: DVec3::new(3.0, 4.0, 0.5) };
    let sphere = [(2.0, 2.0), (2.0, 2.0), (2.0, 2.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)];
    let cubic = [(-6.0, 18.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.5), (-1.0, 3.0), (2.0, 4.0)];
    let fields: [(Box<dyn ImplicitSurface>, _); 3] = [
        (Box::new(Sphere::default()), sphere),
        (Box::new(formula("x^2 + y^2 + z^2 = 1")), sphere),
        (Box::new(formula("x^3 + x*y*z")), cubic),
    ];
    for (field, expected) in fields {
        for (second, (lo, hi)) in field.hessian_enclosure(&region).into_iter().zip(expected) {
            assert!(second.contains(lo) && second.contains(hi), "{second:?}");
            let excess = 4.0 * f64::EPSILON * hi;
            assert!(second.lo >= lo - excess && second.hi <= hi + excess, "{second:?}");
        }
    }
}

/// Nothing is known across a kink; along it, and in boxes beside it, the second derivatives stay.
#[test]
fn kinks_are_unbounded() {
    let around_zero = Aabb::from_half_size(1.0);
    let right = Aabb { min: DVec3::new(0.0, -1.0, -1.0), max: DVec3::ONE };
    let left = Aabb { min: DVec3::splat(-1.0), max: DVec3::new(0.0, 1.0, 1.0) };
    let all = Interval::ENTIRE;
    for (text, region, [xx, yy, xy]) in [
        ("abs(x)", around_zero, [all, ZERO, ZERO]),
        ("abs(x)", right, [ZERO; 3]),
        // at zero the gradient is that of the right
        ("abs(x)", left, [all, ZERO, ZERO]),
        ("-abs(2*x - y)", around_zero, [all; 3]),
        ("sin(exp(abs(x)))", around_zero, [all, ZERO, ZERO]),
        ("1/(3 + abs(x - y))", around_zero, [all; 3]),
        ("max(x, -x)", around_zero, [all, ZERO, ZERO]),
        ("max(x, y)", around_zero, [all; 3]),
        ("min(x, y)", around_zero, [all; 3]),
        ("min(x + y, y - x)", around_zero, [all, ZERO, ZERO]),
        ("min(x, y - 2)", right, [ZERO; 3]),
        ("max(x, y - 2)", right, [ZERO; 3]),
        ("max(x, 0)^2", around_zero, [all, ZERO, ZERO]),
    ] {
        let field = formula(text);
        let [by_xx, by_yy, by_zz, by_xy, by_yz, by_zx] = field.hessian_enclosure(&region);
        assert_eq!([by_xx, by_yy, by_xy], [xx, yy, xy], "{text}");
        assert_eq!([by_zz, by_yz, by_zx], [ZERO; 3], "{text}");
        check(text, &field, &region, 100);
        check_slopes(text, &field, &region);
    }
}

/// The product |x| y bends across x = 0 only in x.
#[test]
fn a_kink_leaves_mixed_derivatives_bounded() {
    let [xx, yy, _, xy, ..] = formula("abs(x)*y").hessian_enclosure(&Aabb::from_half_size(1.0));
    assert_eq!([xx, yy], [Interval::ENTIRE, ZERO]);
    assert!(xy.contains(-1.0) && xy.contains(1.0) && xy.width() < 2.001, "{xy:?}");
}

/// A jump or a pole has no second derivative that an enclosure could contain, whatever is around it.
#[test]
fn jumps_and_poles_are_unbounded() {
    let region = Aabb { min: DVec3::splat(-2.0), max: DVec3::splat(2.0) };
    let outer = ["{}", "tanh({})", "exp({})", "sin({})", "abs({})", "({})^2", "1/({})", "({})^0.5"];
    for inner in ["1/x", "tan(x)", "atan2(x, y)", "x^-1", "x^-3", "ln(x)", "sqrt(x)", "x^-0.5"] {
        for outer in outer {
            let text = outer.replace("{}", inner);
            let [xx, ..] = formula(&text).hessian_enclosure(&region);
            let unbounded = xx.lo.is_infinite() || xx.hi.is_infinite();
            assert!(unbounded, "{text}: {xx:?}");
            let jumps = ["1/x", "tan(x)", "atan2(x, y)", "x^-1", "x^-3"].contains(&inner);
            assert!(!jumps || xx == Interval::ENTIRE, "{text}: {xx:?}");
        }
    }
}

/// The cut of atan2 away from the origin, where the derivatives are small on both sides.
#[test]
fn the_cut_of_an_angle_is_a_jump() {
    let across = Aabb { min: DVec3::new(-2.0, -1.0, 0.0), max: DVec3::new(-1.0, 1.0, 1.0) };
    let above = Aabb { min: DVec3::new(-2.0, 0.5, 0.0), ..across };
    let angle = formula("atan2(y, x)");
    let [xx, yy, _, xy, ..] = angle.hessian_enclosure(&across);
    assert_eq!([xx, yy, xy], [Interval::ENTIRE; 3]);
    assert!(angle.hessian_enclosure(&above).iter().all(|second| second.width() < 10.0));
    check_slopes("above the cut", &angle, &above);
}

/// Over single points nothing but the outward rounding covers the rounding in `f64`.
#[test]
fn points_are_covered() {
    let region = Aabb::from_half_size(3.0);
    for text in [
        "atan2(x, y) + atan2(z, x)",
        "tanh(x)*tanh(3*y) - tanh(z)",
        "x^1.3 - y^-0.3",
        "x^2.1 + z^0.1",
    ] {
        let field = formula(text);
        for p in sample_points(&region, 5000) {
            check(text, &field, &cube(p, 0.0), 0);
        }
    }
}

/// Where x = ±y one of the second derivatives of the angle cancels.
#[test]
fn cancelling_second_derivatives_are_covered() {
    let angle = formula("atan2(y, x)");
    for i in 1..2000_i32 {
        let x = 0.01 * f64::from(i);
        for y in [x, -x, x.next_up(), -x.next_down(), x * (1.0 + 1e-12)] {
            for p in [DVec3::new(x, y, 0.0), DVec3::new(-x, y, 0.0)] {
                check("atan2(y, x)", &angle, &cube(p, 0.0), 0);
            }
        }
    }
}

#[test]
fn wrappers_pass_it_on() {
    let region = cube(DVec3::new(5.5, 0.0, 0.5), 0.25);
    let torus = Torus::default();
    let expected = torus.hessian_enclosure(&region);
    assert!(expected.iter().all(|h| h.width() < 1.0), "{expected:?}");
    let level = Level { field: torus, level: 0.25 };
    assert_eq!(level.hessian_enclosure(&region), expected);
    let boxed: Box<dyn ImplicitSurface> = Box::new(torus);
    assert_eq!(boxed.hessian_enclosure(&region), expected);
    let reference: &dyn BoundedField = &boxed;
    assert_eq!(Level { field: reference, level: 1.0 }.hessian_enclosure(&region), expected);
    let closure = Closure::new(|[x, _, _]| x);
    assert_eq!(closure.hessian_enclosure(&region), [Interval::ENTIRE; 6]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn enclosures_contain_all_hessians(region in any_box()) {
        for text in FORMULAS {
            check(text, &formula(text), &region, 30);
        }
        for shape in catalogue() {
            check(shape.name, &shape.field(), &region, 30);
        }
    }
}
