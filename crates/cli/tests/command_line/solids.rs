//! `smoothpatch apatch` on solids.

use smoothpatch::solid_surface::read_weights;

use crate::bad_input::refuses;
use crate::nagata::{has_rows, is_closed};
use crate::workplace::Workplace;

/// A place with the solids of the fixtures.
fn place() -> Workplace {
    let place = Workplace::new();
    for name in ["frame.off", "u_prism.off"] {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/solids/");
        place.write(name, std::fs::read(format!("{path}{name}")).unwrap());
    }
    place
}

#[test]
fn a_frame_becomes_a_smooth_ring() {
    let place = place();
    let run = place.succeed(
        "apatch frame.off --scheme c1-cubic --density 5 -o f.vtu --report f.json --weights w.json",
    );
    let rows = ["edges by kind 36 convex, 4 concave, 8 straight", "findings", "bad rays"];
    has_rows(&run, &rows);
    let report = place.json("f.json");
    assert_eq!(report["euler_characteristic"], 0);
    assert_eq!(report["construction"]["bad_rays"][0], 0);
    assert!(report["joints"]["gradient_jump"].as_f64().unwrap() <= 1e-13, "{report}");
    let volume = report["surface_volume"].as_f64().unwrap();
    assert!(volume > 5.0 && volume < 8.0, "the frame has volume 8: {volume}");
    let surface = read_weights(&mut place.read("w.json").as_slice()).unwrap();
    assert_eq!(surface.hull().base_count(), 16);
}

#[test]
fn a_file_of_tetrahedra_is_the_same_surface() {
    let place = place();
    for (solid, scheme) in [("u_prism.off", "c1-cubic"), ("cube", "c2-quintic")] {
        place.succeed(&format!(
            "apatch {solid} --scheme {scheme} --density 4 -o a.vtu --weights w.json --report a.json"
        ));
        let run = place.succeed("apatch w.json --density 4 -o b.vtu --report b.json");
        has_rows(&run, &["bad rays", "volume"]);
        assert!(place.read("a.vtu") == place.read("b.vtu"), "{solid}: the same file");
        let [made, loaded] = ["a.json", "b.json"].map(|name| place.json(name));
        assert_eq!(made["joints"], loaded["joints"], "{solid}");
        assert_eq!(made["construction"]["bad_rays"], loaded["construction"]["bad_rays"]);
    }
    place.write("cut.json", &place.read("w.json")[..2000]);
    place.write("other.json", r#"{"format": "w", "version": 3}"#);
    for (options, message) in [
        ("apatch cut.json -o c.obj", "cut.json: EOF while parsing"),
        ("apatch other.json -o c.obj", "other.json: missing field `degree`"),
        ("apatch none.json -o c.obj", "none.json: cannot read"),
        ("apatch w.json --scheme c1-cubic -o c.obj", "--scheme: the surface in w.json is made"),
        ("apatch w.json --cut 0.5 -o c.obj", "--cut and --weights: the surface in w.json"),
        ("apatch w.json --tension 1 -o c.obj", "--tension: the surface in w.json"),
        ("apatch w.json -o c.obj --report w.json", "w.json is read; it would be overwritten"),
    ] {
        let arguments: Vec<&str> = options.split_whitespace().collect();
        refuses(&place, &arguments, &[message]);
    }
}

#[test]
fn a_named_solid_with_second_order_smoothness() {
    let place = Workplace::new();
    let run = place.succeed("apatch cube --scheme c2-quintic --density 4 -o c.obj --report c.json");
    has_rows(&run, &["C2 residual"]);
    assert!(is_closed(&place, "c.obj"), "a closed surface");
    let report = place.json("c.json");
    assert!(report["joints"]["curvature_jump"].as_f64().unwrap() <= 1e-9, "{report}");
    let cut = |options: &str| {
        place.succeed(&format!(
            "apatch octahedron --scheme c1-cubic {options} -o o.vtu --report o.json"
        ));
        place.json("o.json")["surface_volume"].as_f64().unwrap()
    };
    let volumes = ["--cut 0.2", "--cut 0.5", "--cut 0.8"].map(cut);
    assert!(volumes.is_sorted(), "{volumes:?}");
    assert!(cut("--tension 2") < cut("--tension 0"), "pulled inwards");
}

#[test]
fn what_is_refused() {
    let place = place();
    place.write("open.off", "OFF\n4 3 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
    for (options, message) in [
        ("apatch open.off --scheme c1-cubic -o a.obj", "edge 0-2 of face 0 has no face"),
        ("apatch ball --scheme c1-cubic -o a.obj", "ball is neither an .off or .obj file"),
        (
            "apatch frame.off --scheme c1-cubic --normals file -o a.obj",
            "--normals is not for solids",
        ),
        ("apatch frame.off --scheme c1-cubic --cut 1.5 -o a.obj", "give a number between 0 and 1"),
        ("apatch frame.off --scheme c2-quintic --tension 1 -o a.obj", "--tension"),
        (
            "apatch frame.off --scheme c1-cubic -o a.step",
            "files of this kind hold polynomial patches",
        ),
        (
            "apatch frame.off --scheme c1-cubic -o a.xyz",
            "-o a.xyz: the name must end with .vtu, .obj, .ply, .stl or .glb",
        ),
        ("apatch cube -o a.obj", "cube is a solid; add --scheme c1-cubic or c2-quintic"),
        ("apatch frame.off -o a.obj", "frame.off is a solid; add --scheme"),
        ("apatch frame.off --cut 0.5 -o a.obj", "--cut and --weights are for solids"),
    ] {
        let arguments: Vec<&str> = options.split_whitespace().collect();
        refuses(&place, &arguments, &[message]);
    }
}
