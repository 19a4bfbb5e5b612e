//! Step 2: the weight functions at the vertices.
//!
//! Along a half-edge with left patch row `p`, right patch row `r` and boundary `q`, two patches are
//! tangent-plane continuous if, for a linear `λ` and a quartic `μ` [TK09 (3)],
//!
//! ```text
//! (1 - λ) p + λ r = (1 - μ) q_b + μ q_t,   q_b = Σ q_i B_i³,  q_t = Σ q_{i+1} B_i³ .
//! ```
//!
//! The twin sees `λ̃_i = 1 - λ_{1-i}` and `μ̃_i = 1 - μ_{4-i}`, so only the coefficients at the origin
//! of each half-edge are stored.

use basemesh::{HalfedgeId, HalfedgeMap, TriMesh, VertexId, VertexMap};
use bezier_core::SurfaceJet;
use bezier_core::glam::DVec3;

use crate::error::JoinError;
use crate::network::CurveNetwork;

/// Coefficients of the weight functions at the origin of one half-edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OriginWeights {
    pub(crate) lambda0: f64,
    pub(crate) mu0: f64,
}

/// Weight functions along an edge, in the direction of its canonical half-edge.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EdgeWeights {
    /// Bernstein coefficients of the linear `λ`.
    pub lambda: [f64; 2],
    /// Bernstein coefficients of the quartic `μ`.
    pub mu: [f64; 5],
}

/// Weights of an edge on a boundary, where no smoothness condition holds.
pub(crate) const NO_WEIGHTS: EdgeWeights = EdgeWeights { lambda: [0.0; 2], mu: [0.0; 5] };

/// An edge seen from one of its ends `o`: all vectors relative to `o`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spoke {
    /// The half-edge that leaves `o`; for the last spoke at a boundary the one that arrives.
    pub(crate) halfedge: HalfedgeId,
    /// `q1 - o`.
    pub(crate) first: DVec3,
    /// `q2 - o`.
    pub(crate) second: DVec3,
}

impl Spoke {
    fn leaving(mesh: &TriMesh, network: &CurveNetwork, halfedge: HalfedgeId) -> Self {
        let q = network.along(mesh.topology(), halfedge).points;
        Self { halfedge, first: q[1] - q[0], second: q[2] - q[0] }
    }

    fn arriving(mesh: &TriMesh, network: &CurveNetwork, halfedge: HalfedgeId) -> Self {
        let q = network.along(mesh.topology(), halfedge).points;
        Self { halfedge, first: q[3] - q[4], second: q[2] - q[4] }
    }

    /// The spoke that follows the half-edge `h`, which leaves the vertex.
    fn after(mesh: &TriMesh, network: &CurveNetwork, h: HalfedgeId) -> Self {
        match mesh.topology().rotated_ccw(h) {
            Some(next) => Self::leaving(mesh, network, next),
            None => Self::arriving(mesh, network, h.previous()),
        }
    }

    /// First control point of the elevated curve, relative to `o`.
    pub(crate) fn elevated(&self) -> DVec3 {
        self.first * (4.0 / 7.0)
    }
}

/// The spokes of a vertex, counter-clockwise: one per face, and at a boundary one more.
pub(crate) fn spokes(mesh: &TriMesh, network: &CurveNetwork, vertex: VertexId) -> Vec<Spoke> {
    let topology = mesh.topology();
    let mut spokes: Vec<Spoke> =
        topology.fan(vertex).map(|h| Spoke::leaving(mesh, network, h)).collect();
    if let Some(last) = spokes.last().map(|spoke| spoke.halfedge)
        && topology.is_boundary_vertex(vertex)
    {
        spokes.push(Spoke::arriving(mesh, network, last.previous()));
    }
    spokes
}

/// `λ0` and `μ0` of every half-edge from the first conditions, rows 0 and 7 of [TK09 (3)]:
/// `(1 - λ0) p0 + λ0 r0 = μ0 (q1 - o)` with `p0`, `r0` the neighbours' first control points. `None` on
/// a boundary.
///
/// # Errors
///
/// [`JoinError::DegenerateFan`] where neighbouring curves leave a vertex in directions that do not
/// determine the weights.
pub(crate) fn origin_weights(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    network: &CurveNetwork,
) -> Result<HalfedgeMap<Option<OriginWeights>>, JoinError> {
    let topology = mesh.topology();
    HalfedgeMap::try_from_fn(topology.halfedge_count(), |h| {
        let Some(cw) = topology.rotated_cw(h) else { return Ok(None) };
        let vertex = topology.origin(h);
        let left = Spoke::after(mesh, network, h);
        let [along, right] = [h, cw].map(|h| Spoke::leaving(mesh, network, h));
        from_directions(jets[vertex].normal, &left, &along, &right)
            .map(Some)
            .ok_or(JoinError::DegenerateFan { vertex: vertex.index() })
    })
}

fn from_directions(
    normal: DVec3,
    left: &Spoke,
    along: &Spoke,
    right: &Spoke,
) -> Option<OriginWeights> {
    let bracket = |a: DVec3, b: DVec3| a.cross(b).dot(normal);
    let (p0, r0) = (left.elevated(), right.elevated());
    let (from_left, from_right) = (bracket(p0, along.first), bracket(r0, along.first));
    let lambda0 = from_left / (from_left - from_right);
    let mu0 = (p0 * (1.0 - lambda0) + r0 * lambda0).dot(along.first) / along.first.length_squared();
    (lambda0.is_finite() && mu0.is_finite()).then_some(OriginWeights { lambda0, mu0 })
}
