//! One function, continuous with its gradient; one sheet; a closed surface.
#![allow(clippy::print_stdout, reason = "figures, for runs with --nocapture")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use std::collections::BTreeMap;

use apatch::basemesh::{EdgeId, HalfedgeId};
use apatch::glam::DVec3;
use apatch::rational::{Normals, RationalSurface, Side, loop_limit_normals};
use apatch::{Ray, Tessellation};
use common::{Numbers, surface, zoo};

/// Largest jumps of value and gradient relative to their sizes.
#[derive(Debug, Default)]
struct Jumps {
    value: f64,
    gradient: f64,
    compared: usize,
}

impl Jumps {
    fn compare(&mut self, a: (f64, DVec3), b: (f64, DVec3), scale: f64) {
        self.value = self.value.max((a.0 - b.0).abs() / scale);
        self.gradient = self.gradient.max(a.1.distance(b.1) / a.1.length().max(b.1.length()));
        self.compared += 1;
    }
}

/// Compares both sides of every common triangle (and edge) of the tetrahedra.
fn jumps(surface: &RationalSurface, samples: usize) -> Jumps {
    let topology = surface.mesh().topology();
    let mut numbers = Numbers::new(7);
    let mut jumps = Jumps::default();
    for face in topology.faces() {
        let patch = surface.face(face);
        let [Some(up), Some(_)] = &patch.sides else { continue };
        for _ in 0..samples {
            let [a, b, c] = numbers.weights();
            let [p, q] = Side::BOTH.map(|s| surface.face_value(face, s, [a, b, c, 0.0]).unwrap());
            jumps.compare(p, q, up.scale());
        }
    }
    for edge in topology.edges() {
        for side in Side::BOTH {
            if surface.edge_tetrahedron(edge, side).is_some() {
                across_sides(surface, edge, side, samples, &mut numbers, &mut jumps);
            }
        }
        across_edge(surface, edge, samples, &mut numbers, &mut jumps);
    }
    jumps
}

/// The tetrahedron of an edge against those of its faces.
fn across_sides(
    surface: &RationalSurface,
    edge: EdgeId,
    side: Side,
    samples: usize,
    numbers: &mut Numbers,
    jumps: &mut Jumps,
) {
    let topology = surface.mesh().topology();
    let canonical = topology.canonical(edge);
    let twin = topology.twin(canonical).unwrap();
    let mut one = |h: HalfedgeId, is_left: bool| {
        let face = h.face();
        let scale = surface.face(face).sides[side.index()].as_ref().unwrap().scale();
        for _ in 0..samples {
            let [i, j, apex] = numbers.weights();
            let in_edge = if is_left { [0.0, i, j, apex] } else { [apex, i, j, 0.0] };
            let mut in_face = [0.0, 0.0, 0.0, apex];
            let [start, end] = [h.corner(), h.next().corner()];
            (in_face[start], in_face[end]) = if is_left { (i, j) } else { (j, i) };
            let a = surface.edge_value(edge, side, in_edge).unwrap();
            let b = surface.face_value(face, side, in_face).unwrap();
            jumps.compare(a, b, scale);
        }
    };
    one(canonical, true);
    one(twin, false);
}

/// All tetrahedra at the points of an edge.
fn across_edge(
    surface: &RationalSurface,
    edge: EdgeId,
    samples: usize,
    numbers: &mut Numbers,
    jumps: &mut Jumps,
) {
    let topology = surface.mesh().topology();
    let canonical = topology.canonical(edge);
    for _ in 0..samples {
        let x = numbers.unit();
        let mut all = Vec::new();
        let mut scale = 0.0_f64;
        for (h, at) in [(Some(canonical), x), (topology.twin(canonical), 1.0 - x)] {
            let Some(h) = h else { continue };
            let mut bary = [0.0; 4];
            (bary[h.corner()], bary[h.next().corner()]) = (at, 1.0 - at);
            for side in Side::BOTH {
                all.extend(surface.face_value(h.face(), side, bary));
                let sides = &surface.face(h.face()).sides;
                scale = sides.iter().flatten().fold(scale, |m, s| m.max(s.scale()));
            }
        }
        for side in Side::BOTH {
            all.extend(surface.edge_value(edge, side, [0.0, x, 1.0 - x, 0.0]));
        }
        all.windows(2).for_each(|w| jumps.compare(w[0], w[1], scale));
    }
}

/// Given normals, some apices moved off the normal through the centroid.
fn moved_apices() -> RationalSurface {
    let mesh = common::noisy_sphere(0.2, 1);
    let normals = Normals::Given(loop_limit_normals(&mesh));
    let surface = surface(&mesh, normals);
    assert!(surface.report().moved_apices > 5, "{:?}", surface.report());
    surface
}

#[test]
fn value_and_gradient_are_continuous() {
    let moved = ("moved apices".to_owned(), moved_apices());
    for (name, surface) in zoo().into_iter().chain([moved]) {
        let jumps = jumps(&surface, 12);
        println!("{name}: {jumps:?}");
        assert!(jumps.compared > 40, "{name}: only {} comparisons", jumps.compared);
        assert!(jumps.value <= 1e-13, "{name}: {jumps:?}");
        assert!(jumps.gradient <= 1e-12, "{name}: {jumps:?}");
    }
}

#[test]
fn one_sheet_on_dense_grids() {
    for (name, surface) in zoo() {
        let (bad, all) = surface.count_bad_transversals(40);
        println!("{name}: {bad} of {all}");
        assert!(surface.report().is_clean(), "{name}: {:?}", surface.report());
        assert!(all > 500 && bad == 0, "{name}: {bad} of {all} transversals");
    }
}

/// Vertices minus edges plus triangles, and the number of edges with one triangle.
fn topology_of(mesh: &Tessellation) -> (i64, usize) {
    let mut edges: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    let mut used = vec![false; mesh.positions.len()];
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            used[a] = true;
            *edges.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    assert!(edges.values().all(|&n| n <= 2), "an edge with more than two triangles");
    let vertices = used.iter().filter(|u| **u).count();
    let count = |n: usize| i64::try_from(n).unwrap();
    let euler = count(vertices) - count(edges.len()) + count(mesh.triangles.len());
    (euler, edges.values().filter(|n| **n == 1).count())
}

/// Whether a triangle faces away from the normals at all its corners.
fn is_turned(mesh: &Tessellation, triangle: &[usize; 3]) -> bool {
    let [a, b, c] = triangle.map(|i| mesh.positions[i]);
    let normal = (b - a).cross(c - a);
    triangle.iter().all(|&i| normal.dot(mesh.normals[i]) < 0.0)
}

#[test]
fn tessellations_have_the_topology_of_the_mesh() {
    for (name, surface) in zoo() {
        for (n, m) in [(1, 1), (2, 3), (6, 4)] {
            let mesh = surface.tessellate(n, m);
            let (euler, rim) = topology_of(&mesh);
            let base = surface.mesh().topology();
            assert_eq!(mesh.missing, 0, "{name} {n} {m}");
            assert_eq!(euler, base.euler_characteristic(), "{name} {n} {m}");
            let turned = mesh.triangles.iter().filter(|t| is_turned(&mesh, t)).count();
            assert_eq!(turned, 0, "{name} {n} {m}: triangles that face the other way");
            let open = base.edges().filter(|&e| base.is_boundary_edge(e)).count();
            assert_eq!(rim, open * n, "{name} {n} {m}");
            assert!(
                mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-12),
                "{name}: normals"
            );
        }
    }
}

#[test]
fn patches_have_the_same_normals_where_they_meet() {
    for (name, surface) in zoo() {
        let topology = surface.mesh().topology();
        let (mut worst, mut gap) = (0.0_f64, 0.0_f64);
        for edge in topology.edges() {
            let patch = surface.edge(edge);
            if patch.sides.iter().all(Option::is_none) {
                continue;
            }
            let h = topology.canonical(edge);
            for s in 1..10 {
                let x = f64::from(s) / 10.0;
                for (h, at, y) in [(h, x, 1.0), (topology.twin(h).unwrap(), 1.0 - x, 0.0)] {
                    let mut bary = [0.0; 3];
                    (bary[h.corner()], bary[h.next().corner()]) = (at, 1.0 - at);
                    let a = surface.face_point(h.face(), bary).unwrap();
                    let b = surface.edge_point(edge, [x, y]).unwrap();
                    gap = gap.max(a.point.distance(b.point));
                    worst = worst.max(a.normal().cross(b.normal()).length());
                }
            }
        }
        println!("{name}: normals {worst:e} gap {gap:e}");
        assert!(worst <= 1e-10, "{name}: normals differ by {worst:e}");
        assert!(gap <= 1e-13 * surface.mesh().diagonal(), "{name}: gap {gap:e}");
    }
}

/// Points found together are those found one by one, bit for bit, whatever their number.
#[test]
fn points_together_and_one_by_one() {
    for (name, surface) in zoo() {
        let topology = surface.mesh().topology();
        let mut numbers = Numbers::new(11);
        let mut found = Vec::new();
        for face in topology.faces() {
            // corners, points of edges, and a number of points that differs from face to face
            let mut at = vec![[1.0, 0.0, 0.0], [0.0, 0.5, 0.5], [0.2, 0.3, 0.5]];
            at.extend((0..face.index() % 20).map(|_| numbers.weights::<3>()));
            found.clear();
            surface.face(face).points(&at, &mut found);
            let alone: Vec<_> = at.iter().map(|&x| surface.face_point(face, x)).collect();
            assert_eq!(found, alone, "{name} face {face}");
        }
        for edge in topology.edges() {
            let mut at = vec![[0.0, 0.5], [1.0, 0.0], [0.3, 1.0], [0.6, 0.2]];
            at.extend((0..edge.index() % 20).map(|_| [numbers.unit(), numbers.unit()]));
            found.clear();
            surface.edge(edge).points(&at, &mut found);
            let alone: Vec<_> = at.iter().map(|&x| surface.edge_point(edge, x)).collect();
            assert_eq!(found, alone, "{name} edge {edge}");
        }
    }
}

#[test]
fn rays_meet_the_surface_where_it_is() {
    let mesh = testkit::meshes::icosphere(0);
    let sphere = surface(&mesh, common::given(&mesh, |p| 2.0 * p));
    let hull = sphere.hull();
    let mut numbers = Numbers::new(3);
    for _ in 0..300 {
        let mut vector = || DVec3::new(numbers.signed(), numbers.signed(), numbers.signed());
        let (origin, target) = (vector().normalize() * 3.0, vector() * 0.5);
        let ray = Ray { origin, direction: target - origin };
        let hit = hull.cast(&ray).unwrap();
        // the nearer root of |origin + s direction| = 1
        let (a, b) = (ray.direction.length_squared(), ray.origin.dot(ray.direction));
        let expected = (-b - (b * b - a * 8.0).sqrt()) / a;
        assert!((hit.distance - expected).abs() < 1e-9, "{} is not {expected}", hit.distance);
        assert!(hit.gradient.normalize().distance(hit.point) < 1e-8, "{hit:?}");
        let away = Ray { origin, direction: origin };
        assert!(hull.cast(&away).is_none(), "a ray that leaves");
    }
}

/// Rays along normals through known points meet them.
#[test]
fn rays_meet_every_kind_of_patch() {
    for (name, surface) in zoo() {
        let hull = surface.hull();
        let mesh = surface.tessellate(5, 3);
        let (mut missed, mut all) = (0, 0);
        let size = surface.mesh().diagonal();
        for triangle in mesh.triangles.iter().step_by(1 + mesh.triangles.len() / 500) {
            let [a, n] = [mesh.positions[triangle[0]], mesh.normals[triangle[0]]];
            let ray = Ray { origin: a + n * (1e-3 * size), direction: -n };
            let near = |d: f64| (d - 1e-3 * size).abs() < 1e-7 * size;
            all += 1;
            missed += usize::from(hull.cast(&ray).is_none_or(|hit| !near(hit.distance)));
        }
        println!("{name}: {missed} of {all} missed");
        // open surfaces lose rays through their rims
        let rim = if surface.mesh().topology().is_closed() { 0 } else { all / 2 };
        assert!(missed <= rim, "{name}: {missed} of {all} rays missed");
    }
}

/// Tetrahedra overlap at edges that have none themselves, which does the surface no harm.
const OVERLAPPING: [&str; 2] = ["double torus", "noisy sphere"];

#[test]
fn points_of_the_surface_are_zeros_found_by_location() {
    for (name, surface) in zoo() {
        let hull = surface.hull();
        let mesh = surface.tessellate(3, 2);
        let (mut outside, mut worst) = (0, 0.0_f64);
        for (&p, &n) in mesh.positions.iter().zip(&mesh.normals) {
            match hull.locate(p) {
                None => outside += 1,
                Some(found) => {
                    worst = worst.max((found.value / found.gradient.length()).abs());
                    worst = worst.max(found.gradient.normalize().cross(n).length() * 1e-3);
                }
            }
        }
        println!("{name}: {outside} outside, {worst:e}");
        // where the hull overlaps, which tetrahedron holds a point is ambiguous
        if OVERLAPPING.contains(&&*name) {
            continue;
        }
        assert!(worst <= 1e-12 * surface.mesh().diagonal(), "{name}: {worst:e}");
        let flat = surface.report().faces.zero > 0;
        assert!(flat || outside <= mesh.positions.len() / 50, "{name}: {outside} points outside");
    }
}
