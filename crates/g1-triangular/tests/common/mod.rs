//! A twisted network of curves over arbitrary second-order data: no surface has it.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]
#![allow(dead_code, reason = "each test file uses a part")]

use g1_triangular::basemesh::{EdgeMap, Foot, SurfaceTarget, TriMesh, VertexId, VertexMap};
use g1_triangular::bezier_core::glam::{DMat3, DVec3};
use g1_triangular::bezier_core::{QuarticCurve, SurfaceJet};
use g1_triangular::{CurveNetwork, Plan, Settings, SmoothPatches, fill, join};
use testkit::meshes::{icosphere, jittered};

/// The unit sphere: something to fit the free points to.
pub(crate) struct UnitSphere;

impl SurfaceTarget for UnitSphere {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let normal = near.try_normalize()?;
        Some(Foot { point: normal, normal })
    }
}

/// Numbers in [-1, 1] without pattern.
pub(crate) fn spread(index: usize, which: usize) -> f64 {
    let steps = [0.819_172_513_396_164, 0.671_043_606_703_789, 0.549_700_477_901_970];
    2.0 * (steps[which % 3] * (index + 1) as f64 + 0.37 * which as f64).fract() - 1.0
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

pub(crate) struct Twisted {
    pub(crate) mesh: TriMesh,
    pub(crate) jets: VertexMap<SurfaceJet>,
    pub(crate) network: CurveNetwork,
}

/// Tilted normals, arbitrary forms, end tangents turned in their tangent planes by up to `turn`
/// radians, middle points moved aside.
pub(crate) fn twisted(turn: f64) -> Twisted {
    let mesh = jittered(&icosphere(1), 0.1, 3);
    let jets = mesh.positions().map(|vertex, &point| {
        let value = |which| spread(vertex.index(), which);
        let tilt = DVec3::new(value(0), value(1), value(2)) * 0.06;
        let normal = (point + tilt).normalize();
        let (u, v) = normal.any_orthonormal_pair();
        let form = outer(u, u) * value(3)
            + (outer(u, v) + outer(v, u)) * value(4)
            + outer(v, v) * value(5);
        SurfaceJet { point, normal, second_fundamental_form: form }
    });
    let curves = EdgeMap::from_fn(mesh.topology().edge_count(), |edge| {
        let ends = mesh.topology().edge_vertices(edge);
        let value = |which| spread(edge.index(), which);
        twisted_curve(&jets, ends, [turn * value(0), turn * value(1)], value(2))
    });
    Twisted { network: CurveNetwork::new(curves), mesh, jets }
}

/// A quartic with the given data at both ends and otherwise as arbitrary as they allow.
fn twisted_curve(
    jets: &VertexMap<SurfaceJet>,
    ends: [VertexId; 2],
    turns: [f64; 2],
    aside: f64,
) -> QuarticCurve {
    let [start, end] = ends.map(|v| jets[v]);
    let chord = end.point - start.point;
    let tangent = |jet: &SurfaceJet, into: DVec3, turn: f64| {
        let along = jet.tangential(into).normalize();
        (along * turn.cos() + jet.normal.cross(along) * turn.sin()) * (0.28 * chord.length())
    };
    let (d0, d1) = (tangent(&start, chord, turns[0]), tangent(&end, -chord, turns[1]));
    // q2 = free + a N0 + b N1 with (q2 - q0)·N0 = 4/3 II(d0, d0), and the same at the end
    let sideways = start.normal.cross(chord) * (0.1 * aside);
    let free = (start.point + end.point) * 0.5 + sideways;
    let wanted = [(start, d0), (end, d1)]
        .map(|(jet, d)| 4.0 / 3.0 * jet.second_form(d, d) - (free - jet.point).dot(jet.normal));
    let cosine = start.normal.dot(end.normal);
    let det = 1.0 - cosine * cosine;
    let a = (wanted[0] - cosine * wanted[1]) / det;
    let b = (wanted[1] - cosine * wanted[0]) / det;
    let q2 = free + start.normal * a + end.normal * b;
    QuarticCurve::new([start.point, start.point + d0, q2, end.point + d1, end.point])
}

impl Twisted {
    pub(crate) fn plan(&self, settings: Settings) -> Plan {
        Plan::uniform(self.mesh.topology(), settings)
    }

    pub(crate) fn construct(&self, plan: &Plan) -> SmoothPatches {
        let positional = fill(&self.mesh, &self.network, &UnitSphere, plan);
        join(&self.mesh, &self.jets, &self.network, positional.nets, &UnitSphere, plan).unwrap()
    }
}
