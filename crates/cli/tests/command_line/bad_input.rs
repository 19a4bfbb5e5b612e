//! One clear message, exit code 2, and everything on the disk as it was.

use crate::workplace::{Run, Workplace};

const UNKNOWN_KEY: &str =
    r#"(version: 1, name: "a", surface: Shape("sphere"), faces: 20, colour: 3)"#;
const BASE_MESH: &str =
    r#"(version: 1, name: "a", surface: Shape("sphere"), faces: 6, base_mesh: "manifold.obj")"#;
const THREE_FACES_AT_AN_EDGE: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
const OPEN: &str = "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";
/// A pyramid on both sides of a triangle, with a vertex where the gradient of `PINCHED` vanishes.
const AT_THE_PINCH: &str = "\
v 0 0 0
v 1 0 0
v 0.5 0.4330127018922193 0
v 0.5 -0.21650635094610965 0.375
v 0.5 -0.21650635094610965 -0.375
f 2 3 4
f 2 4 5
f 2 5 3
f 1 4 3
f 1 5 4
f 1 3 5
";
const PINCHED: &str = "x^4 - x^2 + y^2 + z^2";

fn place() -> Workplace {
    let place = Workplace::with_ball();
    place.write("key.ron", UNKNOWN_KEY);
    place.write("based.ron", BASE_MESH);
    place.write("binary.ron", [0xff, 0xfe, 0x00]);
    place.write("manifold.obj", THREE_FACES_AT_AN_EDGE);
    place.write("open.obj", OPEN);
    place.write("pinch.obj", AT_THE_PINCH);
    place.write("old.vtu", "an older result");
    place.write("short.vtu", &place.read("ball.vtu")[..2000]);
    std::fs::create_dir(place.path("directory.vtu")).unwrap();
    place
}

/// Runs the program; the message must contain all fragments.
pub(crate) fn refuses(place: &Workplace, arguments: &[&str], fragments: &[&str]) {
    let before = place.everything();
    let run = place.run_with(arguments);
    let Run { code, stdout, stderr } = &run;
    assert_eq!((*code, stdout.as_str()), (2, ""), "{arguments:?}: {stderr}");
    assert!(stderr.starts_with("error: "), "{arguments:?}: {stderr}");
    assert_eq!(stderr.matches("error:").count(), 1, "{arguments:?}: {stderr}");
    for fragment in fragments {
        assert!(stderr.contains(fragment), "{arguments:?}: {fragment:?} is missing in {stderr}");
    }
    assert!(place.everything() == before, "{arguments:?} changed something");
}

/// `fit` with these arguments and an output that exists already.
fn fit_refuses(arguments: &[&[&str]], fragments: &[&[&str]]) {
    let place = place();
    assert_eq!(arguments.len(), fragments.len(), "one expectation per case");
    for (arguments, fragments) in arguments.iter().zip(fragments) {
        let line = [&["fit"], *arguments, &["-o", "old.vtu", "-o", "new.obj"]].concat();
        refuses(&place, &line, fragments);
    }
}

#[test]
fn scenes_and_meshes() {
    fit_refuses(
        &[
            &["none.ron"],
            &["key.ron"],
            &["binary.ron"],
            &["--shape", "sphere", "--base-mesh", "none.obj"],
            &["--shape", "sphere", "--base-mesh", "manifold.obj"],
            &["--formula", PINCHED, "--base-mesh", "pinch.obj"],
            &["--formula", PINCHED, "--base-mesh", "pinch.obj", "--faces", "8"],
        ],
        &[
            &["none.ron: cannot read"],
            &["key.ron: 1:62: ", "`colour`", "`base_mesh`"],
            &["binary.ron", "UTF-8"],
            &["none.obj: cannot read"],
            &["manifold.obj: line", "shared by 3 faces"],
            &["singular at vertex 0", "gradient vanishes"],
            &["pinch.obj", "has 6 faces", "--faces asks for 8"],
        ],
    );
}

#[test]
fn formulas_and_shapes() {
    fit_refuses(
        &[
            &["--shape", "spere"],
            &["--formula", "x^2 + y^2 +* z"],
            &["--formula", "x^2 + 2y"],
            &["--formula", "x^2 + y^2 + z^2 - r"],
            &["--formula", "x - r", "--constant", "r=1", "--constant", "r=2"],
            &["--formula", "x", "--constant", "r"],
            &["--formula", "x", "--level", "inf"],
            &["--shape", "sphere", "--formula", "x"],
            &["--shape", "sphere", "--level", "1"],
            &["key.ron", "--shape", "sphere"],
            &[],
        ],
        &[
            &["`spere`", "known shapes: plane, sphere,", "deccube"],
            &["\n  x^2 + y^2 +* z\n             ^\n"],
            &["operator is missing", "\n  x^2 + 2y\n         ^\n"],
            &["unknown name `r`"],
            &["`r` is given twice"],
            &["should look like r=1.5"],
            &["--level", "finite"],
            &["--shape", "--formula"],
            &["--formula"],
            &["SCENE.ron", "--shape"],
            &["SCENE.ron", "--shape", "--formula"],
        ],
    );
}

#[test]
fn regions() {
    fit_refuses(
        &[
            &["--formula", "x^2 + y^2 + z^2 + 1"],
            &["--shape", "sphere", "--region", "2,2,2,3,3,3"],
            &["--shape", "sphere", "--region", "0,-2,-2,2,2,2"],
            &["--formula", "x^2 + y^2 - 1"],
            &["--formula", "ln(x) + y^2 + z^2", "--region", "-1,-1,-1,1,1,1"],
            &["--shape", "sphere", "--region", "1,2,3"],
            &["--shape", "sphere", "--region", "2,-2,-2,-2,2,2"],
            &["--shape", "sphere", "--region", "-1,-1,-1,1,1,1", "--base-mesh", "open.obj"],
        ],
        &[
            &["no region is given", "no surface in the region"],
            &["no surface in the region from [2, 2, 2] to [3, 3, 3]"],
            &["leaves the region at", "try --region -"],
            &["no region is given", "leaves the region at", "a guess"],
            &["is NaN", "finite"],
            &["six numbers", "not 3"],
            &["from 2 to -2 in x"],
            &["--region", "--base-mesh"],
        ],
    );
}

#[test]
fn numbers() {
    fit_refuses(
        &[
            &["--shape", "sphere", "--faces", "3"],
            &["--shape", "sphere", "--faces", "-20"],
            &["--shape", "sphere", "--faces", "many"],
            &["--shape", "sphere", "--faces", "201"],
            &["--shape", "torus", "--faces", "4"],
            &["--shape", "sphere", "--divisions", "0"],
            &["--shape", "sphere", "--threads", "0"],
            &["--shape", "sphere", "--method", "best"],
            &["--shape", "sphere", "--colour", "red"],
        ],
        &[
            &["--faces", "at least 4"],
            &["--faces", "-20"],
            &["--faces", "`many`"],
            &["even", "200 or 202"],
            &["4 faces cannot keep", "at least"],
            &["--divisions", "1 to 256"],
            &["--threads"],
            &["refined, published"],
            &["--colour"],
        ],
    );
}

#[test]
fn outputs() {
    let place = place();
    let sphere = ["fit", "--shape", "sphere", "--faces", "20", "-o"];
    for (outputs, fragment) in [
        (&["new.iges"][..], "must end with .vtu, .step or .msh (patches), or with .obj"),
        (&["new"], "must end with"),
        (&["new.vtu", "--report", "new.txt"], "must end with .json"),
        (&["none/new.vtu"], "there is no directory none"),
        (&["new.obj", "-o", "none/new.vtu"], "there is no directory none"),
        (&["new.vtu", "--report", "none/new.json"], "there is no directory none"),
        (&["directory.vtu"], "not a regular file"),
        (&["new.vtu", "-o", "./new.vtu"], "would be written twice"),
        (&["new.vtu", "--base-mesh", "open.obj"], "--faces asks for 20"),
    ] {
        refuses(&place, &[&sphere, outputs].concat(), &[fragment]);
    }
    let overwritten =
        ["fit", "--formula", PINCHED, "--base-mesh", "pinch.obj", "-o", "./pinch.obj"];
    refuses(&place, &overwritten, &["./pinch.obj is read"]);
    refuses(&place, &["fit", "--shape", "sphere"], &["--output"]);
}

#[test]
fn files_to_check() {
    let place = place();
    for (arguments, fragment) in [
        (&["none.vtu"][..], "none.vtu: cannot read"),
        (&["open.obj"], "open.obj: "),
        (&["short.vtu"], "short.vtu: "),
        (&["ball.vtu", "--max-deviation", "1"], "--scene"),
        (&["ball.vtu", "--max-g1-angle=-1"], "cannot be negative"),
        (&["ball.vtu", "--max-folds", "some"], "--max-folds"),
        (&["ball.vtu", "--scene", "key.ron"], "`colour`"),
        (&["ball.vtu", "--shape", "spere"], "known shapes"),
    ] {
        refuses(&place, &[&["check"], arguments].concat(), &[fragment]);
    }
}

#[test]
fn tolerances_that_mean_nothing() {
    fit_refuses(
        &[
            &["--shape", "sphere", "--tolerance", "0"],
            &["--shape", "sphere", "--tolerance", "-1e-5"],
            &["--shape", "sphere", "--tolerance", "nan"],
            &["--shape", "sphere", "--tolerance", "1e-18"],
            &["--shape", "sphere", "--tolerance", "1e-18", "--absolute"],
            &["--shape", "sphere", "--normal-tolerance", "0"],
            &["--shape", "sphere", "--normal-tolerance", "inf"],
            &["--shape", "sphere", "--normal-tolerance", "1e-18"],
        ],
        &[
            &["above zero"],
            &["above zero"],
            &["finite"],
            &["1e-11"],
            &["e-11"],
            &["above zero"],
            &["finite"],
            &["1e-9°"],
        ],
    );
}

#[test]
fn tolerances_with_what_they_exclude() {
    fit_refuses(
        &[
            &["--shape", "sphere", "--tolerance", "1e-5", "--faces", "40"],
            &["--shape", "sphere", "--normal-tolerance", "1", "--faces", "40"],
            &["--shape", "sphere", "--tolerance", "1e-5", "--base-mesh", "open.obj"],
            &["--shape", "sphere", "--normal-tolerance", "1", "--base-mesh", "open.obj"],
            &["based.ron", "--tolerance", "1e-5"],
            &["based.ron", "--normal-tolerance", "1"],
            &["based.ron", "--tolerance", "1e-5", "--region", "-2,-2,-2,2,2,2"],
            &["--shape", "sphere", "--absolute"],
        ],
        &[
            &["--tolerance", "cannot be used with", "--faces"],
            &["--normal-tolerance", "cannot be used with", "--faces"],
            &["--tolerance", "cannot be used with", "--base-mesh"],
            &["--normal-tolerance", "cannot be used with", "--base-mesh"],
            &["based.ron", "base mesh", "but --tolerance asks"],
            &["based.ron", "base mesh", "but --normal-tolerance asks"],
            &["based.ron", "base mesh", "but --tolerance asks"],
            &["--tolerance"],
        ],
    );
}
