//! Triangles and quadrilaterals with corner normals from OBJ.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use io::glam::DVec3;
use io::{LargeFaces, ObjReadError, Polygon, Polygons, read_polygons};
use proptest::prelude::*;

const HOUSE: &str = "\
# two walls that meet in a crease, and a roof
o house
v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 1 1 0
v 1 1 1
vn 0 -1 0
g wall
f 1/1/1 2/2/1 3/3/1 4/4/1
vn 2 0 0
s off
f 2//2 5//-1 6//2 3//2
f 4 3 6
";

fn read(text: &str) -> Result<Polygons, ObjReadError> {
    read_polygons(&mut text.as_bytes(), LargeFaces::Refuse)
}

#[test]
fn faces_and_normals_are_kept_by_index() {
    let house = read(HOUSE).unwrap();
    assert_eq!(house.positions.len(), 6);
    assert_eq!(house.normals, [DVec3::NEG_Y, DVec3::X * 2.0], "values are not touched");
    let faces: Vec<&[usize]> = house.faces.iter().map(Polygon::corners).collect();
    assert_eq!(faces, [&[0, 1, 2, 3][..], &[1, 4, 5, 2], &[3, 2, 5]]);
    let normals: Vec<&[Option<usize>]> =
        house.corner_normals.iter().map(Polygon::corners).collect();
    assert_eq!(normals, [&[Some(0); 4][..], &[Some(1); 4], &[None; 3]]);
    assert!(!house.has_normals(), "the roof has none");
}

#[test]
fn large_faces_are_refused_or_split() {
    let pentagon =
        "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1 5\n";
    let refused = read(pentagon).unwrap_err().to_string();
    assert!(refused.contains("line 7: face 1 has 5 corners"), "{refused}");
    let split = read_polygons(&mut pentagon.as_bytes(), LargeFaces::Split).unwrap();
    let faces: Vec<&[usize]> = split.faces.iter().map(Polygon::corners).collect();
    assert_eq!(faces, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    assert_eq!(split.corner_normals[2].corners(), [Some(0), Some(0), None]);
}

#[test]
fn quadrilaterals_are_cut_along_the_shorter_diagonal() {
    let kite =
        "v 0 0 0\nv 1 0 0\nv 3 3 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2 3 4\nf 2 3 4 1//1\nf 1 2 3\n";
    let cut = read(kite).unwrap().triangulated();
    let faces: Vec<&[usize]> = cut.faces.iter().map(Polygon::corners).collect();
    assert_eq!(faces, [[0, 1, 3], [1, 2, 3], [1, 2, 3], [1, 3, 0], [0, 1, 2]]);
    let first_normals: Vec<_> = cut.corner_normals.iter().map(|n| n.corners()[0]).collect();
    assert_eq!(first_normals, [Some(0), None, None, None, None]);
    assert_eq!(cut.corner_normals[3].corners(), [None, None, Some(0)]);
}

#[test]
fn errors_name_line_and_element() {
    for (change, expected) in [
        (("f 4 3 6", "f 4 3"), "line 15: face 3 has 2 corners"),
        (("f 4 3 6", "f 4 3 9"), "line 15: face 3 uses vertex 9, but there are only 6"),
        (("f 4 3 6", "f 4 3 -7"), "line 15: face 3 uses vertex -7, but there are only 6"),
        (("f 4 3 6", "f 4//3 3 6"), "line 15: face 3 uses normal 3, but there are only 2"),
        (("f 4 3 6", "f 4//-3 3 6"), "line 15: face 3 uses normal -3, but there are only 2"),
        (("f 4 3 6", "f 4//0 3 6"), "line 15: '4//0' is not a corner"),
        (("f 4 3 6", "f 4 6 4"), "line 15: face 3 uses vertex 4 more than once"),
        (("vn 2 0 0", "vn 2 0"), "line 12: a normal has 3 finite numbers"),
        (("vn 2 0 0", "vn 2 0 nan"), "line 12: a normal has 3 finite numbers"),
        (("vn 2 0 0", "vn 2 0 x"), "line 12: 'x' is not a number"),
        (("v 1 1 1", "v 1 1 inf"), "line 8: vertex 6"),
        (("s off", "surf"), "line 13: the statement 'surf'"),
    ] {
        let text = HOUSE.replacen(change.0, change.1, 1);
        let message = read(&text).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{change:?}: {message}");
    }
    assert!(matches!(read("v 0 0 0\n"), Err(ObjReadError::NoFaces)), "no faces");
}

proptest! {
    #[test]
    fn damaged_text_never_panics(
        at in 0..HOUSE.len(),
        with in prop::collection::vec(any::<u8>(), 0..4),
    ) {
        let mut bytes = HOUSE.as_bytes().to_vec();
        bytes.splice(at..=at, with);
        if let Ok(mesh) = read_polygons(&mut bytes.as_slice(), LargeFaces::Split) {
            for face in mesh.faces.iter().flat_map(Polygon::corners) {
                prop_assert!(*face < mesh.positions.len());
            }
        }
    }
}
