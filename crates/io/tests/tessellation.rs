//! Tessellations: closed where the surface is closed, on the surface, oriented.

#![allow(clippy::float_cmp, reason = "shared points are equal, not close")]
#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use common::{OCTAHEDRON_CORNERS, Random, bulged, nets_from, octahedron, strip, torus};
use io::basemesh::{FaceMap, Topology, TriMesh, VertexId};
use io::bezier_core::{Barycentric, BezierTriangle, MultiIndex};
use io::glam::DVec3;
use io::{Tessellation, tessellate};

fn to_mesh(tessellation: Tessellation) -> TriMesh {
    TriMesh::new(tessellation.positions, &tessellation.triangles).unwrap()
}

fn check_counts<const P: usize>(topology: &Topology) {
    let mut random = Random(17);
    let nets: FaceMap<BezierTriangle<DVec3, P>> = nets_from(topology, || random.point());
    for divisions in [1, 2, 3, 7, 16] {
        let flat = tessellate(topology, &nets, divisions);
        let interior = (divisions - 1) * (divisions.max(2) - 2) / 2;
        let [v, e, f] = [topology.vertex_count(), topology.edge_count(), topology.face_count()];
        assert_eq!(flat.positions.len(), v + (divisions - 1) * e + interior * f);
        assert_eq!(flat.normals.len(), flat.positions.len());
        assert_eq!(flat.triangles.len(), divisions * divisions * f);
        let mesh = to_mesh(flat);
        assert_eq!(mesh.topology().euler_characteristic(), topology.euler_characteristic());
        assert_eq!(mesh.topology().is_closed(), topology.is_closed());
        assert_eq!(mesh.topology().component_count(), topology.component_count());
    }
}

#[test]
fn closed_stays_closed() {
    for topology in [octahedron(), torus(3), torus(5), strip()] {
        check_counts::<3>(&topology);
        check_counts::<10>(&topology);
        check_counts::<36>(&topology);
    }
}

#[test]
fn points_lie_on_the_patches() {
    let topology = octahedron();
    let mut random = Random(23);
    let nets: FaceMap<BezierTriangle<DVec3, 36>> = nets_from(&topology, || random.point());
    let divisions = 5;
    let flat = tessellate(&topology, &nets, divisions);
    for (vertex, position) in flat.positions[..6].iter().enumerate() {
        let face = topology.faces().find(|&f| topology.corners(f)[0].index() == vertex);
        if let Some(face) = face {
            assert_eq!(nets[face].net()[0], *position);
        }
    }
    // the triangles of a patch follow each other and the first is at its first corner
    for (face, patch) in nets.iter() {
        let triangles = &flat.triangles[divisions * divisions * face.index()..];
        let ids = topology.corners(face).map(VertexId::index);
        assert_eq!(triangles[0][0], ids[0]);
        let pattern = MultiIndex::all(divisions - 1);
        for (triangle, m) in triangles.iter().zip(pattern) {
            let n = divisions as f64;
            let at = [(m.i + 1) as f64 / n, m.j as f64 / n, m.k as f64 / n];
            let expected = patch.eval_de_casteljau(Barycentric::from_array(at));
            let distance = expected.distance(flat.positions[triangle[0]]);
            assert!(distance <= 64.0 * f64::EPSILON, "face {face}, {m:?}: {distance:e}");
        }
    }
}

#[test]
fn normals_point_outwards() {
    let topology = octahedron();
    let nets: FaceMap<BezierTriangle<DVec3, 15>> =
        bulged(&topology, &OCTAHEDRON_CORNERS, |p| p.normalize());
    let flat = tessellate(&topology, &nets, 8);
    for (position, normal) in flat.positions.iter().zip(&flat.normals) {
        assert!((normal.length() - 1.0).abs() <= 4.0 * f64::EPSILON);
        assert!(normal.dot(*position) > 0.8, "{position} {normal}");
    }
    let volume = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|i| flat.positions[i]);
        a.dot(b.cross(c)) / 6.0
    };
    assert!(flat.triangles.iter().all(|t| volume(t) > 0.0));
    let total: f64 = flat.triangles.iter().map(volume).sum();
    // control points on the unit sphere: the surface lies inside
    assert!(total > 2.9 && total < 4.0 * std::f64::consts::PI / 3.0, "{total}");
}

#[test]
fn singular_patches_have_no_normal() {
    let topology = strip();
    let nets: FaceMap<BezierTriangle<DVec3, 10>> = nets_from(&topology, || DVec3::ONE);
    let flat = tessellate(&topology, &nets, 3);
    assert!(flat.normals.iter().all(|n| *n == DVec3::ZERO));
}

#[test]
#[should_panic(expected = "at least one division")]
fn zero_divisions() {
    let topology = strip();
    let nets: FaceMap<BezierTriangle<DVec3, 3>> = nets_from(&topology, || DVec3::ONE);
    let _ = tessellate(&topology, &nets, 0);
}
