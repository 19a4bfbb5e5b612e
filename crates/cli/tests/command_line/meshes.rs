//! `smoothpatch fit` on meshes.

use crate::bad_input::refuses;
use crate::nagata::has_rows;
use crate::workplace::Workplace;

/// A place with a mesh of the fixtures.
fn place(name: &str) -> Workplace {
    let place = Workplace::new();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/meshes/");
    place.write(name, std::fs::read(format!("{path}{name}")).unwrap());
    place
}

/// A cube of quadrilaterals.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn a_sphere_from_stl_to_step() {
    let place = place("sphere_1280.stl");
    let run = place.succeed("fit sphere_1280.stl --faces 60 -o s.step -o s.vtu --report s.json");
    has_rows(&run, &["mesh 642 vertices, 1280 triangles", "jets 642 of degree 4", "faces 60"]);
    has_rows(&run, &["input vertices", "input triangles"]);
    let step = String::from_utf8(place.read("s.step")).unwrap();
    assert_eq!(step.matches("MANIFOLD_SOLID_BREP").count(), 1, "one solid");
    let report = place.json("s.json");
    let vertices = &report["mesh"]["distances"]["vertices"];
    assert_eq!((&vertices["points"], &report["faces_asked"]), (&642.into(), &60.into()));
    assert!(vertices["max"].as_f64().unwrap() < 2e-5, "{report}");
    place.succeed(
        "check s.vtu --shape sphere --closed --euler 2 --max-folds 0 --max-g1-angle 1e-9 \
         --max-deviation 2e-5",
    );
}

#[test]
fn kept_vertices() {
    let place = place("torus_20x10.obj");
    let run = place.run("fit torus_20x10.obj --keep-vertices -o t.vtu --report t.json");
    // ten sections of the tube are few
    assert!(run.code == 0 && run.stderr.starts_with("warning: normals"), "{}", run.stderr);
    has_rows(&run.stdout, &["faces 400", "input vertices 0.00e0 of the diagonal"]);
    assert_eq!(place.json("t.json")["mesh"]["distances"]["vertices"]["max"], 0.0);
    place.succeed("check t.vtu --closed --euler 0 --max-folds 0 --max-g1-angle 1e-9 --max-gap 0");
}

#[test]
fn what_was_put_in_order_is_said() {
    let place = place("torus_48x24.ply");
    let run = place.run("fit torus_48x24.ply --faces 200 -o t.vtu --jet-degree 3");
    assert_eq!(run.code, 0, "{}", run.stderr);
    has_rows(&run.stdout, &["put in order 1152 polygons cut", "jets 1152 of degree 3"]);
}

#[test]
fn sharp_edges_and_open_ones_stay() {
    let place = place("sphere_1280.stl");
    place.write("cube.obj", CUBE);
    place.write("open.obj", CUBE.replace("f 4 3 2 1\n", ""));
    let run = place.run("fit cube.obj --keep-vertices -o c.vtu -o c.step --report c.json");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    has_rows(
        &run.stdout,
        &["not smooth edges: 12 creases", "C0 edges 12, up to 9.00e1°", "closed yes"],
    );
    let rim = &place.json("c.json")["mesh"]["rim"];
    assert_eq!(rim["creases"].as_array().map(Vec::len), Some(12), "{rim}");
    place.succeed(
        "check c.vtu --closed --euler 2 --crease-angle 45 --max-g1-angle 1e-9 --max-gap 0",
    );
    place.succeed("check c.vtu --mesh cube.obj --max-deviation 1e-12");
    let run = place.run("check c.vtu --mesh open.obj --max-deviation 1e-12");
    assert_eq!(run.code, 1, "the lid is missing: {}", run.stdout);

    let run = place.run("fit open.obj --keep-vertices -o o.vtu -o o.step");
    assert_eq!(run.code, 0, "{}", run.stderr);
    has_rows(&run.stdout, &["not smooth edges: 8 creases, 4 open", "closed no"]);
}

#[test]
fn what_is_refused() {
    let place = place("sphere_1280.stl");
    place.write("cube.obj", CUBE);
    place.write("open.obj", CUBE.replace("f 4 3 2 1\n", ""));
    place.write("three.obj", format!("{CUBE}v 2 2 2\nf 1 2 9\n"));
    place.write("points.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n");
    for (options, message) in [
        ("fit sphere_1280.stl", "how many patches? --faces N makes about N"),
        ("fit cube.obj --faces 20", "12 edges are sharper than 80° (the largest angle is 90.0°)"),
        ("fit cube.obj --faces 20", "use --keep-vertices, or raise --crease-angle"),
        ("fit open.obj --faces 20", "4 have one face only"),
        ("fit three.obj --keep-vertices", "vertices 0 and 1, [0.5, 0, 0], has 3 faces (0, 2, 6)"),
        ("fit points.ply --faces 100", "points.ply: the PLY file has no element 'face'"),
        ("fit missing.off --faces 100", "missing.off: cannot read:"),
        (
            "fit sphere_1280.stl --faces 100 --region -1,-1,-1,1,1,1",
            "--region is for surfaces of functions",
        ),
        (
            "fit sphere_1280.stl --faces 100 --certify",
            "about the surface of a mesh nothing can be proven",
        ),
        ("fit --shape sphere --keep-vertices", "--keep-vertices is for meshes"),
        ("fit sphere_1280.stl --faces 100 --keep-vertices", "cannot be used with"),
        ("fit sphere_1280.stl --faces 100 --jet-degree 5", "5 is not in 2..=4"),
    ] {
        let arguments: Vec<&str> = options.split_whitespace().chain(["-o", "x.vtu"]).collect();
        refuses(&place, &arguments, &[message]);
    }
}
