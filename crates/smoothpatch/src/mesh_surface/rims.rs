//! Curves along sharp edges, and the normals of the faces beside them.
//!
//! A sharp edge has one curve, found from the mesh alone, which both sides take as it is. At a vertex the
//! curves of two sharp edges that go on in about the same direction have a common tangent; other curves
//! end like circles, or straight. The normal of each sector of faces is across the tangents at its sides.

use basemesh::glam::DVec3;
use basemesh::{EdgeId, EdgeMap, HalfedgeId, TriMesh, VertexId, VertexMap};
use bezier_core::{BezierCurve, QuarticCurve};

/// Two sharp edges that turn by less than this at their vertex are one curve. Unit: radians.
const SAME_CURVE: f64 = std::f64::consts::FRAC_PI_4;
/// Tangents that differ by less than the arcus sine of this are parallel.
const PARALLEL: f64 = 1e-9;

/// The curves of the sharp edges of a mesh, along their canonical half-edges.
pub(crate) struct Rims {
    pub(crate) curves: EdgeMap<Option<QuarticCurve>>,
}

impl Rims {
    pub(crate) fn new(mesh: &TriMesh, sharp: &EdgeMap<bool>) -> Self {
        let topology = mesh.topology();
        let mut at = VertexMap::from_vec(vec![Vec::new(); topology.vertex_count()]);
        for edge in topology.edges().filter(|&edge| sharp[edge]) {
            topology.edge_vertices(edge).iter().for_each(|&v| at[v].push(edge));
        }
        let through = at.map(|v, edges| tangents_through(mesh, v, edges));
        let curves = EdgeMap::from_fn(topology.edge_count(), |edge| {
            sharp[edge].then(|| curve(mesh, edge, &through))
        });
        Self { curves }
    }

    /// Direction of the curve of a half-edge at its start.
    fn direction(&self, mesh: &TriMesh, h: HalfedgeId, from_end: bool) -> Option<DVec3> {
        let edge = mesh.topology().edge(h);
        let q = self.curves[edge]?.points;
        let forward = mesh.topology().canonical(edge) == h;
        let step = if forward == from_end { q[3] - q[4] } else { q[1] - q[0] };
        step.try_normalize()
    }

    /// The normal of a sector of faces that begins with the half-edge `first`, which leaves the vertex, and
    /// ends with `last`, which arrives: across both curves, otherwise as close as possible to `mean`.
    pub(crate) fn normal(
        &self,
        mesh: &TriMesh,
        [first, last]: [HalfedgeId; 2],
        mean: DVec3,
    ) -> Option<DVec3> {
        let a = self.direction(mesh, first, false)?;
        let b = self.direction(mesh, last, true)?;
        let across = a.cross(b);
        if across.length() > PARALLEL {
            let across = across.normalize();
            return Some(if across.dot(mean) < 0.0 { -across } else { across });
        }
        (mean - a * a.dot(mean)).try_normalize()
    }
}

/// Tangents at a vertex by edge, away from it, of those sharp edges that go on as one curve.
fn tangents_through(mesh: &TriMesh, vertex: VertexId, edges: &[EdgeId]) -> Vec<(EdgeId, DVec3)> {
    let offset = |edge: EdgeId| {
        let [a, b] = mesh.topology().edge_vertices(edge);
        mesh.position(if a == vertex { b } else { a }) - mesh.position(vertex)
    };
    let pairs =
        edges.iter().enumerate().flat_map(|(k, &a)| edges[k + 1..].iter().map(move |&b| (a, b)));
    let turning = |(a, b): (EdgeId, EdgeId)| (-offset(a)).angle_between(offset(b));
    let straightest = pairs.map(|pair| (turning(pair), pair)).min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, (a, b))) = straightest.filter(|(turn, _)| *turn < SAME_CURVE) else {
        return Vec::new();
    };
    // the tangent of the circle through both neighbours
    let (p, q) = (offset(a), offset(b));
    let tangent = q * p.length_squared() - p * q.length_squared();
    tangent.try_normalize().map_or(Vec::new(), |t| vec![(a, -t), (b, t)])
}

/// The cubic with these tangents, which is an arc where they allow it; without one, the curve ends as a
/// circle does.
fn curve(mesh: &TriMesh, edge: EdgeId, through: &VertexMap<Vec<(EdgeId, DVec3)>>) -> QuarticCurve {
    let ends = mesh.topology().edge_vertices(edge);
    let [p, q] = ends.map(|v| mesh.position(v));
    let chord = q - p;
    let length = chord.length();
    let direction = chord.normalize_or_zero();
    let known = ends.map(|v| through[v].iter().find(|(e, _)| *e == edge).map(|&(_, t)| t));
    let mirrored = |t: DVec3| t - direction * (2.0 * t.dot(direction));
    let tangents = match known {
        [Some(a), Some(b)] => [a, b],
        [Some(a), None] => [a, mirrored(a)],
        [None, Some(b)] => [mirrored(b), b],
        [None, None] => [direction, -direction],
    };
    let handle =
        |t: DVec3, along: DVec3| t * (length * 2.0 / (3.0 * (1.0 + t.dot(along).max(0.0))));
    let inner = [p + handle(tangents[0], direction), q + handle(tangents[1], -direction)];
    BezierCurve::<DVec3, 4>::new([p, inner[0], inner[1], q]).elevate_to()
}
