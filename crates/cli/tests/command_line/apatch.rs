//! `smoothpatch apatch`: surfaces, repairs, tensions, and what is refused.

use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::io::{LargeFaces, read_polygons_file};

use crate::bad_input::refuses;
use crate::nagata::{cells, data, has_rows, is_closed, place_with_spot};
use crate::workplace::Workplace;

/// An octahedron in the unit sphere, with its unit normals.
fn octahedron() -> String {
    let axes = ["1 0 0", "0 1 0", "-1 0 0", "0 -1 0", "0 0 1", "0 0 -1"];
    let faces =
        [[1, 2, 5], [2, 3, 5], [3, 4, 5], [4, 1, 5], [2, 1, 6], [3, 2, 6], [4, 3, 6], [1, 4, 6]];
    let points = axes.map(|p| format!("v {p}\nvn {p}\n")).concat();
    points + &faces.map(|[a, b, c]| format!("f {a}//{a} {b}//{b} {c}//{c}\n")).concat()
}

/// Three unit cubes in the shape of an L: tetrahedra at the inner edge overlap.
fn l_block() -> String {
    let plan = [[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [0, 1]];
    let mut text = String::new();
    for z in 0..2 {
        for [x, y] in plan {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    for lid in [[1, 2, 5], [1, 5, 8], [2, 3, 4], [2, 4, 5], [8, 5, 6], [8, 6, 7]] {
        let [a, b, c] = lid;
        text += &format!("f {c} {b} {a}\nf {} {} {}\n", a + 8, b + 8, c + 8);
    }
    for a in 1..9 {
        let b = a % 8 + 1;
        text += &format!("f {a} {b} {}\nf {a} {} {}\n", b + 8, b + 8, a + 8);
    }
    text
}

fn farthest_from_sphere(place: &Workplace, name: &str) -> f64 {
    let mesh = read_polygons_file(place.path(name), LargeFaces::Refuse).unwrap();
    mesh.positions.iter().map(|p| (p.length() - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn spot_is_closed_and_smooth() {
    let place = place_with_spot();
    let table = place.succeed(
        "apatch spot_triangulated.obj -o a.vtu -o a.obj --density 2 --report a.json --threads 2",
    );
    has_rows(
        &table,
        &[
            "spot_triangulated.obj, rational A-patches",
            "normals estimated, of Loop's limit surface",
            "faces 5856",
            "Euler characteristic 2",
            "closed yes",
            "invalid edge tetrahedra 0",
            "bad transversals 0 of ",
            "wrote a.vtu (",
        ],
    );
    let report = place.json("a.json");
    assert_eq!(report["construction"]["invalid_edges"].as_array().unwrap().len(), 0);
    let joints = &report["joints"];
    assert!(joints["value_jump"].as_f64().unwrap() <= 1e-13, "{joints}");
    assert!(joints["gradient_jump"].as_f64().unwrap() <= 1e-12, "{joints}");
    assert!(joints["normal_angle"].as_f64().unwrap() <= 1e-10, "{joints}");
    assert!(is_closed(&place, "a.obj"), "cracks");

    let grid = cells(&place, "a.vtu");
    assert_eq!(report["files"][0]["cells"], grid.cells.len());
    let gap = report["files"][1]["sampling_deviation"].as_f64().unwrap();
    assert!(gap > 1e-6 && gap < 1e-2, "gap {gap}");
    let kinds = data(&grid, "patch_kind");
    for kind in [0.0, 1.0, 3.0, 4.0] {
        assert!(kinds.contains(&kind), "no patch of kind {kind}");
    }
    // every cell is over a face or over an edge
    for (face, edge) in data(&grid, "face").into_iter().zip(data(&grid, "edge")) {
        assert!((face >= 0.0) != (edge >= 0.0), "face {face}, edge {edge}");
    }
    assert!(grid.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-12), "normals");

    let one = "apatch spot_triangulated.obj -o b.vtu --density 2 --threads 1 --quiet";
    assert_eq!(place.succeed(one), "");
    assert!(place.read("a.vtu") == place.read("b.vtu"), "the number of threads changes the file");
}

#[test]
fn gradients_of_a_scene_give_its_quadric() {
    let place = Workplace::new();
    place.write("mesh.obj", octahedron());
    place.write("ball.ron", r#"(version: 1, name: "ball", surface: Shape("sphere"), faces: 8)"#);
    let table =
        place.succeed("apatch mesh.obj --normals ball.ron -o a.vtu -o a.obj --report a.json");
    has_rows(&table, &["compared with ball", "normals ball.ron", "repairs none"]);
    let deviation = &place.json("a.json")["deviation"];
    assert!(deviation["max"].as_f64().unwrap() <= 1e-11, "{deviation}");
    assert!(farthest_from_sphere(&place, "a.obj") <= 1e-11, "no sphere");
    assert!(data(&cells(&place, "a.vtu"), "deviation").iter().all(|&d| d <= 1e-11), "cells");

    // unit normals are half the gradients of this quadric, which is the same to the surface
    has_rows(&place.succeed("apatch mesh.obj -o b.obj"), &["normals file"]);
    assert!(farthest_from_sphere(&place, "b.obj") <= 1e-11, "no sphere");
    place.succeed("apatch mesh.obj --rule published -o c.obj");
    assert!(farthest_from_sphere(&place, "c.obj") > 1e-2, "the published rule is not exact");
}

#[test]
fn repairs_are_made_as_far_as_allowed_and_the_rest_is_named() {
    let place = Workplace::new();
    place.write("l.obj", l_block());
    let all = place.succeed("apatch l.obj -o a.obj --density 4 --report a.json");
    has_rows(&all, &["invalid edge tetrahedra 0", "1 step of Loop's scheme", "faces 112"]);
    assert_eq!(place.json("a.json")["construction"]["loop_steps"], 1);
    assert!(is_closed(&place, "a.obj"), "cracks");

    let run = place.run("apatch l.obj --repair none -o b.obj --density 4 --report b.json");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(is_closed(&place, "b.obj"), "cracks");
    let report = place.json("b.json");
    let invalid = report["construction"]["invalid_edges"].as_array().unwrap();
    assert!(!invalid.is_empty(), "the tetrahedra at the inner edge overlap");
    has_rows(&run.stdout, &[&format!("invalid edge tetrahedra {}", invalid.len()), "faces 28"]);
    let [a, b] = [0, 1].map(|end| invalid[0]["vertices"][end].as_u64().unwrap());
    let warning = format!("warning: the surface folds back at {} edges ({a}-{b}", invalid.len());
    assert!(run.stderr.starts_with(&warning), "{}", run.stderr);
    assert_eq!(place.succeed("apatch l.obj --repair none -o b.obj --quiet"), "");

    let run = place.run("apatch l.obj --repair keep-mesh -o c.obj --report c.json");
    let kept = place.json("c.json");
    assert_eq!(kept["construction"]["loop_steps"], 0);
    let left = kept["construction"]["invalid_edges"].as_array().unwrap().len();
    assert!(left < invalid.len(), "{left}: {}", run.stderr);
}

#[test]
fn tensions_of_all_faces_and_of_single_ones() {
    let place = Workplace::new();
    place.write("mesh.obj", octahedron());
    place.write("one.json", r#"{"faces": {"0": 5.0}}"#);
    place.write("one.ron", "(tension: 0.0, faces: {0: 5.0})");
    let heights = |options: &str| {
        place.succeed(&format!("apatch mesh.obj {options} -o a.vtu --density 4"));
        let grid = cells(&place, "a.vtu");
        let mut lowest = [f64::INFINITY; 8];
        for (cell, face) in grid.cells.iter().zip(data(&grid, "face")) {
            let points = cell.points().iter().map(|&p| grid.points[p].length());
            // middle of the face patches
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 7")]
            if face >= 0.0 {
                let lowest = &mut lowest[face as usize];
                *lowest = points.fold(*lowest, f64::min);
            }
        }
        lowest
    };
    let sphere = heights("");
    let tight = heights("--tension 5");
    let out = heights("--tension -0.9");
    assert!(sphere.iter().all(|r| (r - 1.0).abs() < 1e-11), "{sphere:?}");
    assert!(tight.iter().all(|&r| r < 0.95), "{tight:?}");
    assert!(out.iter().all(|&r| r > 1.0 - 1e-11), "{out:?}");
    for file in ["one.json", "one.ron"] {
        let one = heights(&format!("--tension {file}"));
        assert!((one[0] - tight[0]).abs() < 1e-12, "{file}: {one:?} {tight:?}");
        // a face that shares no vertex with face 0
        assert!((one[6] - 1.0).abs() < 1e-11, "{file}: {one:?}");
    }
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn bad_meshes() {
    let place = Workplace::new();
    for (name, text) in [
        ("square.obj", format!("{SQUARE}f 1 2 3 4\n")),
        ("two.obj", format!("{SQUARE}f 1 2 3\nf 1 3 4\n")),
        ("zero.obj", format!("{SQUARE}vn 0 0 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n")),
        ("some.obj", format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1\nf 1//1 3//1 4\n")),
        ("crease.obj", format!("{SQUARE}vn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//1\nf 1//1 3//2 4//2\n")),
        ("turned.obj", format!("{SQUARE}f 1 2 3\nf 1 4 3\n")),
        ("three.obj", format!("{SQUARE}v 0 0 1\nf 1 2 3\nf 3 4 1\nf 1 3 5\n")),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".to_owned()),
        ("loose.obj", format!("{SQUARE}v 5 5 5\nf 1 2 3\nf 1 3 4\n")),
        ("noise.obj", "\u{7f}ELF\n".to_owned()),
    ] {
        place.write(name, text);
    }
    for (arguments, fragments) in [
        (&["none.obj"][..], &["none.obj: cannot read"][..]),
        (&["square.obj"], &["square.obj: face 0 is a quadrilateral", "--triangulate"]),
        (&["two.obj", "--normals", "file"], &["two.obj: ", "no normals", "--normals estimate"]),
        (&["zero.obj"], &["zero.obj: the normal at vertex 0 is [0, 0, 0]"]),
        (&["some.obj"], &["some.obj: vertex 3 has no normal", "--normals estimate"]),
        (&["crease.obj"], &["crease.obj: vertex 2 has several normals", "--normals estimate"]),
        (&["turned.obj"], &["turned.obj: faces 0 and 1 disagree"]),
        (&["three.obj"], &["three.obj: edge 0-2 is shared by 3 faces"]),
        (&["flat.obj"], &["flat.obj: face 0 has no area"]),
        (&["loose.obj"], &["loose.obj: vertex 4 belongs to no face"]),
        (&["noise.obj"], &["noise.obj: line 1: the statement"]),
    ] {
        refuses(&place, &[&["apatch"], arguments, &["-o", "new.vtu"]].concat(), fragments);
    }
}

#[test]
fn bad_options() {
    let place = Workplace::new();
    place.write("mesh.obj", octahedron());
    place.write("low.json", r#"{"faces": {"3": -2.0}}"#);
    place.write("missing.json", r#"{"faces": {"8": 1.0}}"#);
    place.write("key.json", r#"{"face": {"3": 1.0}}"#);
    place.write("word.ron", "(tension: high)");
    place.write("scene.ron", r#"(version: 1, name: "a", surface: Shape("spere"), faces: 20)"#);
    for (arguments, fragments) in [
        (&["--scheme", "c7", "-o", "a.vtu"][..], &["rational"][..]),
        (&["--rule", "best", "-o", "a.vtu"], &["clamped, published"]),
        (&["--repair", "some", "-o", "a.vtu"], &["all, keep-mesh, none"]),
        (&["--tension", "-2", "-o", "a.vtu"], &["at least -1"]),
        (&["--tension", "tight", "-o", "a.vtu"], &["a number from -1 on", ".json"]),
        (&["--tension", "none.json", "-o", "a.vtu"], &["none.json: cannot read"]),
        (
            &["--tension", "low.json", "-o", "a.vtu"],
            &["low.json: ", "tension is -2", "at least -1"],
        ),
        (&["--tension", "missing.json", "-o", "a.vtu"], &["missing.json: ", "face 8", "only 8"]),
        (&["--tension", "key.json", "-o", "a.vtu"], &["key.json: unknown field `face`", "line 1"]),
        (&["--tension", "word.ron", "-o", "a.vtu"], &["word.ron: 1:"]),
        (&["--normals", "estimated", "-o", "a.vtu"], &["`estimate`", ".ron"]),
        (&["--normals", "scene.ron", "-o", "a.vtu"], &["`spere`", "known shapes"]),
        (&["--density", "0", "-o", "a.vtu"], &["1 to 256"]),
        (&["-o", "a.off"], &["must end with .vtu"]),
        (&["-o", "a.vtu", "-o", "a.step"], &["a.step: ", "A-patches are not", ".glb"]),
        (&["-o", "a.msh"], &["a.msh: ", "A-patches are not", ".glb"]),
        (&["-o", "none/a.vtu"], &["there is no directory none"]),
        (&["-o", "./mesh.obj"], &["./mesh.obj is read"]),
        (&["--tension", "low.json", "-o", "a.vtu", "--report", "low.json"], &["low.json is read"]),
        (&["-o", "a.vtu", "--report", "a.txt"], &["must end with .json"]),
        (&[], &["--output"]),
    ] {
        refuses(&place, &[&["apatch", "mesh.obj"], arguments].concat(), fragments);
    }
}

#[test]
fn open_meshes_and_cut_quadrilaterals() {
    let place = Workplace::new();
    place.write("bent.obj", "v 0 0 0\nv 1 0 0.2\nv 1 1 0\nv 0 1 0.2\nf 1 2 3 4\n");
    let table = place.succeed("apatch bent.obj --triangulate -o a.obj --density 3");
    has_rows(&table, &["faces 2", "closed no", "Euler characteristic 1"]);
    let mesh = read_polygons_file(place.path("a.obj"), LargeFaces::Refuse).unwrap();
    assert!(mesh.positions.contains(&DVec3::new(1.0, 0.0, 0.2)), "vertices are kept");
}
