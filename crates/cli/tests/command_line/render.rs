//! `smoothpatch render`: pictures, and what is said where there is none.

use crate::workplace::Workplace;

/// Width and height in the head of a PNG file.
fn size(png: &[u8]) -> [u32; 2] {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n", "the signature");
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

#[test]
fn every_shade_is_drawn_and_says_what_it_means() {
    let place = Workplace::with_ball();
    for (shade, meaning) in [
        ("zebra", "reflection lines"),
        ("isophotes", "isophotes"),
        ("normals", "red to the right"),
        ("curvature", "mean curvature, from -1.0"),
        ("deviation", "largest of each patch, from the file"),
        ("deviation --shape sphere", "at each point"),
    ] {
        let line = format!("render ball.vtu -o ball.png --size 80x60 --shade {shade}");
        let said = place.succeed(&line);
        assert!(said.contains(meaning), "{line}: {said}");
        assert!(said.contains("40 patches of degree 7, with their own normals"), "{said}");
        assert_eq!(size(&place.read("ball.png")), [80, 60], "{line}");
    }
}

#[test]
fn pictures_do_not_depend_on_threads() {
    let place = Workplace::with_ball();
    let picture = |options: &str| {
        let line = format!("render ball.vtu -o ball.png --size 120x90 --quiet {options}");
        assert_eq!(place.succeed(&line), "", "quiet");
        place.read("ball.png")
    };
    let plain = picture("--threads 1");
    assert_eq!(plain, picture("--threads 3"), "threads");
    for other in [
        "--edges",
        "--view top",
        "--view 10,20",
        "--up y",
        "--zoom 2",
        "--centre 1,0,0",
        "--stripes 5",
    ] {
        assert_ne!(plain, picture(other), "{other} changes the picture");
    }
}

#[test]
fn two_stages_are_set_side_by_side() {
    let place = Workplace::new();
    place.succeed(
        "fit --shape sphere --faces 40 --method published -o g1.vtu --before-join g0.vtu --quiet",
    );
    let run = place.run("check g0.vtu --max-gap 0 --max-g1-angle 1e-9");
    assert_eq!(run.code, 1, "kinks");
    assert!(run.stderr.contains("--max-g1-angle"), "{}", run.stderr);
    assert!(!run.stderr.contains("--max-gap"), "no gaps: {}", run.stderr);
    let said = place.succeed("render g0.vtu --compare g1.vtu -o both.png --size 160x60");
    assert!(said.contains("g0.vtu") && said.contains("g1.vtu"), "{said}");
    let together = place.read("both.png");
    place.succeed("render g0.vtu --compare g0.vtu -o same.png --size 160x60 --quiet");
    assert_ne!(together, place.read("same.png"), "the stages look different");
}

const TENT: &str = "v 0 0 0\nv 1 0 0.2\nv 1 1 0\nv 0 1 0.2\nf 1 2 3\nf 1 3 4\n";

#[test]
fn cells_of_other_commands_are_drawn() {
    let place = Workplace::new();
    place.write("tent.obj", TENT);
    place.succeed("nagata tent.obj -o curved.vtu --quiet");
    place.succeed("nagata tent.obj -o flat.vtu --cells flat --divisions 4 --quiet");
    place.succeed("apatch cube --scheme c2-quintic --density 2 -o cube.vtu --quiet");
    for (file, contents) in [
        ("curved.vtu", "2 quadratic cells with their own normals"),
        ("flat.vtu", "32 flat cells with the normals of the file"),
        ("cube.vtu", "flat cells with the normals of the file"),
    ] {
        let said = place.succeed(&format!("render {file} -o out.png --size 80x60 --edges"));
        assert!(said.contains(contents), "{said}");
    }
    place.succeed("render cube.vtu -o out.png --size 160x120 --shade curvature");
    place.succeed("render curved.vtu -o out.png --size 160x120 --shade curvature");
    place.fails_with(
        "render flat.vtu -o bad.png --shade curvature",
        "flat cells have no curvature, and the file has no point data `mean_curvature`",
    );
    place.fails_with(
        "render flat.vtu -o bad.png --shade deviation",
        "name the surface with --scene, --shape or --formula",
    );
}

#[test]
fn mistakes_are_explained_and_leave_no_file() {
    let place = Workplace::with_ball();
    place.write("broken.vtu", "no file of VTK");
    let before = place.everything();
    for (line, message) in [
        ("render missing.vtu -o a.png", "missing.vtu"),
        ("render broken.vtu -o a.png", "broken.vtu"),
        ("render ball.vtu -o a.jpg", "the name of a picture must end with .png"),
        ("render ball.vtu -o nowhere/a.png", "nowhere"),
        ("render ball.vtu -o a.png --size 800", "such as 1200x900"),
        ("render ball.vtu -o a.png --size 0x900", "16 to 16384 pixels"),
        ("render ball.vtu -o a.png --view side", "iso, front, back, left, right, top, bottom"),
        ("render ball.vtu -o a.png --view 0,91", "from -90 to 90 degrees"),
        ("render ball.vtu -o a.png --zoom 0", "from 0.001 to 1000"),
        ("render ball.vtu -o a.png --shape sphere", "--shade deviation only"),
        ("render ball.vtu -o a.png --range 0,1", "--shade curvature and --shade deviation only"),
        ("render ball.vtu -o a.png --shade curvature --range 1,0", "must be the smaller one"),
        ("render ball.vtu -o a.png --shade deviation --range 0,1", "begins above 0"),
        ("render ball.vtu -o a.png --compare missing.vtu", "missing.vtu"),
        ("render ball.vtu", "--output <FILE.png>"),
        ("fit --shape sphere -o b.vtu --before-join b.vtu", "would be written twice"),
        ("fit --shape sphere -o b.vtu --before-join b.obj", "the name must end with .vtu"),
    ] {
        place.fails_with(line, message);
    }
    assert_eq!(place.everything(), before, "no file is left");
}
