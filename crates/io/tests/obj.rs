//! Triangle meshes through OBJ and back, and the oddities of other programs.

#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use common::{Random, octahedron, strip, torus};
use io::basemesh::{Topology, TopologyError, TriMesh, VertexId};
use io::glam::DVec3;
use io::{
    ObjReadError, ObjWriteError, Tessellation, read_obj, read_obj_file, write_obj,
    write_obj_tessellation,
};
use proptest::prelude::*;

fn read(text: &str) -> Result<TriMesh, ObjReadError> {
    read_obj(&mut text.as_bytes())
}

fn refused(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

fn mesh(topology: &Topology, mut draw: impl FnMut() -> f64) -> TriMesh {
    let positions = (0..topology.vertex_count()).map(|_| DVec3::new(draw(), draw(), draw()));
    let faces: Vec<_> =
        topology.faces().map(|f| topology.corners(f).map(VertexId::index)).collect();
    TriMesh::new(positions.collect(), &faces).unwrap()
}

fn bits(points: &[DVec3]) -> Vec<[u64; 3]> {
    points.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn every_bit_comes_back(seed in any::<u64>()) {
        let mut random = Random(seed);
        for topology in [octahedron(), strip(), torus(4)] {
            let mesh = mesh(&topology, || random.any_finite());
            let mut file = Vec::new();
            write_obj(&mut file, &mesh).unwrap();
            let back = read_obj(&mut file.as_slice()).unwrap();
            prop_assert_eq!(back.topology(), mesh.topology());
            let expected = bits(mesh.positions().as_slice());
            prop_assert_eq!(bits(back.positions().as_slice()), expected);
        }
    }

    #[test]
    fn damaged_text_never_panics(
        at in 0..SQUARE.len(),
        with in prop::collection::vec(any::<u8>(), 0..4),
    ) {
        let mut bytes = SQUARE.as_bytes().to_vec();
        bytes.splice(at..=at, with);
        if let Ok(mesh) = read_obj(&mut bytes.as_slice()) {
            prop_assert!(mesh.positions().as_slice().iter().all(|p| p.is_finite()));
        }
    }
}

#[test]
fn a_tessellation_has_normals_and_reads_back() {
    let tessellation = Tessellation {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::new(0.1, 1e-300, -0.0)],
        normals: vec![DVec3::Z; 3],
        triangles: vec![[0, 1, 2]],
    };
    let mut file = Vec::new();
    write_obj_tessellation(&mut file, &tessellation).unwrap();
    let text = String::from_utf8(file).unwrap();
    assert_eq!(
        text,
        "v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 0.1 1e-300 -0.0\n\
         vn 0.0 0.0 1.0\nvn 0.0 0.0 1.0\nvn 0.0 0.0 1.0\nf 1//1 2//2 3//3\n"
    );
    let back = read(&text).unwrap();
    assert_eq!(bits(back.positions().as_slice()), bits(&tessellation.positions));

    let broken = Tessellation { normals: vec![DVec3::NAN; 3], ..tessellation.clone() };
    let mut file = Vec::new();
    let error = write_obj_tessellation(&mut file, &broken).unwrap_err();
    assert!(matches!(error, ObjWriteError::NotFinite { point: 0, what: "normal", .. }));
    assert!(file.is_empty());
    let few = Tessellation { normals: vec![], ..tessellation };
    let error = write_obj_tessellation(&mut file, &few).unwrap_err();
    assert_eq!(error.to_string(), "there are 3 positions but 0 normals");
}

#[test]
fn the_same_mesh_in_many_spellings() {
    let expected = read(SQUARE).unwrap();
    let spellings = [
        SQUARE.replace('\n', "\r\n"),
        SQUARE.replace("f 1 2 3\nf 1 3 4", "f -4 -3 -2\nf -4 -2 -1"),
        SQUARE.replace("f 1 2 3", "f 1/7 2/8 3/9"),
        SQUARE.replace("f 1 2 3", "f 1//7 2//8 3//-9"),
        SQUARE.replace("f 1 2 3", "f 1/1/1 2/2/2 3/3/3"),
        SQUARE.replace("f 1 2 3", "f\t1  2 \\\n   3 # continued"),
        SQUARE.replace("v 0 0 0", "# comment\n\n  v +0. 0e0 0.000 1.0"),
        SQUARE.replace("v 0 0 0", "mtllib a b.mtl\nvn 1 2\nvt x\ns off\ng\no A\nv 0 0 0 .5 .5 .5"),
        SQUARE.trim_end().to_owned(),
        // faces may come before their vertices
        format!("f 1 2 3\n{}", SQUARE.replacen("f 1 2 3\n", "", 1)),
    ];
    for spelling in spellings {
        assert_eq!(read(&spelling).unwrap(), expected, "{spelling}");
    }
    let latin1 = [b"# \xe9\xe8\n".as_slice(), SQUARE.as_bytes()].concat();
    assert_eq!(read_obj(&mut latin1.as_slice()).unwrap(), expected);
}

#[test]
fn refusals_name_line_and_element() {
    let with = |old: &str, new: &str| refused(&SQUARE.replacen(old, new, 1));
    let check = |old: &str, new: &str, expected: &str| {
        let message = with(old, new);
        assert!(message.starts_with(expected), "{message}");
    };
    check("f 1 3 4", "f 1 2 3 4", "line 6: face 2 has 4 corners; only triangles are read");
    check("f 1 3 4", "f 1 3", "line 6: face 2 has 2 corners");
    check("f 1 3 4", "f 1 3 5", "line 6: face 2 uses vertex 5, but there are only 4 vertices");
    check("f 1 3 4", "f 1 3 -5", "line 6: face 2 uses vertex -5, but there are only 4 vertices");
    check("f 1 3 4", "f 1 3 0", "line 6: '0' is not a corner; expected v, v/vt");
    check("f 1 3 4", "f 1 3 4//", "line 6: '4//' is not a corner");
    check("f 1 3 4", "f 1 3 4/1/1/1", "line 6: '4/1/1/1' is not a corner");
    check("f 1 3 4", "f 1 3 99999999999999999999", "line 6: '99999999999999999999' is not");
    check("v 1 1 0", "v 1 NaN 0", "line 3: vertex 3 has the position [1, NaN, 0], which is not");
    check("v 1 1 0", "v 1 1e999 0", "line 3: vertex 3 has the position [1, inf, 0]");
    check("v 1 1 0", "v 1 1,5 0", "line 3: '1,5' is not a number");
    check("v 1 1 0", "v 1 1", "line 3: a vertex has 3 coordinates (4 with weight, 6 with colour)");
    check("v 1 1 0", "v 1 1 0 1 2", "line 3: a vertex has 3 coordinates");
    check("f 1 3 4", "curv 1 3 4", "line 6: the statement 'curv' is not supported");
    check("f 1 3 4", "f 1 3 3", "line 6: face 1 uses vertex 2 more than once (vertices and faces");
    check("f 1 3 4", "f 1 4 3", "line 5: faces 0 and 1 disagree about the orientation of edge 0-2");
    check("f 1 3 4", "f 1 3 4\nf 3 1 2", "line 5: ");
    check("f 1 3 4\n", "", "line 4: vertex 3 belongs to no face; remove it");
    // old line ends make one long line
    let old = SQUARE.replace('\n', "\r");
    assert!(refused(&old).starts_with("line 1: "), "{}", refused(&old));
    assert_eq!(refused(""), "there are no faces; is this an OBJ file?");
    assert_eq!(refused("v 0 0 0\n"), "there are no faces; is this an OBJ file?");
    let bow = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\nf 1 2 3\nf 1 4 5\n";
    assert!(refused(bow).starts_with("line 1: the faces around vertex 0 form several fans"));
    match read(&SQUARE.replace("f 1 3 4", "f 1 3 4\nf 1 3 4")).unwrap_err() {
        ObjReadError::Topology { line: 5, cause: TopologyError::NonManifoldEdge { a, b, .. } } => {
            assert_eq!((a, b), (0, 2));
        }
        other => panic!("{other}"),
    }
}

#[test]
fn files_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("square.obj");
    let missing = read_obj_file(&path).unwrap_err().to_string();
    assert!(missing.starts_with(&format!("{}: cannot read: ", path.display())), "{missing}");
    io::write_atomically(&path, |out| Ok(write_obj(out, &read(SQUARE).unwrap())?)).unwrap();
    assert_eq!(read_obj_file(&path).unwrap(), read(SQUARE).unwrap());
    std::fs::write(&path, "f 1 2 3").unwrap();
    let message = read_obj_file(&path).unwrap_err().to_string();
    assert!(message.ends_with("line 1: face 1 uses vertex 1, but there are only 0 vertices"));
}
