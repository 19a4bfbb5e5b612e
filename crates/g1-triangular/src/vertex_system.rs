//! Step 3: the twist points around each vertex [TK09, section 6.3].
//!
//! The twist `t_i` lies in the face between spoke `i` and spoke `i + 1`. The second condition along
//! spoke `i` reads, relative to the vertex,
//!
//! ```text
//! 6 ((1 - λ0) t_i + λ0 t_{i-1}) = R_i + 4 μ1 d_i,
//! R_i = -((1 - λ1) c_{i+1} + λ1 c_{i-1}) + 3 ((1 - μ0) d_i + μ0 s_i) .
//! ```
//!
//! Normal parts: `t_i·N = 7/6 II(c_i, c_{i+1})` solves all of them exactly for every valence, because
//! the curves share one second fundamental form, and gives the patches that form.
//! Tangential parts: `μ1` drops out across `d_i`, leaving one equation per spoke; the twists of the
//! positional patches are corrected by the smallest solution.

use basemesh::{HalfedgeId, HalfedgeMap, TriMesh, VertexMap};
use bezier_core::SurfaceJet;
use bezier_core::glam::DVec3;
use nalgebra::{DMatrix, DVector};

use crate::error::JoinError;
use crate::network::CurveNetwork;
use crate::weights::{OriginWeights, Spoke, spokes};

/// Below this ratio of pivots the equations of a vertex count as dependent and are solved by a
/// pseudo-inverse. On guarded base meshes the ratio stays above 2e-2.
const DEPENDENT: f64 = 1e-12;

/// What a vertex decides for one of its outgoing half-edges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpokeSolution {
    /// Second coefficient of `μ` along the half-edge.
    pub(crate) mu1: f64,
    /// Twist point of the half-edge's face at its origin, in world coordinates.
    pub(crate) twist: DVec3,
}

/// Solves the systems of all vertices; `initial(h)` is the twist point of the face of `h` at its
/// origin in the positional patches.
pub(crate) fn solve_vertices(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    network: &CurveNetwork,
    weights: &HalfedgeMap<OriginWeights>,
    initial: &(dyn Fn(HalfedgeId) -> DVec3 + Sync),
) -> Result<HalfedgeMap<SpokeSolution>, JoinError> {
    let topology = mesh.topology();
    let solutions = VertexMap::try_from_fn(topology.vertex_count(), |vertex| {
        let spokes = spokes(mesh, network, vertex);
        let rows = rows(mesh, weights, &spokes)?;
        let twists = twists(&jets[vertex], &spokes, &rows, mesh.position(vertex), initial);
        twists
            .map(|twists| spoke_solutions(mesh.position(vertex), &spokes, &rows, &twists))
            .ok_or(JoinError::DegenerateFan { vertex: vertex.index() })
    })?;
    Ok(scatter(topology.halfedge_count(), solutions))
}

/// The condition along one spoke.
struct Row {
    lambda0: f64,
    /// `R_i`.
    rest: DVec3,
}

impl Row {
    /// `6 ((1 - λ0) t_i + λ0 t_{i-1})`.
    fn apply(&self, twist: DVec3, previous: DVec3) -> DVec3 {
        (twist * (1.0 - self.lambda0) + previous * self.lambda0) * 6.0
    }
}

fn rows(
    mesh: &TriMesh,
    weights: &HalfedgeMap<OriginWeights>,
    spokes: &[Spoke],
) -> Result<Vec<Row>, JoinError> {
    let topology = mesh.topology();
    let n = spokes.len();
    (0..n)
        .map(|i| {
            let spoke = &spokes[i];
            let (next, previous) = (&spokes[(i + 1) % n], &spokes[(i + n - 1) % n]);
            let twin = topology.twin(spoke.halfedge).ok_or_else(|| JoinError::OpenSurface {
                edge: topology.edge(spoke.halfedge).index(),
            })?;
            let OriginWeights { lambda0, mu0 } = weights[spoke.halfedge];
            let lambda1 = 1.0 - weights[twin].lambda0;
            let rest = (spoke.first * (1.0 - mu0) + spoke.second * mu0) * 3.0
                - (next.elevated() * (1.0 - lambda1) + previous.elevated() * lambda1);
            Ok(Row { lambda0, rest })
        })
        .collect()
}

/// Twist points relative to the vertex, one per spoke.
fn twists(
    jet: &SurfaceJet,
    spokes: &[Spoke],
    rows: &[Row],
    origin: DVec3,
    initial: &(dyn Fn(HalfedgeId) -> DVec3 + Sync),
) -> Option<Vec<DVec3>> {
    let n = spokes.len();
    let start: Vec<DVec3> = (0..n)
        .map(|i| {
            let tangential = jet.tangential(initial(spokes[i].halfedge) - origin);
            let bend = jet.second_form(spokes[i].elevated(), spokes[(i + 1) % n].elevated());
            tangential + jet.normal * (7.0 / 6.0 * bend)
        })
        .collect();
    tangential_correction(jet.normal, spokes, rows, start)
}

/// The smallest tangential change of the twists that meets every condition across its spoke.
fn tangential_correction(
    normal: DVec3,
    spokes: &[Spoke],
    rows: &[Row],
    mut twists: Vec<DVec3>,
) -> Option<Vec<DVec3>> {
    let n = spokes.len();
    let across: Vec<DVec3> = spokes
        .iter()
        .map(|spoke| normal.cross(spoke.first).try_normalize())
        .collect::<Option<_>>()?;
    // A Aᵀ: spoke i touches the twists i and i - 1
    let mut gram = DMatrix::<f64>::zeros(n, n);
    for i in 0..n {
        let previous = (i + n - 1) % n;
        let lambda = rows[i].lambda0;
        gram[(i, i)] += 36.0 * ((1.0 - lambda).powi(2) + lambda.powi(2));
        let coupling =
            36.0 * lambda * (1.0 - rows[previous].lambda0) * across[i].dot(across[previous]);
        gram[(i, previous)] += coupling;
        gram[(previous, i)] += coupling;
    }
    let solver = GramSolver::new(gram)?;
    // the second round removes the round-off of the first
    for _ in 0..2 {
        let defect = DVector::from_fn(n, |i, _| {
            let lhs = rows[i].apply(twists[i], twists[(i + n - 1) % n]);
            across[i].dot(rows[i].rest - lhs)
        });
        let multipliers = solver.solve(&defect)?;
        for i in 0..n {
            let next = (i + 1) % n;
            twists[i] += across[i] * (6.0 * (1.0 - rows[i].lambda0) * multipliers[i])
                + across[next] * (6.0 * rows[next].lambda0 * multipliers[next]);
        }
    }
    twists.iter().all(|t| t.is_finite()).then_some(twists)
}

/// Factorised symmetric positive matrix, or its pseudo-inverse where it is not definite.
enum GramSolver {
    Cholesky(nalgebra::Cholesky<f64, nalgebra::Dyn>),
    PseudoInverse(DMatrix<f64>),
}

impl GramSolver {
    fn new(gram: DMatrix<f64>) -> Option<Self> {
        if let Some(cholesky) = gram.clone().cholesky() {
            let pivots = cholesky.l_dirty().diagonal();
            if pivots.min().powi(2) > DEPENDENT * pivots.max().powi(2) {
                return Some(Self::Cholesky(cholesky));
            }
        }
        let svd = gram.try_svd(true, true, f64::EPSILON, 1000)?;
        let cut_off = DEPENDENT * svd.singular_values.max();
        svd.pseudo_inverse(cut_off).ok().map(Self::PseudoInverse)
    }

    fn solve(&self, rhs: &DVector<f64>) -> Option<DVector<f64>> {
        let solution = match self {
            Self::Cholesky(cholesky) => cholesky.solve(rhs),
            Self::PseudoInverse(inverse) => inverse * rhs,
        };
        solution.iter().all(|x| x.is_finite()).then_some(solution)
    }
}

fn spoke_solutions(
    origin: DVec3,
    spokes: &[Spoke],
    rows: &[Row],
    twists: &[DVec3],
) -> Vec<(HalfedgeId, SpokeSolution)> {
    let n = spokes.len();
    (0..n)
        .map(|i| {
            let lhs = rows[i].apply(twists[i], twists[(i + n - 1) % n]);
            let d = spokes[i].first;
            let mu1 = (lhs - rows[i].rest).dot(d) / (4.0 * d.length_squared());
            (spokes[i].halfedge, SpokeSolution { mu1, twist: origin + twists[i] })
        })
        .collect()
}

fn scatter(
    halfedges: usize,
    solutions: VertexMap<Vec<(HalfedgeId, SpokeSolution)>>,
) -> HalfedgeMap<SpokeSolution> {
    let unset = SpokeSolution { mu1: f64::NAN, twist: DVec3::NAN };
    let mut scattered = HalfedgeMap::from_vec(vec![unset; halfedges]);
    for (h, solution) in solutions.into_vec().into_iter().flatten() {
        scattered[h] = solution;
    }
    scattered
}
