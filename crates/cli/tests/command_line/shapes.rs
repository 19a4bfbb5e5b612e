//! `smoothpatch shapes`

use serde_json::Value;
use smoothpatch::implicit::catalogue;

use crate::workplace::Workplace;

#[test]
fn all_shapes_are_listed_with_their_formulas() {
    let place = Workplace::new();
    let text = place.succeed("shapes");
    let json: Value = serde_json::from_str(&place.succeed("shapes --json")).unwrap();
    assert_eq!(json.as_array().unwrap().len(), catalogue().len());
    for (entry, shape) in json.as_array().unwrap().iter().zip(catalogue()) {
        assert_eq!(entry["name"], shape.name);
        assert_eq!(entry["formula"], shape.formula);
        assert_eq!(entry["genus"].as_u64(), shape.genus.map(u64::from));
        assert_eq!(entry["region"][1][2], shape.region.max.z);
        assert!(text.contains(shape.name) && text.contains(shape.formula), "{text}");
    }
}

#[test]
fn a_listed_formula_and_region_can_be_typed() {
    let place = Workplace::new();
    let formula = "(sqrt(x^2 + y^2) - 5)^2 + z^2 - 1";
    assert!(place.succeed("shapes").contains(&format!("{formula}\n  region   -7,-7,-2,7,7,2")));
    let run = place.run_with(&[
        "fit",
        "--formula",
        formula,
        "--region",
        "-7,-7,-2,7,7,2",
        "--faces",
        "200",
        "-o",
        "a.vtu",
    ]);
    assert_eq!(run.code, 0, "{}", run.stderr);
}
