//! What new users of `smoothpatch nagata` type and feed first.

use crate::bad_input::refuses;
use crate::workplace::Workplace;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn meshes() {
    let place = Workplace::new();
    for (name, text) in [
        ("square.obj", format!("{SQUARE}f 1 2 3 4\n")),
        ("pentagon.obj", format!("{SQUARE}v -1 0.5 0\nf 1 2 3 4 5\n")),
        ("zero.obj", format!("{SQUARE}vn 0 0 0\nf 1//1 2//1 3//1\n")),
        ("missing.obj", format!("{SQUARE}f 1 2 9\n")),
        ("normal.obj", format!("{SQUARE}f 1//1 2//1 3//1\n")),
        ("twice.obj", format!("{SQUARE}f 1 2 2\n")),
        ("infinite.obj", "v 0 0 inf\nf 1 1 1\n".to_owned()),
        ("points.obj", SQUARE.to_owned()),
        ("empty.obj", String::new()),
        ("noise.obj", "\u{7f}ELF\n".to_owned()),
    ] {
        place.write(name, text);
    }
    for (arguments, fragments) in [
        (&["none.obj"][..], &["none.obj: cannot read"][..]),
        (&["pentagon.obj"], &["pentagon.obj: line 6: face 1 has 5 corners", "--triangulate"]),
        (&["zero.obj"], &["zero.obj: normal 0 is [0, 0, 0]"]),
        (&["missing.obj"], &["missing.obj: line 5: face 1 uses vertex 9", "only 4"]),
        (&["normal.obj"], &["normal.obj: line 5: face 1 uses normal 1", "only 0"]),
        (&["twice.obj"], &["twice.obj: line 5: face 1 uses vertex 2 more than once"]),
        (&["infinite.obj"], &["infinite.obj: line 1: vertex 1", "not finite"]),
        (&["points.obj"], &["points.obj: there are no faces"]),
        (&["empty.obj"], &["empty.obj: there are no faces"]),
        (&["noise.obj"], &["noise.obj: line 1: the statement"]),
        (
            &["square.obj", "--normals", "file"],
            &["square.obj: ", "no normals", "--normals estimate"],
        ),
        (&["square.obj", "--continuity", "g1"], &["face 0 is a quadrilateral", "--triangulate"]),
    ] {
        refuses(&place, &[&["nagata"], arguments, &["-o", "new.vtu"]].concat(), fragments);
    }
}

#[test]
fn options() {
    let place = Workplace::new();
    place.write("square.obj", format!("{SQUARE}f 1 2 3 4\n"));
    place.write("scene.ron", r#"(version: 1, name: "a", surface: Shape("spere"), faces: 20)"#);
    for (arguments, fragments) in [
        (&["--continuity", "c1", "-o", "a.vtu"][..], &["c0, g1"][..]),
        (&["--tangent-planes", "published", "-o", "a.vtu"], &["--continuity g1"]),
        (&["--normals", "estimated", "-o", "a.vtu"], &["`estimate`", ".ron"]),
        (&["--normals", "none.ron", "-o", "a.vtu"], &["none.ron: cannot read"]),
        (&["--normals", "scene.ron", "-o", "a.vtu"], &["`spere`", "known shapes"]),
        (&["--reference", "scene.ron", "-o", "a.vtu"], &["`spere`", "known shapes"]),
        (&["--crease-angle", "200", "-o", "a.vtu"], &["from 0 to 180"]),
        (&["--crease-angle", "-1", "-o", "a.vtu"], &["from 0 to 180"]),
        (&["--divisions", "0", "-o", "a.vtu"], &["1 to 256"]),
        (&["-o", "a.iges"], &["must end with .vtu"]),
        (&["-o", "none/a.vtu"], &["there is no directory none"]),
        (&["-o", "./square.obj"], &["./square.obj is read"]),
        (&["-o", "a.vtu", "-o", "./a.vtu"], &["would be written twice"]),
        (&["-o", "a.vtu", "--report", "a.txt"], &["must end with .json"]),
        (&[], &["--output"]),
    ] {
        refuses(&place, &[&["nagata", "square.obj"], arguments].concat(), fragments);
    }
}

#[test]
fn odd_meshes_give_a_surface_and_a_word_about_it() {
    let place = Workplace::new();
    // three faces at an edge, a vertex without faces, a face of no area
    let odd = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 9 9 9\nv 2 0 0\n\
               f 1 2 3\nf 2 1 4\nf 1 2 5\nf 1 2 7\n";
    place.write("odd.obj", odd);
    for options in ["", "--continuity g1", "--continuity g1 --tangent-planes published"] {
        let run = place.run(&format!("nagata odd.obj {options} -o a.vtu -o a.obj --divisions 2"));
        assert_eq!(run.code, 0, "{options}: {}", run.stderr);
        for file in ["a.vtu", "a.obj"] {
            let text = String::from_utf8_lossy(&place.read(file)).to_lowercase();
            assert!(!text.contains("nan\n") && !text.contains(" nan"), "{options}: NaN in {file}");
        }
    }
    // a corner without a normal
    place.write("apex.obj", format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3\nf 1//1 3 4//1\n"));
    let run = place.run("nagata apex.obj -o a.vtu");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("corners without normal"), "{}", run.stdout);
    assert!(run.stderr.contains("2 corners have no normal"), "{}", run.stderr);
}
