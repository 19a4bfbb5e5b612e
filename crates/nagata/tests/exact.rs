//! Statements that hold exactly, or to round-off.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::GridMesh as _;

use common::queries::spot;
use common::{Random, SPHERE, TORUS, build};
use nagata::basemesh::{FaceId, VertexId};
use nagata::bezier_core::{Barycentric, Corner, LocalEdge};
use nagata::glam::{DVec3, Vec3Swizzles as _};
use nagata::{
    Apex, Continuity, CornerNormals, EdgeCurve, EdgeNormals, EdgeSettings, EdgeStatus, NagataQuad,
    NagataSurface, NagataTriangle, Patch, PolygonMesh, Settings, TangentPlanes,
    curvature_parameter,
};

#[test]
fn reversed_edges_have_the_same_bits() {
    let mut random = Random(3);
    for settings in [EdgeSettings::default(), EdgeSettings::PUBLISHED] {
        for _ in 0..2000 {
            let (d, a, b) = (random.vector(), random.unit(), random.unit());
            let forward = EdgeNormals { start: &[a], end: &[b] };
            let backward = EdgeNormals { start: &[b], end: &[a] };
            let one = curvature_parameter(d, forward, &settings);
            assert_eq!(one, curvature_parameter(-d, backward, &settings), "{d} {a} {b}");
            let cubic = EdgeCurve::cubic(d, forward, &settings);
            let reversed = EdgeCurve::cubic(-d, backward, &settings).reversed();
            assert_eq!(cubic, reversed, "{d} {a} {b}");
        }
    }
}

/// The point of a patch at parameter `t` of the side that starts at `corner`.
fn on_side(patch: &Patch, corner: usize, t: f64) -> DVec3 {
    let at = || Barycentric::on_edge(LocalEdge::starting_at(Corner::ALL[corner]), t);
    match patch {
        Patch::Triangle(patch) => patch.point(at()),
        Patch::TangentPlane(patch) => patch.point(at()),
        Patch::Quad(patch) => {
            patch.point([[t, 0.0], [1.0, t], [1.0 - t, 1.0], [0.0, 1.0 - t]][corner])
        }
    }
}

fn no_cracks(surface: &NagataSurface) {
    let mesh = surface.mesh();
    for edge in mesh.edges() {
        // halves and eighths: `1 - t` is exact
        for t in [0.0, 0.125, 0.5, 0.75, 1.0] {
            let expected = surface.edge_point(edge, t);
            for side in mesh.sides_at(edge) {
                let t = if mesh.runs_forward(side) { t } else { 1.0 - t };
                let got = on_side(&surface.patch(side.face), side.corner, t);
                assert_eq!(got, expected, "{edge:?} {side:?} {t}");
            }
        }
    }
}

#[test]
fn neighbours_agree_bit_for_bit() {
    let waves = |x: f64, y: f64| (3.0 * x).sin() * (2.0 * y).cos() * 0.5;
    let meshes = [
        common::sphere(3).mesh(),
        common::torus(6, 3, true).mesh(),
        common::torus(12, 6, false).mesh(),
        common::graph(9, waves, 5).mesh(),
    ];
    for mesh in meshes {
        // any normals: edges bend wildly and limits act
        let mut random = Random(11);
        let normals: Vec<DVec3> = mesh.vertices().map(|_| random.unit()).collect();
        let normals = CornerNormals::per_vertex(&mesh, &normals).unwrap();
        for settings in [Settings::position(), Settings::published(), Settings::tangent_plane()] {
            if mesh.is_triangular() || settings == Settings::position() {
                no_cracks(&build(&mesh, &normals, settings));
            }
        }
    }
}

#[test]
fn creases_and_sheets_do_not_crack() {
    let mesh = common::cylinder(12, 2, true).mesh();
    let normals = common::cylinder_normals(&mesh, 2, 12);
    let fins = fins();
    let estimated = CornerNormals::estimated(&fins, 0.5);
    for settings in [Settings::position(), Settings::tangent_plane()] {
        no_cracks(&build(&mesh, &normals, settings));
        no_cracks(&build(&fins, &estimated, settings));
    }
}

/// Three sheets that meet in one edge.
fn fins() -> PolygonMesh {
    let positions = vec![
        DVec3::ZERO,
        DVec3::new(0.1, 0.0, 1.0),
        DVec3::new(1.0, 0.0, 0.4),
        DVec3::new(-0.5, 0.8, 0.6),
        DVec3::new(-0.5, -0.9, 0.5),
    ];
    PolygonMesh::new(positions, &[[0, 1, 2], [0, 1, 3], [1, 0, 4]]).unwrap()
}

#[test]
fn planes_stay_planes() {
    let mut random = Random(5);
    for _ in 0..200 {
        let n = random.unit();
        let (u, v) = n.any_orthonormal_pair();
        let mut point = || u * random.next(-1.0, 1.0) + v * random.next(-1.0, 1.0);
        let corners = [point(), point(), point(), point()];
        let quad = NagataQuad::from_normals(corners, [n; 4], &EdgeSettings::default());
        let off = |p: DVec3| n.dot(p).abs() <= 4.0 * f64::EPSILON;
        assert!(off(quad.point([0.3, 0.6])), "{quad:?}");
        // chords are in the plane up to round-off, and so straight up to round-off
        assert!(quad.curvature.iter().all(|c| c.length() <= 4.0 * f64::EPSILON), "{quad:?}");
        let [a, b, c, _] = corners;
        let triangle = NagataTriangle::from_normals([a, b, c], [n; 3], &EdgeSettings::default());
        assert!(off(triangle.point(Barycentric::new(0.2, 0.5))), "{triangle:?}");
    }
}

#[test]
fn cones_with_face_normals_are_exact_over_their_base_arc() {
    let k = 3;
    let mesh = common::cone(k).mesh();
    let apex = mesh.position(VertexId::new(0));
    for choice in [Apex::FaceNormals, Apex::Axis] {
        let normals = common::cone_normals(&mesh, k, choice);
        let surface = build(&mesh, &normals, Settings::position());
        for face in (0..6 * k).map(FaceId::new) {
            let Patch::Triangle(patch) = surface.patch(face) else { panic!("not C0") };
            // rulings: x = apex + (base point - apex) s², so the apex is reached with speed zero
            for at in Barycentric::lattice(6) {
                let s = 1.0 - at.u;
                let t = if s > 0.0 { at.w / s } else { 0.5 };
                let base = patch.point(Barycentric::from_array([0.0, 1.0 - t, t]));
                let expected = apex + (base - apex) * (s * s);
                let got = patch.point(at);
                assert!(got.distance(expected) <= 1e-12, "{choice:?} {got} {expected}");
            }
            assert_eq!(patch.corner_normal(Corner::First), None, "the apex is singular");
            assert!(patch.normal(Barycentric::at(Corner::First)).is_some(), "but has a direction");
        }
    }
}

#[test]
fn exports_are_the_same_patches() {
    let mesh = common::torus(8, 4, true).mesh();
    let surface = build(&mesh, &common::smooth(&mesh, &TORUS), Settings::position());
    for face in mesh.faces() {
        let Patch::Triangle(patch) = surface.patch(face) else { panic!("not C0") };
        let nodes = patch.mid_side_nodes();
        for at in Barycentric::lattice(5) {
            let p = patch.point(at);
            assert!(p.distance(patch.bezier().eval(at)) <= 8.0 * f64::EPSILON, "{p}");
            // the shape functions of the six-node triangle
            let b = at.to_array();
            let six: DVec3 = (0..3)
                .map(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    patch.corners[i] * (b[i] * (2.0 * b[i] - 1.0)) + nodes[i] * (4.0 * b[j] * b[k])
                })
                .sum();
            assert!(p.distance(six) <= 16.0 * f64::EPSILON, "{p} {six}");
        }
    }
}

#[test]
fn batches_agree_with_single_points() {
    let mesh = common::sphere(2).mesh();
    let surface = build(&mesh, &common::smooth(&mesh, &SPHERE), Settings::position());
    let Patch::Triangle(triangle) = surface.patch(FaceId::new(5)) else { panic!("not C0") };
    let mut points = vec![DVec3::ZERO; 45];
    triangle.sample(8, &mut points);
    for (point, at) in points.iter().zip(Barycentric::lattice(8)) {
        assert!(point.distance(triangle.point(at)) <= 8.0 * f64::EPSILON, "{at:?}");
    }
    // fours and a rest
    let patches: Vec<NagataTriangle> = surface
        .mesh()
        .faces()
        .take(11)
        .map(|face| match surface.patch(face) {
            Patch::Triangle(patch) => patch,
            _ => panic!("not C0"),
        })
        .collect();
    let mut all = vec![DVec3::ZERO; 45 * patches.len()];
    NagataTriangle::sample_all(&patches, 8, &mut all);
    for (patch, together) in patches.iter().zip(all.chunks_exact(45)) {
        patch.sample(8, &mut points);
        assert_eq!(points, together, "{patch:?}");
    }
    let mesh = common::torus(8, 4, false).mesh();
    let surface = build(&mesh, &common::smooth(&mesh, &TORUS), Settings::position());
    let Patch::Quad(quad) = surface.patch(FaceId::new(3)) else { panic!("no quadrilateral") };
    let mut points = vec![DVec3::ZERO; 25];
    quad.sample(4, &mut points);
    for (s, point) in points.iter().enumerate() {
        let at = [s / 5, s % 5].map(|k| k as f64 / 4.0);
        assert!(point.distance(quad.point(at)) <= 32.0 * f64::EPSILON, "{at:?}");
    }
}

/// Triangles together have the bits of each alone: numbers that blocks do not divide, lowered edges, parallel
/// and opposite normals, a side without length.
#[test]
fn triangles_made_together_have_the_same_bits() {
    let surface = spot(Settings::position());
    let mesh = surface.mesh();
    let normals = CornerNormals::estimated(mesh, std::f64::consts::PI);
    let mut given: Vec<[[DVec3; 3]; 2]> = mesh
        .faces()
        .take(97)
        .map(|face| {
            let corners = mesh.corners(face);
            let at = |c: usize| normals.at(mesh, face, c).unwrap();
            [[0, 1, 2].map(|c| mesh.position(corners[c])), [0, 1, 2].map(at)]
        })
        .collect();
    let [corners, [n, ..]] = given[3];
    given[3] = [corners, [n; 3]];
    given[40] = [corners, [n, -n, n]];
    given[64] = [[corners[0], corners[0], corners[2]], given[64][1]];
    let bits = |patches: &[NagataTriangle]| -> Vec<[[u64; 3]; 6]> {
        let vectors = |patch: &NagataTriangle| {
            let ([a, b, c], [u, v, w]) = (patch.corners, patch.curvature);
            [a, b, c, u, v, w].map(|v| v.to_array().map(f64::to_bits))
        };
        patches.iter().map(vectors).collect()
    };
    let mut lowered = 0;
    for settings in [EdgeSettings::default(), EdgeSettings::PUBLISHED] {
        for count in [0, 1, 31, 32, 33, 97] {
            let alone: Vec<NagataTriangle> = given[..count]
                .iter()
                .map(|[corners, normals]| {
                    NagataTriangle::from_normals(*corners, *normals, &settings)
                })
                .collect();
            let zero = NagataTriangle { corners: [DVec3::ZERO; 3], curvature: [DVec3::ZERO; 3] };
            let mut together = vec![zero; count];
            NagataTriangle::fill_from_normals(&mut together, &settings, |k| given[k]);
            assert_eq!(bits(&together), bits(&alone), "{count} with {settings:?}");
            let zero = |patch: &&NagataTriangle| patch.curvature.contains(&DVec3::ZERO);
            lowered += together.iter().filter(zero).count();
        }
    }
    assert!(lowered > 0, "a side without length has no curvature");
}

/// Each edge computed alone, one after the other, has the bits of the surface, which is built in parallel
/// with the feature `rayon`.
#[test]
fn edges_computed_one_by_one_have_the_same_bits() {
    for settings in [Settings::position(), Settings::published(), Settings::tangent_plane()] {
        let cubic = same_bits_one_by_one(&spot(settings));
        let robust = settings.continuity == Continuity::TangentPlane(TangentPlanes::Robust);
        assert_eq!(cubic > 0, robust, "{cubic} cubic edges");
        // normals by vertex, numbers of edges that blocks do not divide, lowered edges, parallel normals
        for n in [3, 5] {
            let mesh = common::torus(n, 3, true).mesh();
            same_bits_one_by_one(&build(&mesh, &common::smooth(&mesh, &TORUS), settings));
            let flat =
                CornerNormals::per_vertex(&mesh, &vec![DVec3::Z; mesh.vertex_count()]).unwrap();
            same_bits_one_by_one(&build(&mesh, &flat, settings));
        }
    }
}

/// Moved vertices give the surface that is made anew, and moving them back the first one.
#[test]
fn updates_are_new_surfaces() {
    for settings in [Settings::position(), Settings::tangent_plane()] {
        let first = spot(settings);
        let mesh = first.mesh();
        let moved: Vec<DVec3> = mesh.positions().as_slice().iter().map(|p| p.yzx() * 1.5).collect();
        let mut other = mesh.clone();
        other.set_positions(&moved).unwrap();
        let normals = CornerNormals::from_fn(&other, |p| Some(p + DVec3::X));
        let mut surface = first.clone();
        surface.update(&moved, normals.clone()).unwrap();
        assert_eq!(surface, build(&other, &normals, settings));
        surface.update(mesh.positions().as_slice(), first.normals().clone()).unwrap();
        assert_eq!(surface, first);
    }
}

/// Returns the number of cubic edges.
fn same_bits_one_by_one(surface: &NagataSurface) -> usize {
    let settings = surface.settings();
    let mut cubic = 0;
    for edge in surface.mesh().edges() {
        let [start, end] = surface.edge_normals(edge);
        let normals = EdgeNormals { start: &start, end: &end };
        let [a, b] = surface.mesh().edge_vertices(edge).map(|v| surface.mesh().position(v));
        let found = curvature_parameter(b - a, normals, &settings.edges);
        let status = surface.edge_status(edge);
        let expected = if status.cubic {
            cubic += 1;
            EdgeCurve::cubic(b - a, normals, &settings.edges)
        } else {
            EdgeCurve::quadratic(found.value)
        };
        let bits = |curve: EdgeCurve| {
            [curve.curvature, curve.skew].map(|v| v.to_array().map(f64::to_bits))
        };
        assert_eq!(bits(surface.edge_curve(edge)), bits(expected), "{edge:?}");
        assert_eq!(status, EdgeStatus { cubic: status.cubic, ..found.status }, "{edge:?}");
    }
    cubic
}
