//! What a motion of everything, or another numbering of the mesh, changes.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use proptest::prelude::*;
use smoothpatch::basemesh::glam::{DMat3, DVec3};
use smoothpatch::basemesh::{TriMesh, VertexId};
use smoothpatch::implicit::ImplicitSurface;
use smoothpatch::{G1Surface, Method, Settings, Silent, fit_base_mesh};
use testkit::fields::{Blob, Moved, Wave};
use testkit::meshes::{Edit, apply_edits, icosphere, jittered, radially_on_surface};

const METHODS: [Method; 2] = [Method::Published, Method::Refined];

/// Bound on the change of control points, over the diagonal. The published method is a sequence of
/// well-conditioned steps. The refined curves minimise a function that is flat in some directions,
/// in a given number of steps; they carry round-off on, but only where the surface hardly feels it.
fn tolerance(method: Method) -> f64 {
    match method {
        Method::Published => 1e-12,
        _ => 1e-8,
    }
}

fn blob() -> Blob {
    let wave = Wave { amplitude: 0.05, wave: DVec3::new(2.0, -1.0, 1.5), phase: 0.4 };
    Blob {
        semi_axes: DVec3::new(1.1, 0.9, 1.0),
        waves: vec![wave],
        cubic: [0.05, -0.08, 0.03, 0.1],
    }
}

fn mesh() -> TriMesh {
    let edits: Vec<Edit> = (0..30)
        .map(|i| if i % 2 == 0 { Edit::Flip(31 * i) } else { Edit::Split(17 * i) })
        .collect();
    let edited = apply_edits(icosphere(2), &edits, 0.35);
    radially_on_surface(&jittered(&edited, 0.1, 3), &blob(), 4.0)
}

fn fit(field: &dyn ImplicitSurface, mesh: TriMesh, method: Method) -> G1Surface {
    let settings = Settings::with_faces(0).with_method(method);
    fit_base_mesh(field, mesh, &settings, &mut Silent).unwrap()
}

fn nets(surface: &G1Surface) -> Vec<[DVec3; 36]> {
    surface.patches.nets.as_slice().iter().map(|net| *net.net()).collect()
}

fn largest_distance(a: &[[DVec3; 36]], b: &[[DVec3; 36]]) -> f64 {
    assert_eq!(a.len(), b.len(), "as many patches");
    a.iter().flatten().zip(b.iter().flatten()).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_rigid_motion_moves_the_control_points(
        axis in prop::array::uniform3(-1.0..1.0_f64),
        angle in -3.0..3.0_f64,
        shift in prop::array::uniform3(-2.0..2.0_f64),
    ) {
        let axis = DVec3::from_array(axis).try_normalize().unwrap_or(DVec3::X);
        let field = blob();
        let motion = Moved {
            field: &field,
            rotation: DMat3::from_axis_angle(axis, angle),
            shift: DVec3::from_array(shift),
        };
        let mesh = mesh();
        let moved_positions = mesh.positions().map(|_, &p| motion.point(p));
        let moved_mesh = mesh.clone().with_positions(moved_positions).unwrap();
        for method in METHODS {
            let expected: Vec<_> = nets(&fit(&field, mesh.clone(), method))
                .into_iter()
                .map(|net| net.map(|p| motion.point(p)))
                .collect();
            let moved = nets(&fit(&motion, moved_mesh.clone(), method));
            let change = largest_distance(&expected, &moved) / mesh.diagonal();
            prop_assert!(change <= tolerance(method), "{method:?}: {change:e}");
        }
    }
}

/// Faces in another order, corners as they were: the same bits.
#[test]
fn the_order_of_faces_does_not_matter() {
    let mesh = mesh();
    let count = mesh.topology().face_count();
    // a permutation without pattern: 7919 is a prime and no divisor of the number of faces
    assert_ne!(count % 7919, 0);
    let order: Vec<usize> = (0..count).map(|f| (7919 * f + 5) % count).collect();
    let faces = mesh.face_indices();
    let reordered: Vec<[usize; 3]> = order.iter().map(|&f| faces[f]).collect();
    let reordered = TriMesh::new(mesh.positions().as_slice().to_vec(), &reordered).unwrap();
    for method in METHODS {
        let (a, b) = (fit(&blob(), mesh.clone(), method), fit(&blob(), reordered.clone(), method));
        assert_eq!(a.network.curves(), b.network.curves(), "{method:?}");
        assert_eq!(a.patches.weights, b.patches.weights, "{method:?}");
        let expected: Vec<_> = order.iter().map(|&f| nets(&a)[f]).collect();
        assert_eq!(nets(&b), expected, "{method:?}");
    }
}

/// Corners of faces turned: the same bits, because every sum over a face starts at its lowest vertex.
#[test]
fn the_first_corner_of_a_face_does_not_matter() {
    let mesh = mesh();
    let mut faces = mesh.face_indices();
    faces.iter_mut().enumerate().for_each(|(f, face)| face.rotate_left(f % 3));
    let turned = TriMesh::new(mesh.positions().as_slice().to_vec(), &faces).unwrap();
    for method in METHODS {
        let (a, b) = (fit(&blob(), mesh.clone(), method), fit(&blob(), turned.clone(), method));
        assert_eq!(a.network.curves(), b.network.curves(), "{method:?}");
        let expected: Vec<_> =
            nets(&a).iter().enumerate().map(|(f, net)| turn(net, f % 3)).collect();
        assert_eq!(nets(&b), expected, "{method:?}");
    }
}

/// The net as a patch whose first corner is the one `times` further on.
fn turn(net: &[DVec3; 36], times: usize) -> [DVec3; 36] {
    use smoothpatch::bezier_core::MultiIndex;
    std::array::from_fn(|rank| {
        let m = MultiIndex::at_rank(7, rank);
        let mut exponents = [m.i, m.j, m.k];
        exponents.rotate_right(times);
        let [i, j, k] = exponents;
        net[MultiIndex::new(i, j, k).rank()]
    })
}

/// Vertices numbered backwards: every curve is fitted and every edge system solved from its other
/// end.
///
#[test]
fn the_numbers_of_vertices_do_not_matter() {
    let mesh = mesh();
    let last = mesh.topology().vertex_count() - 1;
    let mut positions = mesh.positions().as_slice().to_vec();
    positions.reverse();
    let faces: Vec<[usize; 3]> =
        mesh.face_indices().into_iter().map(|face| face.map(|v| last - v)).collect();
    let renumbered = TriMesh::new(positions, &faces).unwrap();
    for method in [Method::Published, Method::Refined] {
        let (a, b) = (fit(&blob(), mesh.clone(), method), fit(&blob(), renumbered.clone(), method));
        let change = largest_distance(&nets(&a), &nets(&b)) / mesh.diagonal();
        assert!(change <= tolerance(method), "{method:?}: {change:e}");
        for edge in mesh.topology().edges() {
            let ends = mesh.topology().edge_vertices(edge).map(|v| VertexId::new(last - v.index()));
            let t = b.mesh.topology();
            let h = t.fan(ends[0]).find(|&h| t.target(h) == ends[1]).unwrap();
            let (p, q) = (a.network.curves()[edge].points, b.network.along(t, h).points);
            let change = p.iter().zip(q).map(|(p, q)| p.distance(q)).fold(0.0, f64::max);
            assert!(
                change <= tolerance(method) * mesh.diagonal(),
                "{method:?} {edge:?}: {change:e}"
            );
        }
    }
}
