//! Formulas travel as text, plain data as its fields.
#![cfg(feature = "serde")]

use implicit::glam::DVec3;
use implicit::{Aabb, Chair, Formula, ImplicitField};

#[test]
fn a_formula_is_its_text_with_constants_filled_in() {
    let formula = Formula::parse_with("x^2 + y^2 = r", &[("r", 0.1)]).unwrap();
    let json = serde_json::to_string(&formula).unwrap();
    assert_eq!(json, "\"x^2 + y^2 = (0.1)\"");
    let again: Formula = serde_json::from_str(&json).unwrap();
    let p = DVec3::new(0.3, 0.7, -1.0);
    assert_eq!(again.value(p).to_bits(), formula.value(p).to_bits());
}

#[test]
fn a_broken_formula_is_refused_with_the_message() {
    let error = serde_json::from_str::<Formula>("\"x +\"").unwrap_err();
    assert!(error.to_string().contains("expected a number"), "{error}");
}

#[test]
fn plain_data_survives() {
    let region = Aabb::from_half_size(1.5);
    let json = serde_json::to_string(&region).unwrap();
    assert_eq!(serde_json::from_str::<Aabb>(&json).unwrap(), region);
    let json = serde_json::to_string(&Chair::default()).unwrap();
    assert_eq!(serde_json::from_str::<Chair>(&json).unwrap(), Chair::default());
}
