//! Surfaces that a net can represent are filled without error.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use g1_triangular::basemesh::{EdgeMap, Foot, SurfaceTarget, TriMesh};
use g1_triangular::bezier_core::glam::DVec3;
use g1_triangular::bezier_core::{Barycentric, BezierCurve};
use g1_triangular::{CurveNetwork, Fill, InnerPoints, Plan, Rows, Settings, fill};

/// The graph `z = h(x, y)` of a polynomial of degree two; feet are found straight above.
struct Graph {
    /// Coefficients of 1, x, y, x², xy, y².
    coefficients: [f64; 6],
}

impl Graph {
    fn lift(&self, x: f64, y: f64) -> DVec3 {
        let [c, cx, cy, cxx, cxy, cyy] = self.coefficients;
        DVec3::new(x, y, c + cx * x + cy * y + cxx * x * x + cxy * x * y + cyy * y * y)
    }
}

impl SurfaceTarget for Graph {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let [_, cx, cy, cxx, cxy, cyy] = self.coefficients;
        let slope_x = cx + 2.0 * cxx * near.x + cxy * near.y;
        let slope_y = cy + cxy * near.x + 2.0 * cyy * near.y;
        let normal = DVec3::new(-slope_x, -slope_y, 1.0).normalize();
        Some(Foot { point: self.lift(near.x, near.y), normal })
    }
}

/// A hexagon of six irregular triangles on the graph, with its exact boundary parabolas.
fn hexagon(graph: &Graph) -> (TriMesh, CurveNetwork) {
    let rim = (0..6).map(|i| {
        let angle = f64::from(i) + 0.2 * f64::from(i * i % 3);
        let radius = 1.0 + 0.2 * f64::from(i % 2);
        graph.lift(radius * angle.cos(), radius * angle.sin())
    });
    let positions: Vec<DVec3> = std::iter::once(graph.lift(0.1, -0.05)).chain(rim).collect();
    let faces: Vec<[usize; 3]> = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]).collect();
    let mesh = TriMesh::new(positions, &faces).unwrap();
    let t = mesh.topology();
    let curves = EdgeMap::from_fn(t.edge_count(), |edge| {
        let h = t.canonical(edge);
        let [a, b] = [t.origin(h), t.target(h)].map(|v| mesh.position(v));
        let middle = (a + b) * 0.5;
        let on_graph = graph.lift(middle.x, middle.y);
        BezierCurve::new([a, on_graph * 2.0 - middle, b]).elevate_to()
    });
    let network = CurveNetwork::new(curves);
    (mesh, network)
}

#[test]
fn planes_and_quadratic_graphs() {
    let graphs = [[0.3, 0.1, -0.2, 0.0, 0.0, 0.0], [0.1, 0.2, 0.0, 0.4, -0.3, -0.2]];
    for coefficients in graphs {
        let graph = Graph { coefficients };
        let (mesh, network) = hexagon(&graph);
        for kind in [Fill::Septic, Fill::Quartic] {
            let settings =
                Settings { fill: kind, rows: Rows::Nearest, inner_points: InnerPoints::Keep };
            let plan = Plan::uniform(mesh.topology(), settings);
            let filled = fill(&mesh, &network, &graph, &plan);
            assert!(filled.failed_feet.as_slice().iter().all(|&failed| failed == 0));
            for (face, net) in filled.nets.iter() {
                for at in Barycentric::lattice(9) {
                    let p = net.eval(at);
                    let error = p.distance(graph.lift(p.x, p.y));
                    // round-off of a least-squares fit to 55 samples of size one
                    assert!(error <= 1e-13, "{coefficients:?}, {kind:?}, {face}: {error:e}");
                }
            }
        }
    }
}
