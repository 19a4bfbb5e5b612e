//! Scene files: what is read, what is refused, and where the message points.

#![allow(clippy::float_cmp, reason = "files keep every bit")]
#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use common::Random;
use io::{Bounds, Method, Region, Scene, SceneSurface};
use proptest::prelude::*;

const FULL: &str = r#"#![enable(implicit_some)]
// comments are welcome
(
    version: 1,
    name: "ball",
    surface: Formula(
        text: "x^2 + y^2 + z^2 - r^2",
        constants: {"r": 1.5},
        level: 0.25,
    ),
    region: (min: (-2, -2, -2), max: (2, 2, 2.5)),
    faces: 320,
    base_mesh: "meshes/ball.obj",
    bounds: {
        Published: (euler: 2, g1_angle_deg: 1e-9, sqp_iterations: (2, 7.5)),
        Refined: (folds: 0, fallbacks: 3),
    },
)
"#;

fn full() -> Scene {
    Scene {
        version: 1,
        name: "ball".into(),
        surface: SceneSurface::Formula {
            text: "x^2 + y^2 + z^2 - r^2".into(),
            constants: BTreeMap::from([("r".into(), 1.5)]),
            level: 0.25,
        },
        region: Some(Region { min: [-2.0; 3], max: [2.0, 2.0, 2.5] }),
        faces: 320,
        base_mesh: Some(PathBuf::from("meshes/ball.obj")),
        bounds: BTreeMap::from([
            (
                Method::Published,
                Bounds {
                    euler: Some(2),
                    g1_angle_deg: Some(1e-9),
                    sqp_iterations: Some((2.0, 7.5)),
                    ..Bounds::default()
                },
            ),
            (Method::Refined, Bounds { folds: Some(0), fallbacks: Some(3), ..Bounds::default() }),
        ]),
    }
}

fn refused(text: &str) -> String {
    Scene::parse(text).unwrap_err().to_string()
}

/// The full scene with one replacement.
fn refused_with(old: &str, new: &str) -> String {
    assert!(FULL.contains(old), "{old}");
    refused(&FULL.replacen(old, new, 1))
}

#[test]
fn everything_is_read() {
    assert_eq!(Scene::parse(FULL).unwrap(), full());
    let corners = full().region.unwrap().corners();
    assert_eq!(corners[1].z, 2.5);
}

#[test]
fn most_is_optional() {
    let scene =
        Scene::parse("(version: 1, name: \"t\", surface: Shape(\"torus\"), faces: 4)").unwrap();
    assert_eq!(scene.surface, SceneSurface::Shape("torus".into()));
    assert_eq!((scene.region, scene.base_mesh, scene.bounds), (None, None, BTreeMap::new()));
    let formula = "Scene(version: 1, name: \"t\", surface: Formula(text: \"x\"), faces: 4)";
    match Scene::parse(formula).unwrap().surface {
        SceneSurface::Formula { constants, level, .. } => {
            assert_eq!((constants.len(), level), (0, 0.0));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn misspelt_keys_are_located() {
    let check = |old: &str, new: &str, position: &str, rest: &[&str]| {
        let message = refused_with(old, new);
        assert!(message.starts_with(&format!("{position}: unexpected")), "{message}");
        for part in rest {
            assert!(message.contains(part), "{part} in {message}");
        }
    };
    check("faces", "fcaes", "12:5", &["`fcaes` in `Scene`", "`surface`", "`faces`"]);
    check("constants", "constant", "8:9", &["`constant` in `Formula`", "`text`", "`level`"]);
    check("max: (2", "mx: (2", "11:33", &["`mx` in `Region`", "`min` or `max`"]);
    check("g1_angle_deg", "g1_angle", "15:31", &["`g1_angle` in `Bounds`", "`g1_angle_deg`"]);
    check("Refined", "Refind", "16:9", &["`Refind` in enum `Method`", "`Published` or `Refined`"]);
    check("Formula", "Formla", "6:14", &["`Formla`", "`Shape` or `Formula`"]);
}

#[test]
fn other_mistakes_are_located() {
    assert_eq!(refused_with("\"ball\",", "\"ball\""), "6:5: expected comma");
    let message = refused_with("    faces: 320,\n", "");
    assert!(message.contains("the field `faces` of `Scene` is missing"), "{message}");
    assert!(refused_with("euler: 2", "euler: 2.5").starts_with("15:"));
    assert!(refused_with("(2, 7.5)", "(2, 7.5, 8)").starts_with("15:"));
    assert!(refused_with("320", "-3").starts_with("12:"));
    assert!(refused("").starts_with("1:1: "));
    assert!(refused(&FULL[..FULL.len() / 2]).contains(": "));
}

#[test]
fn other_versions_are_refused_before_their_fields() {
    let expected = "version 2 is not supported; supported is version 1";
    assert_eq!(refused_with("version: 1", "version: 2"), expected);
    assert_eq!(refused("(version: 2, patches: [Septic((1, 2)), {\"a\": Some(())}])"), expected);
    assert_eq!(Scene { version: 2, ..full() }.to_ron().unwrap_err().to_string(), expected);
}

#[test]
fn values_without_sense_are_refused() {
    assert_eq!(refused_with("320", "3"), "faces is 3; a closed mesh has at least 4");
    assert!(refused_with("2, 2, 2.5", "2, -2, 2").starts_with("region runs from -2 to -2 in y;"));
    assert!(refused_with("-2, -2, -2", "-2, -2, NaN").starts_with("region runs from NaN to 2.5"));
    assert!(refused_with("2, 2, 2.5", "inf, 2, 2").starts_with("region runs from -2 to inf in x"));
    assert!(refused_with("0.25", "-inf").starts_with("the constant 'level' is -inf;"));
    assert!(refused_with("1.5", "NaN").starts_with("the constant 'r' is NaN;"));
    let message = refused_with("1e-9", "-1e-9");
    assert!(message.starts_with("the bound g1_angle_deg of Published is -0.000000001;"));
    let message = refused_with("(2, 7.5)", "(8, 7.5)");
    assert!(message.starts_with("the bound sqp_iterations of Published is (8, 7.5);"));
    if cfg!(unix) {
        let message = refused_with("meshes/ball", "/meshes/ball");
        assert!(message.starts_with("base_mesh is the absolute path /meshes/ball.obj;"));
    }
}

#[test]
fn files_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("ball.ron");
    let missing = Scene::read(&path).unwrap_err().to_string();
    assert!(missing.starts_with(&format!("{}: cannot read: ", path.display())), "{missing}");
    std::fs::write(&path, FULL.replace("faces", "fcaes")).unwrap();
    let misspelt = Scene::read(&path).unwrap_err().to_string();
    assert!(misspelt.starts_with(&format!("{}: 12:5: unexpected", path.display())), "{misspelt}");
    std::fs::write(&path, FULL).unwrap();
    let scene = Scene::read(&path).unwrap();
    assert_eq!(scene, full());
    let mesh = scene.base_mesh_beside(&path).unwrap();
    assert_eq!(mesh, directory.path().join("meshes/ball.obj"));
    assert_eq!(scene.base_mesh_beside(Path::new("s.ron")).unwrap(), Path::new("meshes/ball.obj"));
    std::fs::write(&path, b"(version: 1, name: \"\xff\")").unwrap();
    let binary = Scene::read(&path).unwrap_err().to_string();
    assert!(binary.ends_with("is not a text file in UTF-8"), "{binary}");
}

/// Bits of every number of a scene.
fn bits(scene: &Scene) -> Vec<u64> {
    let SceneSurface::Formula { constants, level, .. } = &scene.surface else { return vec![] };
    let region = scene.region.unwrap();
    let bounds = scene.bounds.values().flat_map(|b| [b.max_deviation, b.row_residual]).flatten();
    let numbers = constants.values().copied().chain([*level]);
    numbers.chain(region.min).chain(region.max).chain(bounds).map(f64::to_bits).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_bit_comes_back(seed in any::<u64>(), name in ".*", text in ".*") {
        let mut random = Random(seed);
        let mut bound =
            || Bounds { max_deviation: Some(random.any_finite().abs()), ..Bounds::default() };
        let bounds = BTreeMap::from([(Method::Published, bound()), (Method::Refined, bound())]);
        let constants = (0..3).map(|i| (format!("c{i} {text}"), random.any_finite())).collect();
        let region = Region {
            min: [0; 3].map(|_| -random.any_finite().abs() / 4.0 - f64::MIN_POSITIVE),
            max: [0; 3].map(|_| random.any_finite().abs() / 4.0),
        };
        let scene = Scene {
            name,
            surface: SceneSurface::Formula { text, constants, level: random.any_finite() },
            region: Some(region),
            bounds,
            ..full()
        };
        let back = Scene::parse(&scene.to_ron().unwrap()).unwrap();
        prop_assert_eq!(bits(&back), bits(&scene));
        prop_assert_eq!(back, scene);
    }

    #[test]
    fn damaged_text_never_panics(at in any::<prop::sample::Index>(), with in ".{0,3}") {
        let at = at.index(FULL.len());
        let _ = Scene::parse(&format!("{}{with}{}", &FULL[..at], &FULL[at + 1..]));
        let _ = Scene::parse(&FULL[..at]);
    }
}
