//! `smoothpatch nagata` when all is well.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;

use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::io::{CellValues, Grid, GridCell, LargeFaces, read_grid_file, read_polygons_file};

use crate::workplace::Workplace;

pub(crate) fn place_with_spot() -> Workplace {
    let place = Workplace::new();
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/meshes");
    for name in ["spot_triangulated.obj", "spot_quadrangulated.obj"] {
        place.write(name, std::fs::read(meshes.join(name)).unwrap());
    }
    place
}

/// A cylinder of radius 1 and height 2 with lids, `n` segments; a normal for each side of the rims.
pub(crate) fn cylinder(n: usize) -> String {
    let mut text = String::new();
    for z in [-1, 1] {
        for k in 0..n {
            let angle = TAU * k as f64 / n as f64;
            writeln!(text, "v {:?} {:?} {z}", angle.cos(), angle.sin()).unwrap();
        }
    }
    for k in 0..n {
        let angle = TAU * k as f64 / n as f64;
        writeln!(text, "vn {:?} {:?} 0", angle.cos(), angle.sin()).unwrap();
    }
    writeln!(text, "v 0 0 -1\nv 0 0 1\nvn 0 0 -1\nvn 0 0 1").unwrap();
    for k in 0..n {
        let (a, b) = (k + 1, (k + 1) % n + 1);
        let (c, d) = (a + n, b + n);
        writeln!(text, "f {a}//{a} {b}//{b} {d}//{b} {c}//{a}").unwrap();
        let (low, high) = (n + 1, n + 2);
        writeln!(text, "f {b}//{low} {a}//{low} {}//{low}", 2 * n + 1).unwrap();
        writeln!(text, "f {c}//{high} {d}//{high} {}//{high}", 2 * n + 2).unwrap();
    }
    text
}

pub(crate) fn cells(place: &Workplace, name: &str) -> Grid {
    read_grid_file(place.path(name)).unwrap()
}

pub(crate) fn data(grid: &Grid, name: &str) -> Vec<f64> {
    let data = grid.cell_data.iter().find(|data| data.name == name).unwrap();
    match &data.values {
        CellValues::Float64(values) => values.clone(),
        CellValues::Int64(values) => values.iter().map(|&value| value as f64).collect(),
    }
}

/// Whether a table has these rows, whatever the width of its columns.
pub(crate) fn has_rows(table: &str, rows: &[&str]) {
    let words: Vec<&str> = table.split_whitespace().collect();
    let words = words.join(" ");
    for row in rows {
        assert!(words.contains(row), "{row:?} is missing in\n{table}");
    }
}

/// Whether every directed side of the triangles in a file has its opposite.
pub(crate) fn is_closed(place: &Workplace, name: &str) -> bool {
    let mesh = read_polygons_file(place.path(name), LargeFaces::Refuse).unwrap();
    let sides = mesh.faces.iter().flat_map(|face| {
        let corners = face.corners();
        (0..corners.len()).map(|c| [corners[c], corners[(c + 1) % corners.len()]])
    });
    let mut sides: Vec<_> = sides.collect();
    sides.sort_unstable();
    let count = sides.len();
    sides.dedup();
    let opposite = |[a, b]: &[usize; 2]| sides.binary_search(&[*b, *a]).is_ok();
    count == sides.len() && sides.iter().all(opposite)
}

#[test]
fn spot_of_triangles_in_both_continuities() {
    let place = place_with_spot();
    let table = place.succeed(
        "nagata spot_triangulated.obj --crease-angle 90 -o c0.vtu -o c0.obj --divisions 2 \
         --report c0.json",
    );
    has_rows(
        &table,
        &[
            "spot_triangulated.obj, C0 Nagata patches",
            "normals estimated, creases from 90°",
            "triangles 5856",
            "Euler characteristic 2",
            "closed yes",
            "boundary edges 0",
            "wrote c0.vtu (",
            "23424 flat triangles, ",
        ],
    );
    let report = place.json("c0.json");
    assert_eq!(report["triangles"], 5856);
    assert_eq!(report["closed"], true);
    assert_eq!(report.get("deviation"), None);
    assert_eq!(report["files"][0].get("sampling_deviation"), None, "quadratic cells are exact");
    let gap = report["files"][1]["sampling_deviation"].as_f64().unwrap();
    assert!(gap > 0.0 && gap < 1e-2, "gap {gap}");
    assert!(is_closed(&place, "c0.obj"), "cracks");
    let grid = cells(&place, "c0.vtu");
    assert_eq!(grid.points.len(), 2930 + 8784, "each node once");
    assert!(grid.cells.iter().all(|cell| matches!(cell, GridCell::QuadraticTriangle(_))));
    let kinks = data(&grid, "edge_kink_deg");
    assert_eq!(kinks.len(), 5856);

    place.succeed(
        "nagata spot_triangulated.obj --crease-angle 90 --continuity g1 -o g1.vtu --divisions 2 \
         --report g1.json",
    );
    let report = place.json("g1.json");
    assert!(report["g1_residual"].as_f64().unwrap() < 1e-11, "{}", report["g1_residual"]);
    let gap = report["files"][0]["sampling_deviation"].as_f64().unwrap();
    assert!(gap > 0.0 && gap < 1e-3, "gap {gap}");
    let grid = cells(&place, "g1.vtu");
    assert_eq!(grid.cells.len(), 4 * 5856);
    assert_eq!(data(&grid, "face")[4..8], [1.0; 4]);
}

#[test]
fn spot_of_quadrilaterals() {
    let place = place_with_spot();
    let table = place.succeed(
        "nagata spot_quadrangulated.obj --crease-angle 90 -o a.vtu -o a.obj --divisions 3",
    );
    has_rows(&table, &["quadrilaterals 2928", "closed yes", "Euler characteristic 2"]);
    assert!(is_closed(&place, "a.obj"), "cracks");
    let grid = cells(&place, "a.vtu");
    assert!(grid.cells.iter().all(|cell| matches!(cell, GridCell::QuadraticQuad(_))));
    assert_eq!((grid.cells.len(), grid.points.len()), (2928, 2930 + 5856));
    let normals = grid.normals.iter().filter(|normal| normal.length() > 0.5).count();
    assert!(normals > 8000, "only {normals} points have a normal");

    let table =
        place.succeed("nagata spot_quadrangulated.obj --crease-angle 90 --triangulate -o b.vtu");
    has_rows(&table, &["triangles 5856"]);
}

#[test]
fn creases_stay_sharp_and_rims_round() {
    let place = Workplace::new();
    let n = 24;
    place.write("cylinder.obj", cylinder(n));
    let table =
        place.succeed("nagata cylinder.obj -o a.vtu -o a.obj --divisions 4 --report a.json");
    has_rows(
        &table,
        &[
            "normals file",
            "faces 48 triangles, 24 quadrilaterals",
            "creases 48",
            "boundary edges 0",
            "folded patches 0",
        ],
    );
    let area = place.json("a.json")["area"]["value"].as_f64().unwrap();
    assert!((area / (6.0 * PI) - 1.0).abs() < 1e-4, "area {area}");
    assert!(is_closed(&place, "a.obj"), "cracks at the rims");

    // every sample of the rims is on the circle to the order of the edges
    let mesh = read_polygons_file(place.path("a.obj"), LargeFaces::Refuse).unwrap();
    let radius = |p: &DVec3| p.x.hypot(p.y);
    let on_rim = mesh.positions.iter().filter(|p| p.z.abs() > 1.0 - 1e-12 && radius(p) > 0.99);
    let worst = on_rim.map(|p| (radius(p) - 1.0).abs()).fold(0.0, f64::max);
    // the quadratic through the ends of an arc of this angle, with the right tangents
    let expected = (TAU / n as f64).powi(4) / 128.0;
    assert!((worst / expected - 1.0).abs() < 0.02, "the rims are off by {worst}, not {expected}");

    // the normals of a wall are horizontal, those of a lid vertical, at the rims too
    for (face, normals) in mesh.faces.iter().zip(&mesh.corner_normals) {
        let heights: Vec<f64> = face.corners().iter().map(|&v| mesh.positions[v].z).collect();
        let is_lid = heights.iter().all(|z| z.abs() > 1.0 - 1e-12);
        for normal in normals.corners().iter().map(|n| mesh.normals[n.unwrap()]) {
            let lean = if is_lid { normal.z.abs() } else { 1.0 - normal.z.abs() };
            assert!(lean > 0.999, "normal {normal}");
        }
    }
}

#[test]
fn normals_and_distances_of_a_scene() {
    let place = Workplace::new();
    place.succeed("fit --shape torus --faces 400 --quiet -o fitted.obj --divisions 1");
    place.write("torus.ron", r#"(version: 1, name: "ring", surface: Shape("torus"), faces: 20)"#);
    let table = place
        .succeed("nagata fitted.obj --normals torus.ron --continuity g1 -o a.vtu --report a.json");
    has_rows(&table, &["compared with ring"]);
    let report = place.json("a.json");
    let deviation = report["deviation"]["max"].as_f64().unwrap();
    assert!(deviation > 1e-6 && deviation < 1e-2, "deviation {deviation}");
    assert!(report["g1_residual"].as_f64().unwrap() < 1e-11, "{}", report["g1_residual"]);
    let worst = data(&cells(&place, "a.vtu"), "deviation").into_iter().fold(0.0, f64::max);
    assert!((worst - deviation).abs() < 1e-12, "{worst} in the cells, {deviation} in the report");

    // the normals of the file are those of the fitted patches
    place.succeed("nagata fitted.obj --reference torus.ron -o b.obj --report b.json");
    assert_eq!(place.json("b.json")["normals"], "file");
    assert!(place.json("b.json")["deviation"]["max"].as_f64().unwrap() < 1e-2);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let place = place_with_spot();
    for threads in ["1", "2"] {
        place.succeed(&format!(
            "nagata spot_triangulated.obj --continuity g1 --quiet --threads {threads} --divisions 1 \
             -o {threads}.vtu -o {threads}.obj"
        ));
    }
    assert!(place.read("1.vtu") == place.read("2.vtu"), "the cells differ");
    assert!(place.read("1.obj") == place.read("2.obj"), "the triangles differ");
}

/// A cone over a circle of radius 1 with its tip at height 1, `n` segments, no lid.
fn cone(n: usize) -> String {
    let mut text = String::new();
    for k in 0..n {
        let angle = TAU * k as f64 / n as f64;
        writeln!(text, "v {:?} {:?} 0", angle.cos(), angle.sin()).unwrap();
    }
    writeln!(text, "v 0 0 1").unwrap();
    for k in 0..n {
        writeln!(text, "f {} {} {}", k + 1, (k + 1) % n + 1, n + 1).unwrap();
    }
    text
}

/// With a normal for each face the patches are cones up to the error of their base arcs; with the mean
/// normal of all, as anywhere else, the tip is blunt.
#[test]
fn tips_become_cones() {
    let place = Workplace::new();
    place.write("cone.obj", cone(12));
    let worst = |options: &str| {
        let table = place.succeed(&format!("nagata cone.obj -o out.obj {options}"));
        let mesh = read_polygons_file(place.path("out.obj"), LargeFaces::Refuse).unwrap();
        let off = |p: &DVec3| (p.truncate().length() + p.z - 1.0).abs();
        (table, mesh.positions.iter().map(off).fold(0.0, f64::max))
    };
    let (_, plain) = worst("");
    for (name, bound) in [("none", 0.02), ("faces", 1e-4), ("axis", 1e-4)] {
        let (table, off) = worst(&format!("--apex {name}"));
        has_rows(&table, &["tips 1"]);
        assert!(off < bound, "{name}: {off}");
        assert!(off < 0.1 * plain, "{name}: {off}, without: {plain}");
    }
    let (table, _) = worst("--apex none --apex-angle 80");
    has_rows(&table, &["tips 0"]);
}
