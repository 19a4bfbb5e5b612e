//! Enclosures of the gradient: outward, tight on small boxes, honest at kinks and jumps.

#![allow(clippy::missing_assert_message, reason = "helpers of tests fail like tests")]

mod boxes;
mod common;

use boxes::{cube, formula, samples};
use common::{FORMULAS, any_box, formula_region};
use implicit::glam::DVec3;
use implicit::{
    Aabb, BoundedField, Closure, ImplicitSurface, Interval, Level, Sphere, Torus, catalogue,
};
use proptest::prelude::*;
use testkit::conformance::field::sample_points;

/// The gradients at sampled points are inside, to the last bit.
#[track_caller]
fn check(name: &str, field: &dyn BoundedField, region: &Aabb, count: u32) {
    let enclosure = field.gradient_enclosure(region);
    assert!(enclosure.iter().all(|g| g.lo <= g.hi), "{name}: {enclosure:?}");
    for p in samples(region, count) {
        let (value, gradient) = field.value_gradient(p);
        if value.is_nan() {
            continue;
        }
        for (axis, slope) in enclosure.iter().enumerate() {
            let component = gradient[axis];
            assert!(
                slope.contains(component) || component.is_nan(),
                "{name}: {component} at {p} is outside {slope:?} over {region:?}"
            );
        }
    }
}

/// The slopes between sampled points are inside, up to the rounding of the values.
#[track_caller]
fn check_slopes(name: &str, field: &dyn BoundedField, region: &Aabb) {
    let enclosure = field.gradient_enclosure(region);
    let points: Vec<DVec3> = samples(region, 20).collect();
    let rounding_at = |p: DVec3| field.enclosure(&Aabb { min: p, max: p }).width();
    for (i, &p) in points.iter().enumerate() {
        for &q in &points[i + 1..] {
            let step = q - p;
            let terms = enclosure.iter().zip(step.to_array());
            let reach =
                terms.fold(Interval::new(0.0, 0.0), |sum, (&g, d)| sum + g * Interval::new(d, d));
            let (a, b) = (field.value(p), field.value(q));
            let rounding = rounding_at(p) + rounding_at(q);
            let change = b - a;
            assert!(
                change.is_nan() || (reach.lo - rounding <= change && change <= reach.hi + rounding),
                "{name}: from {p} to {q} the value changes by {change}, outside {reach:?}"
            );
        }
    }
}

fn check_shrinks(name: &str, field: &dyn BoundedField, points: &[DVec3], size: f64) {
    let width = |p: DVec3, size: f64| {
        let enclosure = field.gradient_enclosure(&cube(p, size));
        enclosure.iter().map(|g| g.width()).fold(0.0, f64::max)
    };
    for &p in points {
        let (coarse, fine) = (width(p, size), width(p, size / 16.0));
        let order = (coarse / fine).log2() / 4.0;
        let rounding = 256.0 * f64::EPSILON * field.value_gradient(p).1.abs().max_element();
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
    let expected = [(-2.0, 6.0), (4.0, 8.0), (0.0, 1.0)];
    for field in [&Sphere::default() as &dyn BoundedField, &formula("x^2 + y^2 + z^2 = 1")] {
        for (slope, (lo, hi)) in field.gradient_enclosure(&region).into_iter().zip(expected) {
            assert!(slope.contains(lo) && slope.contains(hi), "{slope:?}");
            let excess = 2.0 * f64::EPSILON * hi;
            assert!(slope.lo >= lo - excess && slope.hi <= hi + excess, "{slope:?}");
        }
    }
}

#[test]
fn kinks_give_the_hull_of_both_sides() {
    let around_zero = Aabb::from_half_size(1.0);
    let right = Aabb { min: DVec3::new(0.0, -1.0, -1.0), max: DVec3::ONE };
    let both = Interval::new(-1.0, 1.0);
    for (text, region, expected) in [
        ("abs(x)", around_zero, [both, Interval::new(0.0, 0.0)]),
        ("abs(x)", right, [Interval::new(1.0, 1.0), Interval::new(0.0, 0.0)]),
        ("max(x, y)", around_zero, [Interval::new(0.0, 1.0); 2]),
        ("min(x, y - 1)", around_zero, [Interval::new(0.0, 1.0); 2]),
        ("min(x, y - 2)", right, [Interval::new(0.0, 0.0), Interval::new(1.0, 1.0)]),
        ("max(x, y - 2)", right, [Interval::new(1.0, 1.0), Interval::new(0.0, 0.0)]),
    ] {
        let [by_x, by_y, _] = formula(text).gradient_enclosure(&region);
        // multiplication rounds outward by one unit in the last place
        for (slope, expected) in [by_x, by_y].into_iter().zip(expected) {
            assert!(
                slope.contains(expected.lo) && slope.contains(expected.hi),
                "{text}: {slope:?}"
            );
            assert!(slope.width() <= expected.width() + 4.0 * f64::EPSILON, "{text}: {slope:?}");
        }
        check_slopes(text, &formula(text), &region);
    }
}

/// A jump or a pole has no slope that an enclosure could contain, whatever is around it.
#[test]
fn jumps_and_poles_are_unbounded() {
    let region = Aabb { min: DVec3::splat(-2.0), max: DVec3::splat(2.0) };
    let outer = ["{}", "tanh({})", "exp({})", "sin({})", "abs({})", "({})^2", "1/({})", "({})^0.5"];
    for inner in ["1/x", "tan(x)", "atan2(x, y)", "x^-1", "x^-3", "ln(x)", "sqrt(x)", "x^-0.5"] {
        for outer in outer {
            let text = outer.replace("{}", inner);
            let [by_x, ..] = formula(&text).gradient_enclosure(&region);
            let unbounded = by_x.lo.is_infinite() || by_x.hi.is_infinite();
            assert!(unbounded, "{text}: {by_x:?}");
            // the slope across 1/x is positive, that of its branches negative
            let jumps = ["1/x", "tan(x)", "atan2(x, y)", "x^-1", "x^-3"].contains(&inner);
            assert!(!jumps || by_x == Interval::ENTIRE, "{text}: {by_x:?}");
        }
    }
}

/// The cut of atan2 away from the origin, where the derivatives are small on both sides.
#[test]
fn the_cut_of_an_angle_is_a_jump() {
    let across = Aabb { min: DVec3::new(-2.0, -1.0, 0.0), max: DVec3::new(-1.0, 1.0, 1.0) };
    let above = Aabb { min: DVec3::new(-2.0, 0.5, 0.0), ..across };
    let angle = formula("atan2(y, x)");
    assert_eq!(angle.gradient_enclosure(&across)[..2], [Interval::ENTIRE; 2]);
    assert!(angle.gradient_enclosure(&above).iter().all(|slope| slope.width() < 3.0));
    check_slopes("above the cut", &angle, &above);
}

/// Over single points nothing but the outward rounding covers the rounding in `f64`.
#[test]
fn points_are_covered() {
    let region = Aabb::from_half_size(3.0);
    for text in ["atan2(x, y) + atan2(z, x)", "tanh(x)*tanh(3*y) - tanh(z)", "x^1.3 - y^-0.3"] {
        let field = formula(text);
        for p in sample_points(&region, 5000) {
            check(text, &field, &Aabb { min: p, max: p }, 0);
        }
    }
}

#[test]
fn wrappers_pass_it_on() {
    let region = cube(DVec3::new(5.5, 0.0, 0.5), 0.25);
    let torus = Torus::default();
    let expected = torus.gradient_enclosure(&region);
    assert!(expected.iter().all(|g| g.width() < 1.0), "{expected:?}");
    let level = Level { field: torus, level: 0.25 };
    assert_eq!(level.gradient_enclosure(&region), expected);
    let boxed: Box<dyn ImplicitSurface> = Box::new(torus);
    assert_eq!(boxed.gradient_enclosure(&region), expected);
    let reference: &dyn BoundedField = &boxed;
    assert_eq!(Level { field: reference, level: 1.0 }.gradient_enclosure(&region), expected);
    let closure = Closure::new(|[x, _, _]| x);
    assert_eq!(closure.gradient_enclosure(&region), [Interval::ENTIRE; 3]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn enclosures_contain_all_gradients(region in any_box()) {
        for text in FORMULAS {
            check(text, &formula(text), &region, 30);
        }
        for shape in catalogue() {
            check(shape.name, &shape.field(), &region, 30);
        }
    }
}
