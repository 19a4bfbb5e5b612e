//! Vertex systems, edge systems, control points and error figures of an independent implementation
//! of the published scheme, on its own base meshes.

mod common;

use common::{fit, models, numbers, oracle, vectors};
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{EdgeId, FaceId, HalfedgeId, Topology, VertexId};
use smoothpatch::bezier_core::{Corner, LocalEdge, MultiIndex};
use smoothpatch::measure::{continuity, deviation_on_grid};
use smoothpatch::{FieldSource, G1Surface};

const COORDINATES: f64 = 1e-12;

fn assert_points(got: &[DVec3], expected: &[DVec3], what: &str) {
    assert_eq!(got.len(), expected.len(), "{what}");
    let scale = expected.iter().map(|p| p.length()).fold(0.0, f64::max);
    for (i, (g, e)) in got.iter().zip(expected).enumerate() {
        let distance = g.distance(*e) / scale;
        assert!(distance <= COORDINATES, "{what} {i}: {g} for {e}, off by {distance:e}");
    }
}

fn assert_numbers(got: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(got.len(), expected.len(), "{what}");
    for (i, (g, e)) in got.iter().zip(expected).enumerate() {
        assert!((g - e).abs() <= tolerance * e.abs().max(1.0), "{what} {i}: {g} for {e}");
    }
}

/// The half-edge from `a` to `b`.
fn halfedge(topology: &Topology, a: usize, b: usize) -> HalfedgeId {
    topology
        .fan(VertexId::new(a))
        .find(|&h| topology.target(h) == VertexId::new(b))
        .unwrap_or_else(|| panic!("{a}-{b} is an edge"))
}

/// First inner row of the face of `h` along it.
fn row(surface: &G1Surface, h: HalfedgeId) -> [DVec3; 7] {
    let edge = LocalEdge::starting_at(Corner::ALL[h.corner()]);
    surface.patches.nets[h.face()].first_inner_row(edge)
}

/// Weight coefficients at the origin of `h`: λ0, λ1, μ0, μ1.
fn weights(surface: &G1Surface, h: HalfedgeId) -> [f64; 4] {
    let topology = surface.mesh.topology();
    let edge = topology.edge(h);
    let w = surface.patches.weights[edge];
    if topology.canonical(edge) == h {
        [w.lambda[0], w.lambda[1], w.mu[0], w.mu[1]]
    } else {
        [1.0 - w.lambda[1], 1.0 - w.lambda[0], 1.0 - w.mu[4], 1.0 - w.mu[3]]
    }
}

#[test]
fn vertex_systems_agree() {
    let oracle = oracle();
    for (model, field, mesh) in models() {
        let surface = fit(&*field, mesh);
        let topology = surface.mesh.topology();
        for vertex in oracle[model]["vertices"].as_array().unwrap() {
            let v = usize::try_from(vertex["vertex"].as_u64().unwrap()).unwrap();
            let what = format!("{model} vertex {v}");
            let fan: Vec<HalfedgeId> = vertex["neighbours_ccw"]
                .as_array()
                .unwrap()
                .iter()
                .map(|n| halfedge(topology, v, usize::try_from(n.as_u64().unwrap()).unwrap()))
                .collect();
            let [lam0, lam1, mu0, mu1] = [0, 1, 2, 3]
                .map(|i| fan.iter().map(|&h| weights(&surface, h)[i]).collect::<Vec<f64>>());
            assert_numbers(&lam0, &numbers(&vertex["lam0"]), COORDINATES, &what);
            assert_numbers(&lam1, &numbers(&vertex["lam1"]), COORDINATES, &what);
            assert_numbers(&mu0, &numbers(&vertex["mu0"]), COORDINATES, &what);
            assert_numbers(&mu1, &numbers(&vertex["mu1"]), 1e-11, &what);
            let twists: Vec<DVec3> = fan.iter().map(|&h| row(&surface, h)[1]).collect();
            assert_points(&twists, &vectors(&vertex["t_solution_exact_normal"]), &what);
        }
    }
}

#[test]
fn edge_systems_agree() {
    let oracle = oracle();
    for (model, field, mesh) in models() {
        let surface = fit(&*field, mesh);
        let system = &oracle[model]["edge_system"];
        let index = |key: &str| usize::try_from(system[key].as_u64().unwrap()).unwrap();
        let topology = surface.mesh.topology();
        let h = halfedge(topology, index("a"), index("b"));
        let w = topology.twin(h).unwrap();
        assert_eq!(h.face(), FaceId::new(index("left_face")));
        let p = row(&surface, h);
        let mut r = row(&surface, w);
        r.reverse();
        let known = |x: [DVec3; 7]| [x[0], x[1], x[5], x[6]];
        assert_points(&known(p), &vectors(&system["p_known_0_1_5_6"]), "known p");
        assert_points(&known(r), &vectors(&system["r_known_0_1_5_6"]), "known r");
        assert_points(
            &[p[2], r[2], p[3], r[3], p[4], r[4]],
            &vectors(&system["x_solution"]),
            &format!("{model} edge system"),
        );
        let edge: EdgeId = topology.edge(h);
        let mu2 = surface.patches.weights[edge].mu[2];
        let mu2 = if topology.canonical(edge) == h { mu2 } else { 1.0 - mu2 };
        let expected = system["mu2"].as_f64().unwrap();
        assert!((mu2 - expected).abs() <= 1e-11, "{model}: mu2 {mu2} for {expected}");
    }
}

#[test]
fn control_points_agree() {
    let oracle = oracle();
    for (model, field, mesh) in models() {
        let surface = fit(&*field, mesh);
        let order: Vec<MultiIndex> = oracle[model]["control_point_order"]
            .as_array()
            .unwrap()
            .iter()
            .map(|m| {
                let [i, j, k] = [0, 1, 2].map(|c| usize::try_from(m[c].as_u64().unwrap()).unwrap());
                MultiIndex::new(i, j, k)
            })
            .collect();
        let net = &surface.patches.nets[FaceId::new(0)];
        let got: Vec<DVec3> = order.iter().map(|&m| net[m]).collect();
        assert_points(&got, &vectors(&oracle[model]["patch0_control_points_G1"]), model);
    }
}

#[test]
fn error_figures_agree() {
    let oracle = oracle();
    for (model, field, mesh) in models() {
        let surface = fit(&*field, mesh);
        let diagonal = surface.mesh.diagonal();
        let source = FieldSource::new(&*field, diagonal, Default::default());
        let measured = deviation_on_grid(&surface.patches.nets, &source, diagonal);
        let expected = &oracle[model]["errors"]["G1_exact_normal_twist"];
        for (got, key) in [
            (measured.max, "max_rel"),
            (measured.rms, "rms_rel"),
            (measured.max_normal_deg, "max_normal_deg"),
            (measured.rms_normal_deg, "rms_normal_deg"),
        ] {
            let expected = expected[key].as_f64().unwrap();
            assert!((got / expected - 1.0).abs() <= 1e-3, "{model} {key}: {got} for {expected}");
        }
        assert_eq!(measured.folded, Vec::<usize>::new(), "{model}");
        let joined = continuity(surface.mesh.topology(), &surface.patches.nets);
        assert!(joined.g1_angle_deg <= 1e-9, "{model}: {} degrees", joined.g1_angle_deg);
        assert!(surface.max_row_residual() <= 1e-13, "{model}: {}", surface.max_row_residual());
        let iterations = oracle[model]["sqp_average_iterations"]["lsq_guess_rel_1e-6"].as_f64();
        let measured = surface.curve_summary();
        assert!((measured.mean_iterations - iterations.unwrap()).abs() <= 1e-9, "{measured:?}");
        assert_eq!(measured.fallbacks, 0, "{model}");
    }
}
