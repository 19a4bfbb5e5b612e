//! Gmsh files: read back equal, in both versions.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::{Random, nets_from, octahedron, strip, torus};
use io::basemesh::{FaceMap, Topology};
use io::bezier_core::{Barycentric, BezierTriangle, MultiIndex, SepticTriangle};
use io::glam::DVec3;
use io::{CurvedMesh, MshError, MshOptions, MshVersion, node_order, quad_node_order, write_msh};

const VERSIONS: [MshVersion; 2] = [MshVersion::V4, MshVersion::V2];

fn text(mesh: &CurvedMesh, version: MshVersion) -> String {
    let mut bytes = Vec::new();
    write_msh(&mut bytes, mesh, &MshOptions { version, ..MshOptions::default() }).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn section<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let start = text.split(&format!("${name}\n")).nth(1).unwrap();
    start.split(&format!("\n$End{name}")).next().unwrap().lines().collect()
}

fn numbers<T: std::str::FromStr<Err: std::fmt::Debug>>(line: &str) -> Vec<T> {
    line.split(' ').map(|word| word.parse().unwrap()).collect()
}

/// A reader of its own, which knows as much as the format's manual.
fn read(text: &str, order: usize) -> CurvedMesh {
    let is_new = section(text, "MeshFormat") == ["4.1 0 8"];
    let nodes = section(text, "Nodes");
    let points: Vec<DVec3> = if is_new {
        let [1, count, 1, last] = numbers::<usize>(nodes[0])[..] else { panic!("{}", nodes[0]) };
        assert_eq!(count, last, "{}", nodes[0]);
        let tags: Vec<usize> =
            nodes[2..2 + count].iter().map(|line| line.parse().unwrap()).collect();
        assert!(tags.into_iter().eq(1..=count), "tags follow each other");
        nodes[2 + count..].iter().map(|line| DVec3::from_slice(&numbers(line))).collect()
    } else {
        nodes[1..].iter().map(|line| DVec3::from_slice(&numbers::<f64>(line)[1..])).collect()
    };
    let mut mesh = CurvedMesh { order, points, ..CurvedMesh::default() };
    let (mut kind, mut left) = (0, 0);
    for line in &section(text, "Elements")[1..] {
        let row: Vec<usize> = numbers(line);
        if is_new && left == 0 {
            (kind, left) = (row[2], row[3]);
            continue;
        }
        left = left.saturating_sub(1);
        let (kind, ids) = if is_new { (kind, &row[1..]) } else { (row[1], &row[5..]) };
        let is_quad = [3, 10, 36, 37, 38].contains(&kind) || (47..=51).contains(&kind);
        let order = if is_quad { quad_node_order(order) } else { node_order(order) };
        let mut by_rank = vec![0; ids.len()];
        order.iter().zip(ids).for_each(|(&rank, id)| by_rank[rank] = id - 1);
        if is_quad { mesh.quads.extend(by_rank) } else { mesh.triangles.extend(by_rank) }
    }
    mesh
}

fn random_patches(topology: &Topology) -> FaceMap<SepticTriangle> {
    let mut random = Random(8);
    nets_from(topology, || random.point())
}

#[test]
fn read_back_equal_in_every_order() {
    for topology in [octahedron(), torus(3), strip()] {
        let nets = random_patches(&topology);
        for order in 1..=10 {
            let mesh = CurvedMesh::from_patches(&topology, &nets, order);
            for version in VERSIONS {
                assert_eq!(read(&text(&mesh, version), order), mesh, "order {order}, {version:?}");
            }
        }
    }
}

#[test]
fn quadrilaterals_beside_triangles() {
    // two squares and a triangle, every number possible
    let mut random = Random(4);
    let order = 2;
    let points = (0..21).map(|_| DVec3::from_array([0; 3].map(|_| random.any_finite()))).collect();
    let quads = (0..9).chain([2, 9, 10, 5, 11, 12, 8, 13, 14]).collect();
    let triangles = vec![6, 15, 7, 16, 17, 8];
    let mesh = CurvedMesh { order, points, triangles, quads };
    for version in VERSIONS {
        let back = read(&text(&mesh, version), order);
        assert_eq!((&back.triangles, &back.quads), (&mesh.triangles, &mesh.quads), "{version:?}");
        let bits = |mesh: &CurvedMesh| -> Vec<_> {
            mesh.points.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
        };
        assert_eq!(bits(&back), bits(&mesh), "{version:?}");
    }
}

#[test]
fn nodes_are_points_of_the_patches() {
    let topology = octahedron();
    let nets = random_patches(&topology);
    let mesh = CurvedMesh::from_patches(&topology, &nets, 3);
    let [each, _] = mesh.nodes_each();
    for (face, nodes) in topology.faces().zip(mesh.triangles.chunks(each)) {
        for (index, &node) in MultiIndex::all(3).zip(nodes) {
            let at = [index.i, index.j, index.k].map(|step| step as f64 / 3.0);
            let point = nets[face].eval(Barycentric::from_array(at));
            // a shared node comes from one of the patches
            assert!(mesh.points[node].distance(point) < 1e-14, "{face} {index:?}");
        }
    }
}

#[test]
fn order_seven_holds_degree_seven() {
    let topology = torus(3);
    let nets = random_patches(&topology);
    let gap = |order| {
        CurvedMesh::from_patches(&topology, &nets, order).gap(|face, at| match at {
            io::FacePoint::Triangle(at) => nets.as_slice()[face].eval(at),
            io::FacePoint::Quad(_) => unreachable!("only triangles"),
        })
    };
    assert!(gap(7) < 1e-12, "order 7: {}", gap(7));
    assert!(gap(10) < 1e-10, "order 10: {}", gap(10));
    assert!(gap(6) > 1e-3, "order 6: {}", gap(6));
}

#[test]
fn what_cannot_be_written_is_named() {
    let refused = |mesh: &CurvedMesh, options: &MshOptions| {
        let mut bytes = Vec::new();
        let error = write_msh(&mut bytes, mesh, options).unwrap_err();
        assert_eq!(bytes, [0; 0], "nothing is written");
        error
    };
    let good = CurvedMesh {
        order: 1,
        points: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![0, 1, 2],
        quads: Vec::new(),
    };
    let usual = MshOptions::default();
    let message = |mesh: &CurvedMesh| refused(mesh, &usual).to_string();
    let too_high = CurvedMesh { order: 11, triangles: Vec::new(), ..good.clone() };
    assert!(message(&too_high).contains("order 11"), "{}", message(&too_high));
    let missing = CurvedMesh { triangles: vec![0, 1, 3], ..good.clone() };
    assert_eq!(message(&missing), "triangle 0 uses node 3, but there are only 3");
    let torn = CurvedMesh { triangles: vec![0, 1], ..good.clone() };
    assert_eq!(message(&torn), "2 nodes are no whole number of triangle with 3 nodes each");
    let mut broken = good.clone();
    broken.points[2].y = f64::INFINITY;
    assert_eq!(message(&broken), "node 2 of triangle 0 is [0, inf, 0], which is not finite");
    let options = MshOptions { group: "a\"b".into(), ..MshOptions::default() };
    assert!(matches!(refused(&good, &options), MshError::Group { .. }), "a name with a quote");
}

#[test]
fn elements_of_low_degree_patches_have_their_bits_at_the_corners() {
    let topology = strip();
    let mut random = Random(2);
    let nets: FaceMap<BezierTriangle<DVec3, 6>> = nets_from(&topology, || random.point());
    let mesh = CurvedMesh::from_patches(&topology, &nets, 5);
    for (face, patch) in nets.iter() {
        let vertex = topology.corners(face)[0].index();
        assert_eq!(mesh.points[vertex], patch.net()[0], "vertex {vertex}");
    }
}
