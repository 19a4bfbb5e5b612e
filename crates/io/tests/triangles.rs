//! Flat triangles: within the tolerance, without cracks, and the same in every format.

#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use std::collections::HashMap;

use common::{OCTAHEDRON_CORNERS, bulged, octahedron, strip};
use io::basemesh::{FaceMap, Topology, TriMesh};
use io::bezier_core::{Barycentric, QuarticTriangle, SepticTriangle};
use io::glam::DVec3;
use io::{
    ChordError, CreasedTessellation, FacePoint, Polygon, Polygons, TrianglesError,
    tessellate_patches_within, tessellate_within, write_glb, write_ply, write_stl,
};

fn ball() -> (Topology, FaceMap<SepticTriangle>) {
    let topology = octahedron();
    let nets = bulged(&topology, &OCTAHEDRON_CORNERS, |p| p.normalize());
    (topology, nets)
}

/// The distance from a point to a triangle.
fn to_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_segment = |a: DVec3, b: DVec3| {
        let t = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        point.distance(a + (b - a) * t)
    };
    let normal = (b - a).cross(c - a).normalize();
    let foot = point - normal * (point - a).dot(normal);
    let inside = |a: DVec3, b: DVec3| (b - a).cross(foot - a).dot(normal) >= 0.0;
    if inside(a, b) && inside(b, c) && inside(c, a) {
        return point.distance(foot);
    }
    to_segment(a, b).min(to_segment(b, c)).min(to_segment(c, a))
}

fn is_closed(flat: &CreasedTessellation) -> bool {
    let mut sides: HashMap<[usize; 2], i32> = HashMap::new();
    for t in &flat.triangles {
        for k in 0..3 {
            let [a, b] = [t[k], t[(k + 1) % 3]];
            *sides.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { 100 };
        }
    }
    sides.values().all(|&uses| uses == 101)
}

#[test]
fn patches_are_closed_and_within_the_tolerance() {
    let (topology, nets) = ball();
    let mut counts = Vec::new();
    for tolerance in [1e-1, 1e-2, 1e-3] {
        let flat = tessellate_patches_within(&topology, &nets, tolerance).unwrap();
        assert!(flat.gap <= tolerance && flat.gap > tolerance / 8.0, "{} {tolerance}", flat.gap);
        assert!(is_closed(&flat.tessellation));
        let triangles = &flat.tessellation.triangles;
        let mesh = TriMesh::new(flat.tessellation.positions.clone(), triangles).unwrap();
        assert_eq!(mesh.topology().euler_characteristic(), 2);
        // every point of a fine grid on the patches is near the triangles of its patch
        let mut first = 0;
        for ((_, patch), count) in nets.iter().zip(&flat.triangles_of_face) {
            let own = &triangles[first..first + count];
            first += count;
            for at in Barycentric::lattice(13) {
                let point = patch.eval(at);
                let corners = own.iter().map(|t| t.map(|id| flat.tessellation.positions[id]));
                let nearest = corners.map(|t| to_triangle(point, t)).fold(f64::INFINITY, f64::min);
                assert!(nearest <= 1.05 * tolerance, "{nearest} for {tolerance}");
            }
        }
        counts.push(triangles.len());
    }
    // a hundredth of the distance takes ten times the sides, a hundred times the triangles
    assert!((20..300).contains(&(counts[2] / counts[0])), "{counts:?}");
}

#[test]
fn flat_patches_stay_whole_and_flat_parts_coarse() {
    let topology = strip();
    let corners: Vec<_> = (0..5).map(|k| DVec3::new(f64::from(k), f64::from(k * k), 0.0)).collect();
    let nets: FaceMap<QuarticTriangle> = bulged(&topology, &corners, |p| p);
    let flat = tessellate_patches_within(&topology, &nets, 1e-9).unwrap();
    assert_eq!(flat.triangles_of_face, [1, 1, 1]);
    assert_eq!(flat.tessellation.normals.len(), 5);
}

/// Two quadrilaterals and a triangle over the plane, with a crease at the line x = 1.
fn roof() -> Polygons {
    let places = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [2, 1], [3, 0]];
    let quad = |corners: [usize; 4]| Polygon::quad(corners);
    Polygons {
        positions: places.map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), 0.0)).into(),
        normals: vec![DVec3::Z; 9],
        faces: vec![quad([0, 1, 2, 3]), quad([1, 4, 5, 2]), Polygon::triangle([4, 6, 5])],
        corner_normals: vec![
            quad([0, 1, 2, 3]).map_some(),
            quad([7, 4, 5, 8]).map_some(),
            Polygon::triangle([4, 6, 5]).map_some(),
        ],
    }
}

trait MapSome {
    fn map_some(self) -> Polygon<Option<usize>>;
}

impl MapSome for Polygon<usize> {
    fn map_some(self) -> Polygon<Option<usize>> {
        let some: Vec<_> = self.corners().iter().copied().map(Some).collect();
        Polygon::new(&some).unwrap()
    }
}

/// Height zero at the vertices, curved between.
fn on_roof(face: usize, at: FacePoint) -> (DVec3, DVec3) {
    let [x, y] = match at {
        FacePoint::Quad([x, y]) => [x + face as f64, y],
        FacePoint::Triangle(at) => [2.0 * at.u + 3.0 * at.v + 2.0 * at.w, at.w],
    };
    let wave = |t: f64| t * (1.0 - t) * (t - 2.0) * (t - 3.0);
    (DVec3::new(x, y, 0.3 * wave(x) + 0.1 * y * (1.0 - y)), DVec3::Z)
}

#[test]
fn quadrilaterals_triangles_and_creases() {
    let mesh = roof();
    let flat = tessellate_within(&mesh, 1e-3, on_roof).unwrap();
    let CreasedTessellation { positions, normals, triangles, triangle_normals } =
        &flat.tessellation;
    assert_eq!(flat.triangles_of_face.iter().sum::<usize>(), triangles.len());
    let topology = TriMesh::new(positions.clone(), triangles).unwrap();
    assert_eq!(topology.topology().euler_characteristic(), 1);
    // one boundary around: no crack inside
    let boundary = topology.topology().edges().filter(|&e| topology.topology().is_boundary_edge(e));
    for edge in boundary {
        let [a, b] = topology.topology().edge_vertices(edge).map(|v| positions[v.index()]);
        let outside = |f: &dyn Fn(DVec3) -> f64| f(a).abs() < 1e-12 && f(b).abs() < 1e-12;
        let sides: [&dyn Fn(DVec3) -> f64; 4] =
            [&|p| p.x, &|p| p.y, &|p| p.y - 1.0, &|p| p.x + p.y - 3.0];
        assert!(sides.into_iter().any(outside), "a crack at {a} {b}");
    }
    // points of the crease have two normals, others one
    let mut of_point: HashMap<usize, Vec<usize>> = HashMap::new();
    for (corners, of_corners) in triangles.iter().zip(triangle_normals) {
        for (&point, &normal) in corners.iter().zip(of_corners) {
            let all = of_point.entry(point).or_default();
            if !all.contains(&normal) {
                all.push(normal);
            }
        }
    }
    for (point, all) in of_point {
        let expected = if positions[point].x == 1.0 { 2 } else { 1 };
        assert_eq!(all.len(), expected, "{}", positions[point]);
    }
    assert!(normals.iter().all(|n| *n == DVec3::Z));
}

#[test]
fn impossible_tolerances_are_named() {
    let mesh = roof();
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = tessellate_within(&mesh, value, on_roof).unwrap_err();
        assert!(matches!(error, ChordError::Tolerance { .. }), "{error}");
    }
    // waves much shorter than the shortest piece; at the halves of edges they are zero
    let noise = |face, at| {
        let (mut point, normal) = on_roof(face, at);
        point.z += (1e9 * std::f64::consts::PI * point.x).sin();
        (point, normal)
    };
    let message = tessellate_within(&mesh, 1e-3, noise).unwrap_err().to_string();
    assert!(message.starts_with("face 0 is not within the chord tolerance of 1e-3"), "{message}");
    let hole = |face, at| {
        let (point, normal) = on_roof(face, at);
        (if point.x > 2.4 { DVec3::NAN } else { point }, normal)
    };
    let message = tessellate_within(&mesh, 1e-3, hole).unwrap_err().to_string();
    assert!(message.starts_with("face 2 has the point"), "{message}");
}

fn flat_ball() -> CreasedTessellation {
    let (topology, nets) = ball();
    tessellate_patches_within(&topology, &nets, 1e-2).unwrap().tessellation
}

fn f64_at(bytes: &[u8], at: usize) -> f64 {
    f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
}

fn u32_at(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

#[test]
fn ply_keeps_every_bit() {
    let flat = flat_ball();
    let mut bytes = Vec::new();
    write_ply(&mut bytes, &flat).unwrap();
    let end = b"end_header\n";
    let body = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let head = std::str::from_utf8(&bytes[..body]).unwrap();
    let points = flat.positions.len();
    assert!(head.contains(&format!("element vertex {points}\n")), "{head}");
    let faces = body + 48 * points;
    assert_eq!(bytes.len(), faces + 13 * flat.triangles.len());
    for (at, corners) in flat.triangles.iter().enumerate() {
        assert_eq!(bytes[faces + 13 * at], 3);
        for (k, &corner) in corners.iter().enumerate() {
            let row = body + 48 * u32_at(&bytes, faces + 13 * at + 1 + 4 * k);
            let read: Vec<f64> = (0..6).map(|c| f64_at(&bytes, row + 8 * c)).collect();
            assert_eq!(DVec3::from_slice(&read[..3]), flat.positions[corner]);
            let normal = flat.normals[flat.triangle_normals[at][k]];
            assert_eq!(DVec3::from_slice(&read[3..]), normal);
        }
    }
}

#[test]
fn stl_rounds_and_glb_agrees() {
    let flat = flat_ball();
    let (mut stl, mut glb) = (Vec::new(), Vec::new());
    write_stl(&mut stl, &flat).unwrap();
    write_glb(&mut glb, &flat).unwrap();
    assert_eq!(u32_at(&stl, 80), flat.triangles.len());
    assert_eq!(stl.len(), 84 + 50 * flat.triangles.len());
    assert_eq!((&glb[..4], u32_at(&glb, 8)), (&b"glTF"[..], glb.len()));
    let json_size = u32_at(&glb, 12);
    let json = std::str::from_utf8(&glb[20..20 + json_size]).unwrap();
    let points = flat.positions.len();
    assert!(json.contains(&format!(r#""count":{points},"type":"VEC3""#)), "{json}");
    let binary = 28 + json_size;
    let f32_at =
        |bytes: &[u8], at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    for (at, corners) in flat.triangles.iter().enumerate() {
        for (k, &corner) in corners.iter().enumerate() {
            let expected = flat.positions[corner].as_vec3().to_array();
            let in_stl = [0, 1, 2].map(|c| f32_at(&stl, 84 + 50 * at + 12 + 12 * k + 4 * c));
            assert_eq!(in_stl, expected);
            let id = u32_at(&glb, binary + 24 * points + 12 * at + 4 * k);
            assert_eq!([0, 1, 2].map(|c| f32_at(&glb, binary + 12 * id + 4 * c)), expected);
        }
    }
}

#[test]
fn what_cannot_be_written_is_named() {
    let mut flat = flat_ball();
    let corner = flat.triangles[5][1];
    flat.positions[corner] = DVec3::splat(1e39);
    let mut bytes = Vec::new();
    write_ply(&mut bytes, &flat).unwrap();
    bytes.clear();
    let error = write_stl(&mut bytes, &flat).unwrap_err();
    assert!(matches!(error, TrianglesError::TooLarge { .. }), "{error}");
    let error = write_glb(&mut bytes, &flat).unwrap_err();
    assert!(matches!(error, TrianglesError::TooLarge { .. }), "{error}");
    flat.positions[corner].x = f64::NAN;
    let message = write_ply(&mut bytes, &flat).unwrap_err().to_string();
    assert!(message.contains("has the position [NaN"), "{message}");
    flat.triangles[0][0] = usize::MAX;
    let error = write_stl(&mut bytes, &flat).unwrap_err();
    assert!(matches!(error, TrianglesError::Missing { triangle: 0, .. }), "{error}");
    let error = write_glb(&mut bytes, &CreasedTessellation::default()).unwrap_err();
    assert!(matches!(error, TrianglesError::Empty), "{error}");
    assert_eq!(bytes, [0; 0]);
}
