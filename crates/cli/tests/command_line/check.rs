//! `smoothpatch check` on good and on damaged files.

use serde_json::Value;
use smoothpatch::basemesh::{FaceMap, Topology, VertexId};
use smoothpatch::bezier_core::{MultiIndex, SepticTriangle};
use smoothpatch::io::{Encoding, VtuOptions, VtuSurface, read_vtu_file, write_vtu};

use crate::workplace::Workplace;

const GOOD: &str = "--max-deviation 2e-4 --max-rms-deviation 1e-4 --max-normal-error 1 \
                    --max-g1-angle 1e-9 --max-gap 0 --max-folds 0 --euler 2 --components 1 --closed";

#[test]
fn a_good_file_passes_and_its_figures_are_those_of_the_fit() {
    let place = Workplace::new();
    place.succeed("fit --shape sphere --faces 40 -o ball.vtu --report ball.json");
    place.succeed("check ball.vtu");
    let table = place.succeed(&format!("check ball.vtu --shape sphere {GOOD}"));
    assert_eq!(table.matches("\n  ok ").count(), 9, "{table}");
    assert!(table.contains("finest grid           32 divisions"), "{table}");

    let text = place.succeed(&format!("check ball.vtu --shape sphere --json {GOOD}"));
    let found: Value = serde_json::from_str(&text).unwrap();
    let report = place.json("ball.json");
    assert_eq!(found["deviation"], report["deviation"]);
    for (name, value) in report["continuity"].as_object().unwrap() {
        assert_eq!(&found[name], value, "{name}");
    }
    assert_eq!(found["vertices"], 22);
    assert_eq!(found["bounds"].as_array().unwrap().len(), 9);
    assert_eq!([&found["passed"], &found["manifold"]], [true, true]);
}

#[test]
fn a_scene_or_a_formula_can_be_the_surface() {
    let place = Workplace::with_ball();
    place.write("ball.ron", r#"(version: 1, name: "ball", surface: Shape("sphere"), faces: 10)"#);
    place.succeed("check ball.vtu --scene ball.ron --max-deviation 2e-4");
    place.succeed("check ball.vtu --formula x^2+y^2+z^2 --level 1 --max-deviation 2e-4");
    let run = place.run("check ball.vtu --formula x^2+y^2+z^2 --level 1.1 --max-deviation 2e-4");
    assert_eq!(run.code, 1, "another radius");
}

/// The check must fail, and name exactly these options.
fn fails(place: &Workplace, line: &str, options: &[&str]) {
    let run = place.run(line);
    assert_eq!(run.code, 1, "{line}\n{}{}", run.stdout, run.stderr);
    let complaints: Vec<&str> = run.stderr.lines().collect();
    assert_eq!(complaints.len(), options.len(), "{line}: {complaints:?}");
    for (complaint, option) in complaints.iter().zip(options) {
        assert!(complaint.contains(option), "{line}: {complaint} is not about {option}");
    }
    let json = place.run(&format!("{line} --json"));
    let found: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(found["passed"], false, "{line}");
}

#[test]
fn every_bound_can_be_exceeded() {
    let place = Workplace::with_ball();
    for option in [
        "--max-deviation 0",
        "--max-rms-deviation 0",
        "--max-normal-error 0",
        "--max-g1-angle 0",
        "--euler -2",
        "--components 2",
    ] {
        fails(&place, &format!("check ball.vtu --shape sphere {option}"), &[option]);
    }
    let both = "check ball.vtu --shape sphere --max-deviation 0 --max-folds 0 --euler 0";
    fails(&place, both, &["--max-deviation", "--euler"]);
}

/// Writes `damaged.vtu`: the ball after `change`.
fn damage(place: &Workplace, change: impl Fn(&mut Vec<[usize; 3]>, &mut Vec<SepticTriangle>)) {
    let VtuSurface { topology, nets, .. } = read_vtu_file(place.path("ball.vtu")).unwrap();
    let corners = |face| topology.corners(face).map(VertexId::index);
    let mut faces: Vec<_> = topology.faces().map(corners).collect();
    let mut nets = nets.into_vec();
    change(&mut faces, &mut nets);
    let topology = Topology::from_faces(topology.vertex_count(), &faces).unwrap();
    let mut bytes = Vec::new();
    let options = VtuOptions { encoding: Encoding::Ascii, ..VtuOptions::default() };
    write_vtu(&mut bytes, &topology, &FaceMap::from_vec(nets), &options).unwrap();
    place.write("damaged.vtu", bytes);
}

#[test]
fn a_folded_patch_is_found_with_and_without_the_surface() {
    let place = Workplace::with_ball();
    damage(&place, |_, nets| {
        // far along the ball, so that the patch overtakes itself
        let net = nets[7].net_mut();
        net[MultiIndex::new(3, 2, 2).rank()] += 40.0 * (net[35] - net[0]);
    });
    place.succeed("check damaged.vtu --closed --euler 2 --max-gap 0");
    fails(&place, "check damaged.vtu --max-folds 0", &["--max-folds"]);
    fails(&place, "check damaged.vtu --shape sphere --max-folds 0", &["--max-folds"]);
}

#[test]
fn a_kink_is_found() {
    let place = Workplace::with_ball();
    damage(&place, |_, nets| {
        let next_to_an_edge = MultiIndex::new(1, 3, 3).rank();
        nets[3].net_mut()[next_to_an_edge] *= 1.001;
    });
    place.succeed("check damaged.vtu --max-folds 0");
    fails(&place, "check damaged.vtu --max-g1-angle 1e-6", &["--max-g1-angle"]);
}

#[test]
fn a_hole_is_found() {
    let place = Workplace::with_ball();
    damage(&place, |faces, nets| {
        faces.remove(5);
        nets.remove(5);
    });
    assert!(place.succeed("check damaged.vtu").contains("open edges            3"));
    fails(&place, "check damaged.vtu --closed --euler 2", &["--euler", "--closed"]);
}

/// The text of an array in a file with numbers as text, and the file with another text there.
fn replace_array(text: &str, name: &str, change: impl Fn(&str) -> String) -> String {
    let head = text.find(&format!("Name=\"{name}\"")).unwrap();
    let start = head + text[head..].find('>').unwrap() + 1;
    let end = start + text[start..].find('<').unwrap();
    format!("{}{}{}", &text[..start], change(&text[start..end]), &text[end..])
}

#[test]
fn patches_that_do_not_form_a_manifold_fail_without_any_bound() {
    let place = Workplace::with_ball();
    damage(&place, |_, _| {});
    let text = String::from_utf8(place.read("damaged.vtu")).unwrap();

    // the first patch once more
    let twice = text.replace("NumberOfCells=\"40\"", "NumberOfCells=\"41\"");
    let twice = replace_array(&twice, "connectivity", |numbers| {
        let first: Vec<&str> = numbers.split_whitespace().take(36).collect();
        format!("{numbers} {}", first.join(" "))
    });
    let twice = replace_array(&twice, "offsets", |numbers| format!("{numbers} {}", 41 * 36));
    let twice = replace_array(&twice, "types", |numbers| format!("{numbers} 76"));
    place.write("damaged.vtu", twice);
    fails(&place, "check damaged.vtu", &["not a manifold"]);

    // a point on an edge of the first patch is replaced by another one: a crack
    let crack = replace_array(&text, "connectivity", |numbers| {
        let mut numbers: Vec<&str> = numbers.split_whitespace().collect();
        numbers[3] = numbers[4];
        numbers.join(" ")
    });
    place.write("damaged.vtu", crack);
    fails(&place, "check damaged.vtu", &["disagree"]);
}
