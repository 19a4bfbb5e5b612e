//! Grids of flat and quadratic cells through VTU and back.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::{ENCODINGS, Random};
use io::glam::DVec3;
use io::{CellData, CellValues, Encoding, Grid, GridCell, VtuWriteError, read_grid, write_grid};
use proptest::prelude::*;

/// All kinds of cells over eight points.
fn grid(mut draw: impl FnMut() -> f64) -> Grid {
    let mut point = || DVec3::new(draw(), draw(), draw());
    let [points, normals] = [(); 2].map(|()| (0..8).map(|_| point()).collect());
    let floats = |name: &str, values: Vec<f64>| CellData {
        name: name.to_owned(),
        values: CellValues::Float64(values),
    };
    Grid {
        points,
        normals,
        cells: vec![
            GridCell::QuadraticQuad([0, 1, 2, 3, 4, 5, 6, 7]),
            GridCell::Triangle([3, 1, 0]),
            GridCell::QuadraticTriangle([7, 6, 5, 4, 3, 2]),
            GridCell::Quad([0, 2, 4, 6]),
        ],
        point_data: vec![floats("misfit", (0..8).map(|_| draw()).collect())],
        cell_data: vec![
            floats("misfit", (0..4).map(|_| draw()).collect()),
            CellData { name: "face".into(), values: CellValues::Int64(vec![0, -1, 2, i64::MAX]) },
        ],
    }
}

fn bits(points: &[DVec3]) -> Vec<[u64; 3]> {
    points.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

fn written(grid: &Grid, encoding: Encoding) -> Vec<u8> {
    let mut file = Vec::new();
    write_grid(&mut file, grid, encoding).unwrap();
    file
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn every_bit_comes_back(seed in any::<u64>()) {
        let mut random = Random(seed);
        let grid = grid(|| random.any_finite());
        for encoding in ENCODINGS {
            let file = written(&grid, encoding);
            let back = read_grid(&mut file.as_slice()).unwrap();
            prop_assert_eq!(&back, &grid);
            prop_assert_eq!(bits(&back.points), bits(&grid.points));
            prop_assert_eq!(bits(&back.normals), bits(&grid.normals));
        }
    }

    #[test]
    fn damaged_files_never_panic(at in 0_usize..3000, with in any::<u8>(), cut in any::<bool>()) {
        let mut random = Random(1);
        let grid = grid(|| random.any_finite());
        for encoding in ENCODINGS {
            let mut file = written(&grid, encoding);
            let at = at % file.len();
            if cut {
                file.truncate(at);
            } else {
                file[at] = with;
            }
            if let Ok(back) = read_grid(&mut file.as_slice()) {
                let count = back.points.len();
                let mut ids = back.cells.iter().flat_map(GridCell::points);
                prop_assert!(ids.all(|&id| id < count));
            }
        }
    }
}

#[test]
fn optional_parts_may_be_missing() {
    let bare =
        Grid { normals: Vec::new(), point_data: Vec::new(), cell_data: Vec::new(), ..grid(|| 0.5) };
    let file = written(&bare, Encoding::Ascii);
    assert!(!String::from_utf8(file.clone()).unwrap().contains("Data>"), "no empty sections");
    assert_eq!(read_grid(&mut file.as_slice()).unwrap(), bare);
}

#[test]
fn impossible_grids_are_refused_before_anything_is_written() {
    let good = grid(|| 0.5);
    let mut missing = good.clone();
    missing.cells[1] = GridCell::Triangle([0, 1, 8]);
    let mut infinite = good.clone();
    infinite.points[3].y = f64::INFINITY;
    let mut not_a_number = good.clone();
    not_a_number.normals[2].x = f64::NAN;
    let mut normals = good.clone();
    normals.normals.pop();
    let mut twice = good.clone();
    twice.cell_data[1].name = "misfit".into();
    let mut taken = good.clone();
    taken.point_data[0].name = "Normals".into();
    let mut count = good;
    count.point_data[0].values = CellValues::Int64(vec![1]);
    for (grid, expected) in [
        (missing, "cell 1 uses point 8, but there are only 8"),
        (infinite, "the position of point 3 is [0.5, inf, 0.5], which is not finite"),
        (not_a_number, "the normal of point 2 is"),
        (normals, "there are 7 normals for 8 points"),
        (twice, "two cell data with the name 'misfit'"),
        (taken, "'Normals'"),
        (count, "the data 'misfit' has 1 values for 8 points"),
    ] {
        let mut file = Vec::new();
        let error: VtuWriteError = write_grid(&mut file, &grid, Encoding::Binary).unwrap_err();
        assert!(error.to_string().contains(expected), "{expected:?} is not in: {error}");
        assert!(file.is_empty(), "{expected:?}: something was written");
    }
}

#[test]
fn foreign_cells_are_refused_with_their_number() {
    let text = String::from_utf8(written(&grid(|| 0.5), Encoding::Ascii)).unwrap();
    for (from, to, expected) in [
        ("23 5 22 9", "23 5 10 9", "cell 2 has type 10 and 6 points"),
        ("8 11 17 21", "8 12 17 21", "cell 1 has type 5 and 4 points"),
        ("8 11 17 21", "8 4 17 21", "cell 1 has type 5 and 0 points"),
        ("8 11 17 21", "8 11 17 22", "has 21 point ids where 22 are announced"),
    ] {
        assert!(text.contains(from), "{from:?} is not in the file");
        let error = read_grid(&mut text.replacen(from, to, 1).as_bytes()).unwrap_err().to_string();
        assert!(error.contains(expected), "{expected:?} is not in: {error}");
    }
}
