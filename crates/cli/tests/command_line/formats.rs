//! Files for other programs.

use crate::workplace::Workplace;

fn text(place: &Workplace, name: &str) -> String {
    String::from_utf8(place.read(name)).unwrap()
}

/// Runs a command line that must be refused; returns the message.
fn fail(place: &Workplace, line: &str) -> String {
    let run = place.run(line);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{line}\n{}", run.stderr);
    run.stderr
}

#[test]
fn every_format_of_a_fit() {
    let place = Workplace::new();
    let files = "-o a.step -o b.stp -o a.msh -o a.ply -o a.stl -o a.glb -o a.obj";
    let table = place.succeed(&format!(
        "fit --shape sphere --faces 40 {files} --chord-tolerance 1e-3 --order 3 --msh-version 2.2 \
         --unit m --step-schema ap214 --report a.json"
    ));
    let step = text(&place, "a.step");
    assert!(
        step.contains("AUTOMOTIVE_DESIGN") && step.contains("SI_UNIT($,.METRE.)"),
        "{}",
        &step[..900]
    );
    assert_eq!(step.matches("ADVANCED_FACE").count(), 120);
    assert_eq!(step.matches("MANIFOLD_SOLID_BREP").count(), 1);
    assert!(text(&place, "b.stp").contains("PRODUCT('b','b'"));
    let msh = text(&place, "a.msh");
    assert!(msh.starts_with("$MeshFormat\n2.2 0 8\n"), "{}", &msh[..40]);
    assert_eq!(msh.matches(" 21 2 1 1 ").count(), 40);

    let files = &place.json("a.json")["files"];
    let gap = |k: usize| files[k]["sampling_deviation"].as_f64();
    assert_eq!(gap(0), None, "STEP is exact");
    assert!(gap(2).unwrap() > 1e-5, "order 3 is not exact");
    let diagonal = place.json("a.json")["deviation"]["diagonal"].as_f64().unwrap();
    for k in 3..7 {
        assert!(gap(k).unwrap() <= 1e-3 * diagonal, "file {k}: {:?}", gap(k));
        assert_eq!(files[k]["cells"], files[3]["cells"]);
    }
    assert!(table.contains(" flat triangles, "), "{table}");
}

#[test]
fn degenerate_faces_are_smaller() {
    let place = Workplace::new();
    place.succeed("fit --shape sphere --faces 40 -q -o a.step");
    place.succeed("fit --shape sphere --faces 40 -q -o b.step --step-faces degenerate");
    assert_eq!(text(&place, "b.step").matches("ADVANCED_FACE").count(), 40);
    let [a, b] = ["a.step", "b.step"].map(|name| place.read(name).len());
    assert!(2 * b < a, "{b} bytes instead of {a}");
}

#[test]
fn curved_meshes() {
    let place = Workplace::new();
    place.write(
        "m.obj",
        "v 1 0 0\nv 0 1 0\nv 0 0 1\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\nf 1//1 2//2 3//3\n",
    );
    place.succeed("nagata m.obj -q -o a.step -o a.msh -o a.glb");
    assert!(text(&place, "a.step").contains("OPEN_SHELL"), "one triangle is open");
    assert!(text(&place, "a.msh").contains("\n2 1 9 1\n"), "one triangle of order 2");
    let refused = fail(&place, "nagata m.obj --continuity g1 -q -o g.step");
    assert!(refused.contains("use --continuity c0"), "{refused}");
}

#[test]
fn pieces_are_joined() {
    let place = Workplace::with_ball();
    place.succeed("fit --shape torus --faces 100 -q -o torus.vtu");
    place.succeed("join ball.vtu torus.vtu -o all.pvtu");
    let joined = text(&place, "all.pvtu");
    assert!(joined.contains(r#"<Piece Source="ball.vtu"/>"#), "{joined}");
    assert!(joined.contains(r#"Name="deviation""#), "{joined}");
    place.write("m.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
    place.succeed("nagata m.obj -q -o other.vtu");
    let refused = fail(&place, "join ball.vtu other.vtu -o all.pvtu");
    assert!(refused.contains("write all pieces in the same way"), "{refused}");
    assert_eq!(text(&place, "all.pvtu"), joined, "the old file is still there");
    let refused = fail(&place, "join ball.vtu -o all.vtu");
    assert!(refused.contains("must end with .pvtu"), "{refused}");
}

#[test]
fn options_that_make_no_sense() {
    let place = Workplace::new();
    for (options, reason) in [
        ("-o a.msh --order 11", "from 1 to 10"),
        ("-o a.obj --chord-tolerance 0", "above zero"),
        ("-o a.obj --chord-tolerance 1e-3 --divisions 4", "cannot be used with"),
        ("-o a.iges", ".step or .msh"),
    ] {
        let refused = fail(&place, &format!("fit --shape sphere --faces 40 -q {options}"));
        assert!(refused.contains(reason), "{options}: {refused}");
    }
    assert_eq!(place.everything(), [], "nothing is written");
}
