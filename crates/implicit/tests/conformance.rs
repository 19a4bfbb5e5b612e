//! Every kind of field keeps the promises of the traits.

mod common;

use common::{FORMULAS, any_box, formula_region};
use implicit::glam::DVec3;
use implicit::{
    Aabb, Closure, Formula, ImplicitSurface, Interval, Jet2, Level, Number, Sphere, catalogue,
};
use proptest::prelude::*;
use testkit::conformance::field::{
    check_consistency, check_derivatives, check_enclosure, check_enclosure_shrinks, sample_points,
};

fn check_all(name: &str, field: &dyn ImplicitSurface, region: &Aabb) {
    let size = region.size().min_element();
    let inner = region.expanded(0.9);
    // the 40th point of some shapes may hit a kink; none does here, and 40 is a full batch and more
    check_consistency(name, field, &sample_points(region, 40));
    check_derivatives(name, field, &sample_points(&inner, 50), 2e-3 * size);
    check_enclosure(name, field, region, 1000);
    for center in sample_points(&inner, 20) {
        let half = DVec3::splat(0.02 * size);
        check_enclosure(name, field, &Aabb { min: center - half, max: center + half }, 50);
    }
}

#[test]
fn named_shapes() {
    for shape in catalogue() {
        let field = shape.field();
        check_all(shape.name, &field, &shape.region);
        let size = 0.02 * shape.region.size().min_element();
        check_enclosure_shrinks(shape.name, &field, &sample_points(&shape.region, 50), size);
    }
}

#[test]
fn formulas_of_named_shapes() {
    for shape in catalogue() {
        check_all(shape.formula, &Formula::parse(shape.formula).unwrap(), &shape.region);
    }
}

#[test]
fn formulas_with_every_function() {
    for text in FORMULAS {
        check_all(text, &Formula::parse(text).unwrap(), &formula_region());
    }
}

#[test]
fn enclosures_of_formulas_shrink() {
    // a constant has the same enclosure over all boxes
    for text in FORMULAS.into_iter().filter(|text| *text != "42") {
        let formula = Formula::parse(text).unwrap();
        check_enclosure_shrinks(text, &formula, &sample_points(&formula_region(), 50), 0.05);
    }
}

#[test]
fn a_formula_too_long_for_the_stack() {
    let terms: Vec<String> = (1..100).map(|i| format!("sin({i}*x)/{i}^2*y")).collect();
    let formula = Formula::parse(&terms.join(" + ")).unwrap();
    assert!(formula.operation_count() > 200, "the case is meant to need the heap");
    check_all("long sum", &formula, &formula_region());
}

#[test]
fn closures() {
    let [a, b] = [0.7, 1.3];
    let field = Closure::new(move |[x, y, z]: [Jet2; 3]| {
        (a * x.square() + b * y.square()).sqrt() - 1.0 / (z + 2.0) + (x * y).sin().abs().exp()
    });
    check_all("closure", &field, &formula_region());
    let formula =
        Formula::parse("sqrt(0.7*x^2 + 1.3*y^2) - 1/(z + 2) + exp(abs(sin(x*y)))").unwrap();
    for p in sample_points(&formula_region(), 20) {
        use implicit::TwiceDifferentiable;
        let (closure, formula) = (field.jet(p), formula.jet(p));
        let size = formula.hessian.to_cols_array().iter().fold(1.0_f64, |a, b| a.max(b.abs()));
        let difference = (closure.hessian - formula.hessian).to_cols_array();
        assert!(difference.iter().all(|d| d.abs() <= 16.0 * f64::EPSILON * size), "at {p}");
        assert!((closure.value - formula.value).abs() <= 16.0 * f64::EPSILON * size, "at {p}");
    }
}

#[test]
fn levels_references_and_boxes() {
    let region = Aabb::from_half_size(2.0);
    let level = Level { field: Sphere::default(), level: 0.25 };
    check_all("level", &level, &region);
    check_all("reference", &&level, &region);
    let boxed: Box<dyn ImplicitSurface> = Box::new(level);
    check_all("box", &boxed, &region);
    check_all("level of a box", &Level { field: boxed, level: -0.5 }, &region);
}

#[test]
fn ties_have_one_sided_derivatives() {
    use implicit::{ImplicitField, TwiceDifferentiable};
    for (text, expected) in [
        ("abs(x)", DVec3::X),
        ("max(x, y)", DVec3::X),
        ("min(y, x)", DVec3::Y),
        ("max(x, -x)", DVec3::X),
        ("min(x, x + y)", DVec3::X),
    ] {
        let formula = Formula::parse(text).unwrap();
        assert_eq!(formula.value_gradient(DVec3::ZERO), (0.0, expected), "{text}");
        assert!(formula.jet(DVec3::ZERO).hessian.is_finite(), "{text}");
    }
}

#[test]
fn powers_of_zero_have_finite_derivatives() {
    use implicit::TwiceDifferentiable;
    for text in ["x^0", "x^1", "x^2", "x^3", "x^1024", "x^2.5", "x^0*y"] {
        let jet = Formula::parse(text).unwrap().jet(DVec3::ZERO);
        assert!(jet.gradient.is_finite() && jet.hessian.is_finite(), "{text}: {jet:?}");
    }
}

#[test]
fn undefined_values_are_nan_and_stay_nan() {
    use implicit::ImplicitField;
    for text in ["sqrt(x)", "ln(x)", "min(sqrt(x), y)", "max(y, ln(x))", "x^0.3"] {
        let value = Formula::parse(text).unwrap().value(-DVec3::ONE);
        assert!(value.is_nan(), "{text} is {value}");
    }
}

#[test]
fn a_closure_knows_no_enclosure() {
    use implicit::BoundedField;
    let field = Closure::new(|[x, _, _]| x);
    assert_eq!(field.enclosure(&Aabb::from_half_size(1.0)), Interval::ENTIRE);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn enclosures_contain_all_values(region in any_box()) {
        for text in FORMULAS {
            check_enclosure(text, &Formula::parse(text).unwrap(), &region, 30);
        }
        for shape in catalogue() {
            check_enclosure(shape.name, &shape.field(), &region, 30);
        }
    }
}
