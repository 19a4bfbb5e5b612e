//! `smoothpatch fit` when all is well.

use serde_json::Value;
use smoothpatch::basemesh::TriMesh;
use smoothpatch::io::{CellValues, VtuSurface, read_obj_file, read_vtu_file};

use crate::workplace::Workplace;

fn patches(place: &Workplace, name: &str) -> VtuSurface<36> {
    read_vtu_file(place.path(name)).unwrap()
}

fn triangles(place: &Workplace, name: &str) -> TriMesh {
    read_obj_file(place.path(name)).unwrap()
}

fn cell_data(surface: &VtuSurface<36>, name: &str) -> Vec<f64> {
    let data = surface.cell_data.iter().find(|data| data.name == name).unwrap();
    match &data.values {
        CellValues::Float64(values) => values.clone(),
        CellValues::Int64(values) => values.iter().map(|&value| value as f64).collect(),
    }
}

#[test]
fn all_files_are_written_and_agree() {
    let place = Workplace::new();
    let table = place
        .succeed("fit --shape sphere --faces 60 -o a.vtu -o a.obj --divisions 3 --report a.json");
    let surface = patches(&place, "a.vtu");
    let report = place.json("a.json");

    assert_eq!(surface.topology.face_count(), 60);
    assert_eq!(report["continuity"]["faces"], 60);
    assert_eq!(report["deviation"]["grid"], 32);
    assert_eq!(report.get("adaptation"), None);
    assert_eq!(triangles(&place, "a.obj").topology().face_count(), 60 * 9);
    assert!(triangles(&place, "a.obj").topology().is_closed(), "the triangulation has cracks");

    let deviation = cell_data(&surface, "deviation").into_iter().fold(0.0, f64::max);
    assert_eq!(Some(deviation), report["deviation"]["max"].as_f64());
    assert!(deviation > 0.0 && deviation < 1e-4, "deviation {deviation}");
    assert_eq!(cell_data(&surface, "normal_error_deg").len(), 60);
    assert_eq!(cell_data(&surface, "folded"), [0.0; 60]);

    for row in [
        "faces                 60",
        "Euler characteristic  2",
        "folded patches        0",
        "fallback curves       0",
        "G1 angle ",
        "max deviation ",
        "RMS deviation ",
        "max normal error ",
        "finest grid           32 divisions",
        "polygonize ",
        "measure ",
        "wrote                 a.vtu (",
        "wrote                 a.json (",
    ] {
        assert!(table.contains(row), "{row:?} is missing in\n{table}");
    }
    for file in report["files"].as_array().unwrap() {
        let contents = place.read(file["file"].as_str().unwrap());
        assert_eq!(file["bytes"], contents.len());
    }
    assert_eq!(place.everything().len(), 3, "nothing else is left");
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let place = Workplace::new();
    for threads in ["1", "2"] {
        place.succeed(&format!(
            "fit --shape torus --faces 200 --quiet --threads {threads} \
             -o {threads}.vtu -o {threads}.obj --report {threads}.json"
        ));
    }
    assert!(place.read("1.vtu") == place.read("2.vtu"), "the patches differ");
    assert!(place.read("1.obj") == place.read("2.obj"), "the triangulations differ");
    let [one, two] = ["1.json", "2.json"].map(|name| {
        let Value::Object(mut report) = place.json(name) else { panic!("no object") };
        report.remove("seconds");
        report.remove("files");
        report
    });
    assert_eq!(one, two);
}

#[test]
fn quiet_prints_nothing() {
    let place = Workplace::new();
    assert_eq!(place.succeed("fit --shape sphere --faces 20 --quiet -o a.vtu"), "");
}

#[test]
fn both_methods_and_both_kinds_of_cells() {
    let place = Workplace::new();
    let mut deviations = Vec::new();
    for method in ["published", "refined"] {
        place.succeed(&format!(
            "fit --shape torus --faces 400 --method {method} --cells lagrange \
             -o {method}.vtu --report {method}.json"
        ));
        assert_eq!(place.json(&format!("{method}.json"))["method"], method);
        // rounding of the points is amplified by the way back to control points
        place.succeed(&format!("check {method}.vtu --closed --euler 0 --max-g1-angle 1e-8"));
        let report = place.json(&format!("{method}.json"));
        deviations.push(report["deviation"]["max"].as_f64().unwrap());
    }
    assert!(deviations[1] < 0.2 * deviations[0], "max deviations {deviations:?}");
}

#[test]
fn a_formula_gets_a_region_by_itself() {
    let place = Workplace::new();
    let run = place.run_with(&[
        "fit",
        "--formula",
        "-(r^2 - x^2 - y^2 - 2*z^2)",
        "--constant",
        "r=3",
        "--level",
        "-0.5",
        "--faces",
        "100",
        "-o",
        "a.vtu",
        "--report",
        "a.json",
    ]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = place.json("a.json");
    let size = report["region"][1][0].as_f64().unwrap();
    assert!((2.9..4.5).contains(&size), "half size {size} for a radius of {}", 8.5_f64.sqrt());
    assert_eq!(report["surface"]["Formula"]["constants"]["r"], 3.0);
    assert_eq!(report["surface"]["Formula"]["level"], -0.5);
}

#[test]
fn a_base_mesh_keeps_its_faces() {
    let place = Workplace::new();
    place.succeed("fit --shape sphere --faces 50 -o a.vtu -o base.obj --divisions 1");
    let base = triangles(&place, "base.obj");

    place.succeed("fit --shape sphere --base-mesh base.obj -o b.vtu --report b.json");
    let corners = |name| {
        let topology = patches(&place, name).topology;
        topology.faces().map(|face| topology.corners(face)).collect::<Vec<_>>()
    };
    let expected: Vec<_> = base.topology().faces().map(|f| base.topology().corners(f)).collect();
    assert_eq!(corners("b.vtu"), expected);
    assert_eq!(place.json("b.json")["base_mesh_file"], "base.obj");

    std::fs::create_dir(place.path("scenes")).unwrap();
    place.write(
        "scenes/ball.ron",
        r#"(version: 1, name: "ball", surface: Shape("sphere"), faces: 10, base_mesh: "../base.obj")"#,
    );
    place.succeed("fit scenes/ball.ron -o c.vtu");
    assert!(place.read("b.vtu") == place.read("c.vtu"), "the scene's base mesh is not the same");
}

#[test]
fn options_go_before_the_scene() {
    let place = Workplace::new();
    place.write(
        "ball.ron",
        r#"(version: 1, name: "ball", surface: Formula(text: "x^2 + y^2 + z^2", level: 4),
            region: (min: (-3, -3, -3), max: (3, 3, 3)), faces: 30)"#,
    );
    place.succeed("fit ball.ron -o a.vtu --report a.json");
    place.succeed("fit ball.ron --faces 40 --region -2.5,-3,-3,3,3,3 -o b.vtu --report b.json");
    let asked = |name| {
        let report = place.json(name);
        (report["faces_asked"].as_u64().unwrap(), report["region"][0][0].as_f64().unwrap())
    };
    assert_eq!([asked("a.json"), asked("b.json")], [(30, -3.0), (40, -2.5)]);
}

#[test]
fn a_surface_with_edges_is_fitted_with_warnings() {
    let place = Workplace::new();
    let cube = ["fit", "--formula", "max(max(abs(x), abs(y)), abs(z)) - 1", "--faces", "40"];
    let run = place.run_with(&[&cube[..], &["-o", "a.vtu"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.starts_with("warning: "), "no warning: {}{}", run.stdout, run.stderr);
    let place_of_edge = ["around [", "a sharp edge?"];
    assert!(place_of_edge.iter().all(|part| run.stderr.contains(part)), "{}", run.stderr);
    assert!(run.stdout.contains("patches taken back "), "{}", run.stdout);
    let run = place.run_with(&[&cube[..], &["-o", "b.vtu", "--quiet"]].concat());
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
}

#[test]
fn an_accuracy_is_reached_and_checked() {
    let place = Workplace::new();
    let table =
        place.succeed("fit --shape torus --tolerance 1e-5 -o t.vtu --report t.json --certify");
    assert!(table.contains("1.00e-5 of the diagonal: met"), "{table}");
    assert!(table.contains("proven bound"), "{table}");
    let report = place.json("t.json");
    assert_eq!(report["adaptation"]["met"], true);
    assert!(report["deviation"]["max"].as_f64().unwrap() <= 1e-5, "{report}");
    let proven = report["certificate"]["bound"].as_f64().unwrap();
    assert!(proven >= report["deviation"]["max"].as_f64().unwrap(), "{report}");
    place.succeed("check t.vtu --shape torus --max-deviation 1e-5 --max-folds 0");
}

#[test]
fn a_normal_tolerance_alone() {
    let place = Workplace::new();
    place.succeed("fit --shape sphere --normal-tolerance 0.05 -o s.vtu");
    place.succeed("check s.vtu --shape sphere --max-normal-error 0.05 --max-deviation 1e-4");
}

#[test]
fn a_length_as_tolerance() {
    let place = Workplace::new();
    // the sphere's diagonal is 2 sqrt(3)
    let table =
        place.succeed("fit --shape sphere --tolerance 1e-6 --absolute -o s.vtu --report s.json");
    assert!(table.contains("1.00e-6 (a length): met"), "{table}");
    let report = place.json("s.json");
    assert_eq!(report["adaptation"]["tolerance"]["distance"]["Absolute"], 1e-6);
    let part = 1e-6 / report["deviation"]["diagonal"].as_f64().unwrap();
    place.succeed(&format!("check s.vtu --shape sphere --max-deviation {part}"));
}

#[test]
fn a_tolerance_goes_before_the_faces_of_the_scene() {
    let place = Workplace::new();
    place.write("ball.ron", r#"(version: 1, name: "ball", surface: Shape("sphere"), faces: 10)"#);
    let table = place.succeed("fit ball.ron --tolerance 1e-5 -o s.vtu --report s.json");
    assert!(table.contains("faces of the scene    10, not used: the tolerance"), "{table}");
    let report = place.json("s.json");
    assert!(report["continuity"]["faces"].as_u64().unwrap() > 10, "{report}");
    assert_eq!(report.get("faces_asked"), None);
}

/// A ball with two tips, where normals jump by more than any tolerance of normals allows.
#[test]
fn a_tolerance_that_is_not_met() {
    let place = Workplace::new();
    let run = place.run_with(&[
        "fit",
        "--formula",
        "x^2 + y^2 + z^2 - 1 + 0.45*sqrt(x^2 + y^2)",
        "--region",
        "-2,-2,-2,2,2,2",
        "--tolerance",
        "1",
        "--method",
        "published",
        "-o",
        "a.vtu",
        "--report",
        "a.json",
    ]);
    assert_eq!(run.code, 1, "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("NOT met"), "{}", run.stdout);
    assert!(run.stderr.contains("warning: the tolerance is not met"), "{}", run.stderr);
    assert!(run.stderr.contains("(asked for: 1.00e1°)"), "{}", run.stderr);
    let report = place.json("a.json");
    assert_eq!(report["adaptation"]["met"], false);
    assert!(report["deviation"]["max_normal_deg"].as_f64().unwrap() > 9.5, "{report}");
    assert_eq!(patches(&place, "a.vtu").topology.face_count(), report["continuity"]["faces"]);
}

/// The search for a region works in threads, too.
#[test]
fn threads_can_be_limited_without_a_region() {
    let place = Workplace::new();
    place.succeed("fit --formula x^2+y^2+z^2-1 --faces 20 --threads 1 -o a.vtu");
}
