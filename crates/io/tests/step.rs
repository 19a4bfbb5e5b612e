//! STEP: references, shared instances, shells and solids.

#![allow(
    clippy::unwrap_used,
    clippy::missing_assert_message,
    reason = "helpers of tests fail like tests"
)]

mod common;

use std::collections::{HashMap, HashSet};

use common::{OCTAHEDRON_CORNERS, Random, bulged, nets_from, octahedron, strip, torus};
use io::basemesh::{FaceMap, Topology, VertexId};
use io::bezier_core::BezierTriangle;
use io::glam::DVec3;
use io::{
    PatchSurface, PatchSurfaceError, Polygon, StepCounts, StepError, StepFaces, StepOptions,
    write_step,
};

/// Instances by number: keyword and the rest.
struct Parsed {
    instances: HashMap<u64, (String, String)>,
    counts: StepCounts,
}

fn written(surface: &PatchSurface, faces: StepFaces) -> Parsed {
    let mut bytes = Vec::new();
    let options = StepOptions { faces, ..StepOptions::default() };
    let counts = write_step(&mut bytes, surface, &options).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.starts_with("ISO-10303-21;\n") && text.ends_with("END-ISO-10303-21;\n"));
    let data = text.split("DATA;\n").nth(1).unwrap().split("ENDSEC;").next().unwrap();
    let mut instances = HashMap::new();
    for line in data.lines() {
        let (number, text) = line.strip_suffix(';').unwrap().split_once('=').unwrap();
        let number: u64 = number[1..].parse().unwrap();
        let open = text.find('(').unwrap();
        let known = instances.insert(number, (text[..open].to_owned(), text[open..].to_owned()));
        assert_eq!(known, None, "two instances {number}");
    }
    Parsed { instances, counts }
}

fn references(text: &str) -> Vec<u64> {
    let numbers = text.split('#').skip(1);
    numbers
        .map(|t| t.split(|c: char| !c.is_ascii_digit()).next().unwrap().parse().unwrap())
        .collect()
}

impl Parsed {
    fn of_kind(&self, kind: &str) -> Vec<(u64, &str)> {
        let of_kind = self.instances.iter().filter(|(_, (name, _))| name == kind);
        of_kind.map(|(&id, (_, text))| (id, text.as_str())).collect()
    }

    fn point(&self, id: u64) -> DVec3 {
        let (kind, text) = &self.instances[&id];
        assert_eq!(kind, "CARTESIAN_POINT");
        let inside = text.strip_prefix("('',(").unwrap().strip_suffix("))").unwrap();
        let numbers: Vec<f64> = inside.split(',').map(|t| t.parse().unwrap()).collect();
        DVec3::from_slice(&numbers)
    }

    /// Every number exists, and every edge is used once in each direction in a closed shell.
    fn check(&self, closed_edges: bool) {
        for (kind, text) in self.instances.values() {
            for id in references(text) {
                assert!(self.instances.contains_key(&id), "{kind} names #{id}");
            }
        }
        let mut uses: HashMap<u64, Vec<bool>> = HashMap::new();
        for (_, text) in self.of_kind("ORIENTED_EDGE") {
            uses.entry(references(text)[0]).or_default().push(text.contains(".T."));
        }
        assert_eq!(uses.len(), self.of_kind("EDGE_CURVE").len(), "edges that no face uses");
        assert_eq!(uses.len(), self.counts.edges);
        assert_eq!(self.of_kind("ADVANCED_FACE").len(), self.counts.faces);
        for (edge, mut directions) in uses {
            directions.sort_unstable();
            let both = directions == [false, true];
            assert!(
                both || (!closed_edges && directions.len() == 1),
                "edge #{edge}: {directions:?}"
            );
        }
        self.check_loops();
    }

    /// The edges of each face follow each other, and their curves end at their vertices.
    fn check_loops(&self) {
        for (_, text) in self.of_kind("EDGE_LOOP") {
            let ends: Vec<[u64; 2]> = references(text)
                .into_iter()
                .map(|oriented| {
                    let text = &self.instances[&oriented].1;
                    let edge = references(text)[0];
                    let [start, end, curve] = references(&self.instances[&edge].1)[..] else {
                        panic!()
                    };
                    let points = references(&self.instances[&curve].1);
                    let at = |vertex: u64| references(&self.instances[&vertex].1)[0];
                    assert_eq!([at(start), at(end)], [points[0], *points.last().unwrap()]);
                    if text.contains(".T.") { [start, end] } else { [end, start] }
                })
                .collect();
            for (side, [_, end]) in ends.iter().enumerate() {
                assert_eq!(*end, ends[(side + 1) % ends.len()][0]);
            }
        }
    }
}

fn random_surface<const P: usize>(topology: &Topology) -> PatchSurface {
    let mut random = Random(5);
    let nets: FaceMap<BezierTriangle<DVec3, P>> = nets_from(topology, || random.point());
    PatchSurface::from_triangles(topology, &nets).unwrap()
}

#[test]
fn closed_surfaces_are_one_solid() {
    for faces in [StepFaces::Quads, StepFaces::Degenerate] {
        for topology in [octahedron(), torus(3)] {
            let parsed = written(&random_surface::<36>(&topology), faces);
            parsed.check(true);
            assert_eq!((parsed.counts.solids, parsed.counts.open_shells), (1, 0));
            assert_eq!(parsed.of_kind("MANIFOLD_SOLID_BREP").len(), 1);
            let (f, e) = (topology.face_count(), topology.edge_count());
            let expected = match faces {
                StepFaces::Quads => (3 * f, 2 * e + 3 * f),
                StepFaces::Degenerate => (f, e),
            };
            assert_eq!((parsed.counts.faces, parsed.counts.edges), expected);
        }
        written(&random_surface::<6>(&octahedron()), faces).check(true);
        written(&random_surface::<3>(&octahedron()), faces).check(true);
    }
}

#[test]
fn points_are_written_once_and_keep_their_bits() {
    let topology = octahedron();
    let surface = random_surface::<36>(&topology);
    let degenerate = written(&surface, StepFaces::Degenerate);
    let all: HashSet<[u64; 3]> = degenerate
        .of_kind("CARTESIAN_POINT")
        .iter()
        .map(|&(id, _)| degenerate.point(id).to_array().map(f64::to_bits))
        .collect();
    // the origin of the axes is one more
    let [v, e, f] = [topology.vertex_count(), topology.edge_count(), topology.face_count()];
    assert_eq!(all.len(), degenerate.of_kind("CARTESIAN_POINT").len());
    assert_eq!(all.len(), 1 + v + 6 * e + 36 * f);
    for edge in 0..surface.edges().len() {
        for point in surface.curve(edge) {
            assert!(all.contains(&point.to_array().map(f64::to_bits)), "{point}");
        }
    }
    let quads = written(&surface, StepFaces::Quads);
    let count = quads.of_kind("CARTESIAN_POINT").len();
    assert_eq!(count, 1 + v + (2 * 6 + 1) * e + (1 + 3 * 6 + 3 * 36) * f);
}

#[test]
fn open_surfaces_are_shells() {
    let parsed = written(&random_surface::<10>(&strip()), StepFaces::Quads);
    parsed.check(false);
    assert_eq!((parsed.counts.solids, parsed.counts.open_shells), (0, 1));
    assert_eq!(parsed.of_kind("SHELL_BASED_SURFACE_MODEL").len(), 1);
}

/// Octahedra around the origin of these sizes; a negative size turns one inside out.
fn octahedra(sizes: &[f64]) -> PatchSurface {
    let topology = octahedron();
    let nets: FaceMap<BezierTriangle<DVec3, 3>> = bulged(&topology, &OCTAHEDRON_CORNERS, |p| p);
    let corners: Vec<_> =
        topology.faces().map(|f| topology.corners(f).map(VertexId::index)).collect();
    let (mut faces, mut points) = (Vec::new(), Vec::new());
    for (copy, &size) in sizes.iter().enumerate() {
        for (face, patch) in nets.iter() {
            let mut order = [0, 1, 2];
            if size < 0.0 {
                order.swap(1, 2);
            }
            faces.push(Polygon::triangle(order.map(|c| corners[face.index()][c] + 6 * copy)));
            points.extend(order.map(|c| patch.net()[c] * size.abs()));
        }
    }
    PatchSurface::new(1, faces, points).unwrap()
}

#[test]
fn inner_shells_are_holes() {
    let parsed = written(&octahedra(&[1.0, -2.0, 4.0, -8.0, 16.0]), StepFaces::Degenerate);
    parsed.check(true);
    // 16 without 8, 4 without 2, and 1
    assert_eq!(parsed.counts.solids, 3);
    assert_eq!(parsed.of_kind("BREP_WITH_VOIDS").len(), 2);
    assert_eq!(parsed.of_kind("MANIFOLD_SOLID_BREP").len(), 1);
    assert_eq!(parsed.of_kind("ORIENTED_CLOSED_SHELL").len(), 2);
}

#[test]
fn quadrilaterals_beside_triangles() {
    // a square and a triangle at its right side
    let corner = |x: f64, y: f64| DVec3::new(x, y, x * y);
    let square = [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0)];
    let triangle = [corner(1.0, 0.0), corner(2.0, 0.5), corner(1.0, 1.0)];
    let faces = vec![Polygon::quad([0, 1, 2, 3]), Polygon::triangle([1, 4, 2])];
    let surface = PatchSurface::new(1, faces, [&square[..], &triangle[..]].concat()).unwrap();
    let parsed = written(&surface, StepFaces::Quads);
    parsed.check(false);
    assert_eq!(parsed.counts.faces, 4);
    // three whole sides, three halved ones, three inside
    assert_eq!(parsed.counts.edges, 3 + 6 + 3);
    written(&surface, StepFaces::Degenerate).check(false);
}

#[test]
fn what_is_no_shell_is_refused() {
    let flat = |corners: [usize; 3]| corners.map(|c| DVec3::new(c as f64, (c * c) as f64, 0.0));
    let surface = |faces: &[[usize; 3]]| {
        let points = faces.iter().flat_map(|&face| flat(face)).collect();
        PatchSurface::new(1, faces.iter().copied().map(Polygon::triangle).collect(), points)
    };
    let refused = |surface: &PatchSurface| {
        let mut bytes = Vec::new();
        let error = write_step(&mut bytes, surface, &StepOptions::default()).unwrap_err();
        assert_eq!(bytes, [0; 0]);
        error.to_string()
    };
    let three = surface(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]).unwrap();
    assert!(refused(&three).starts_with("edge 0-1 belongs to 3 faces"), "{}", refused(&three));
    let turned = surface(&[[0, 1, 2], [0, 1, 3]]).unwrap();
    assert!(
        refused(&turned).starts_with("faces 0 and 1 are turned against each other at edge 0-1")
    );
    let none = PatchSurface::new(2, Vec::new(), Vec::new()).unwrap();
    let error = write_step(&mut Vec::new(), &none, &StepOptions::default()).unwrap_err();
    assert!(matches!(error, StepError::NoFaces));
}

#[test]
fn surfaces_that_do_not_fit_are_refused_with_their_faces() {
    let faces = || vec![Polygon::triangle([0, 1, 2]), Polygon::triangle([2, 1, 3])];
    let mut points: Vec<DVec3> = [[0, 0], [1, 0], [0, 1], [0, 1], [1, 0], [1, 1]]
        .map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), 0.0))
        .into();
    PatchSurface::new(1, faces(), points.clone()).unwrap();
    points[4].z = f64::EPSILON;
    let error = PatchSurface::new(1, faces(), points.clone()).unwrap_err();
    let expected =
        matches!(error, PatchSurfaceError::Edge { lower: 1, higher: 2, faces: [0, 1], .. });
    assert!(expected, "{error}");
    points[5].x = f64::NAN;
    let error = PatchSurface::new(1, faces(), points).unwrap_err();
    assert_eq!(error.to_string(), "control point 2 of face 1 is [NaN, 1, 0], which is not finite");
}
