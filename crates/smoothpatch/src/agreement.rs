//! Second fundamental forms with which both ends of an edge can be met.
//!
//! A quartic curve has one middle control point, which must satisfy the curvature conditions of both its
//! ends, `4 II(d, d) = 3 (q2 - q0)·N`. Where the normals at both ends are nearly parallel and the forms ask
//! for different heights of it, the curve can only turn and stretch its end tangents: it waves. There are
//! about as many edges as entries of forms, so that small changes of the forms remove these contradictions:
//!
//! ```text
//! minimise  Σ_edges gᵀ (G + ε)⁻¹ g + w Σ_vertices (L |change|)²,
//! ```
//!
//! `g` the defects of both conditions for the cubic through positions and normals, in chord lengths, and `G`
//! the Gram matrix of both normals: without `ε` the first term is the square of the distance by which the
//! middle point would have to move.

use basemesh::glam::{DMat3, DVec3};
use basemesh::{EdgeId, EdgeMap, TriMesh, VertexId, VertexMap};
use bezier_core::SurfaceJet;
use hermite_sqp::EdgeOutcome;

/// `ε`: normals that differ by less than 8° count as parallel.
const PARALLEL: f64 = 1e-2;
/// `w`.
const INERTIA: f64 = 1e-2;
/// Forms stay where the middle points of all their edges would have to move by less, in chord lengths.
const AGREEMENT: f64 = 0.01;
/// Conditions that are met up to rounding.
const MET: f64 = 1e-11;
/// Rounds, each with more forms that may change, and sweeps over them.
const ROUNDS: usize = 3;
const SWEEPS: usize = 20;

/// The jets with forms that agree along edges; `emphasis` multiplies what an edge counts.
pub(crate) fn agreeing(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    emphasis: &EdgeMap<f64>,
) -> VertexMap<SurfaceJet> {
    let topology = mesh.topology();
    let edges =
        EdgeMap::from_fn(topology.edge_count(), |edge| Bend::new(mesh, jets, edge, emphasis[edge]));
    let mut forms = VertexMap::from_fn(topology.vertex_count(), |v| Form::new(mesh, jets, v));
    let mut free = vec![false; topology.vertex_count()];
    for _ in 0..ROUNDS {
        for (_, bend) in edges.iter() {
            let Some(bend) = bend else { continue };
            if bend.shift(&forms) > AGREEMENT {
                bend.ends.iter().for_each(|v| free[v.index()] = true);
            }
        }
        for _ in 0..SWEEPS {
            for v in topology.vertices().filter(|v| free[v.index()]) {
                let entries = best_form(mesh, &edges, &forms, v);
                if entries.is_finite() {
                    forms[v].entries = entries;
                }
            }
        }
    }
    jets.map(|v, jet| SurfaceJet { second_fundamental_form: forms[v].changed(jet), ..*jet })
}

/// Edges whose curves miss a curvature condition by more than rounding, in chord lengths: the patches at
/// their ends cannot be exactly smooth.
pub(crate) fn contradicted(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    curves: &EdgeMap<EdgeOutcome>,
) -> Vec<EdgeId> {
    let is_missed = |edge: EdgeId| {
        let [a, b] = mesh.topology().edge_vertices(edge);
        let curve = &curves[edge].curve;
        let defect = |v: VertexId, [q0, q1, q2]: [DVec3; 3]| {
            let (d, s) = (q1 - q0, q2 - q0);
            4.0 * jets[v].second_form(d, d) - 3.0 * s.dot(jets[v].normal)
        };
        let [q0, q1, q2, q3, q4] = curve.points;
        let most = defect(a, [q0, q1, q2]).abs().max(defect(b, [q4, q3, q2]).abs());
        // not a number is missed too
        most.is_nan() || most > MET * q0.distance(q4)
    };
    let topology = mesh.topology();
    // on a boundary there are no conditions
    topology.edges().filter(|&e| !topology.is_boundary_edge(e) && is_missed(e)).collect()
}

/// A second fundamental form by its entries along two axes, `(xx, xy, yy)`.
struct Form {
    axes: [DVec3; 2],
    given: DVec3,
    entries: DVec3,
    /// Mean length of the edges.
    length: f64,
}

impl Form {
    fn new(mesh: &TriMesh, jets: &VertexMap<SurfaceJet>, vertex: VertexId) -> Self {
        let jet = &jets[vertex];
        let (x, y) = jet.normal.any_orthonormal_pair();
        let given = DVec3::new(jet.second_form(x, x), jet.second_form(x, y), jet.second_form(y, y));
        let topology = mesh.topology();
        let (sum, count) = topology.fan(vertex).fold((0.0, 0), |(sum, count), h| {
            (sum + mesh.edge_length(topology.edge(h)), count + 1)
        });
        Self { axes: [x, y], given, entries: given, length: sum / f64::from(count) }
    }

    /// What the entries are multiplied with to give the curvature along a unit tangent.
    fn row(&self, tangent: DVec3) -> DVec3 {
        let [u, v] = self.axes.map(|axis| axis.dot(tangent));
        DVec3::new(u * u, 2.0 * u * v, v * v)
    }

    fn changed(&self, jet: &SurfaceJet) -> DMat3 {
        let change = self.entries - self.given;
        if change == DVec3::ZERO {
            return jet.second_fundamental_form;
        }
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        let [x, y] = self.axes;
        jet.second_fundamental_form
            + outer(x, x) * change.x
            + (outer(x, y) + outer(y, x)) * change.y
            + outer(y, y) * change.z
    }
}

/// The two conditions along an edge.
struct Bend {
    ends: [VertexId; 2],
    /// Unit tangents at both ends, into the edge.
    tangents: [DVec3; 2],
    /// `4 a² L`: what a curvature counts in a condition.
    scales: [f64; 2],
    /// `3 (q2 - q)·N / L`.
    heights: [f64; 2],
    /// Entries of `(G + ε)⁻¹`: on and off the diagonal.
    inverse: [f64; 2],
}

impl Bend {
    fn new(
        mesh: &TriMesh,
        jets: &VertexMap<SurfaceJet>,
        edge: EdgeId,
        emphasis: f64,
    ) -> Option<Self> {
        if mesh.topology().is_boundary_edge(edge) {
            return None;
        }
        let ends = mesh.topology().edge_vertices(edge);
        let [p, q] = ends.map(|v| mesh.position(v));
        let length = p.distance(q);
        let direction = (q - p).try_normalize()?;
        let normals = ends.map(|v| jets[v].normal);
        let along = [direction, -direction];
        let tangent = |k: usize| (along[k] - normals[k] * normals[k].dot(along[k])).try_normalize();
        let tangents = [tangent(0)?, tangent(1)?];
        // handles of the cubic in chord lengths, as on a circle
        let handles = [0, 1].map(|k| 2.0 / (3.0 * (1.0 + tangents[k].dot(along[k]))));
        let [c1, c2] = [0, 1].map(|k| [p, q][k] + tangents[k] * (handles[k] * length));
        let middle = (c1 + c2) * 0.5;
        let heights = [0, 1].map(|k| 3.0 * (middle - [p, q][k]).dot(normals[k]) / length);
        let scales = handles.map(|a| 4.0 * (0.75 * a).powi(2) * length);
        let cosine = normals[0].dot(normals[1]);
        let (diagonal, determinant) = (1.0 + PARALLEL, (1.0 + PARALLEL).powi(2) - cosine * cosine);
        let inverse = [diagonal, -cosine].map(|entry| emphasis * entry / determinant);
        Some(Self { ends, tangents, scales, heights, inverse })
    }

    /// The defect of the condition at one end.
    fn defect(&self, forms: &VertexMap<Form>, end: usize) -> f64 {
        let form = &forms[self.ends[end]];
        self.scales[end] * form.row(self.tangents[end]).dot(form.entries) - self.heights[end]
    }

    /// How far the middle point would have to move, in chord lengths.
    fn shift(&self, forms: &VertexMap<Form>) -> f64 {
        let [a, b] = [0, 1].map(|end| self.defect(forms, end));
        let [diagonal, off] = self.inverse;
        (diagonal * (a * a + b * b) + 2.0 * off * a * b).max(0.0).sqrt() / 3.0
    }
}

/// The entries that minimise the sum while those of all other vertices stay.
fn best_form(
    mesh: &TriMesh,
    edges: &EdgeMap<Option<Bend>>,
    forms: &VertexMap<Form>,
    vertex: VertexId,
) -> DVec3 {
    let topology = mesh.topology();
    let form = &forms[vertex];
    let inertia = DVec3::new(1.0, 2.0, 1.0) * (INERTIA * form.length * form.length);
    let mut matrix = DMat3::from_diagonal(inertia);
    let mut rhs = inertia * form.given;
    for h in topology.fan(vertex) {
        let Some(bend) = &edges[topology.edge(h)] else { continue };
        let end = usize::from(bend.ends[1] == vertex);
        let [diagonal, off] = bend.inverse;
        let row = form.row(bend.tangents[end]) * bend.scales[end];
        let other = bend.defect(forms, 1 - end);
        matrix += DMat3::from_cols(row * row.x, row * row.y, row * row.z) * diagonal;
        rhs += row * (diagonal * bend.heights[end] - off * other);
    }
    matrix.inverse() * rhs
}
