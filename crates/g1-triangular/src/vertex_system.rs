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
//!
//! At a boundary, the first and the last spoke have no condition. They need not share the second
//! fundamental form either: in the condition along a spoke only its own curve is differentiated twice.

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
    /// Second coefficient of `μ` along the half-edge; zero on a boundary.
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
    weights: &HalfedgeMap<Option<OriginWeights>>,
    initial: &(dyn Fn(HalfedgeId) -> DVec3 + Sync),
) -> Result<HalfedgeMap<SpokeSolution>, JoinError> {
    let topology = mesh.topology();
    let solutions = VertexMap::try_from_fn(topology.vertex_count(), |vertex| {
        let spokes = spokes(mesh, network, vertex);
        let rows = rows(mesh, weights, &spokes);
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

/// One condition per spoke; `None` on a boundary.
fn rows(
    mesh: &TriMesh,
    weights: &HalfedgeMap<Option<OriginWeights>>,
    spokes: &[Spoke],
) -> Vec<Option<Row>> {
    let n = spokes.len();
    let row = |i: usize| {
        let spoke = &spokes[i];
        let twin = mesh.topology().twin(spoke.halfedge)?;
        let OriginWeights { lambda0, mu0 } = weights[spoke.halfedge]?;
        let lambda1 = 1.0 - weights[twin]?.lambda0;
        let (next, previous) = (&spokes[(i + 1) % n], &spokes[before(i, n)]);
        let rest = (spoke.first * (1.0 - mu0) + spoke.second * mu0) * 3.0
            - (next.elevated() * (1.0 - lambda1) + previous.elevated() * lambda1);
        Some(Row { lambda0, rest })
    };
    (0..n).map(row).collect()
}

/// The one before, around.
fn before(i: usize, n: usize) -> usize {
    (i + n - 1) % n
}

/// Twist points relative to the vertex, one per face: between spokes `i` and `i + 1`.
fn twists(
    jet: &SurfaceJet,
    spokes: &[Spoke],
    rows: &[Option<Row>],
    origin: DVec3,
    initial: &(dyn Fn(HalfedgeId) -> DVec3 + Sync),
) -> Option<Vec<DVec3>> {
    let n = spokes.len();
    let faces = if rows.iter().all(Option::is_some) { n } else { n - 1 };
    if rows.iter().all(Option::is_none) {
        // one face alone: nothing to meet
        return Some((0..faces).map(|i| initial(spokes[i].halfedge) - origin).collect());
    }
    let start: Vec<DVec3> = (0..faces)
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
    rows: &[Option<Row>],
    mut twists: Vec<DVec3>,
) -> Option<Vec<DVec3>> {
    let n = spokes.len();
    let across: Vec<DVec3> = spokes
        .iter()
        .map(|spoke| normal.cross(spoke.first).try_normalize())
        .collect::<Option<_>>()?;
    let solver = GramSolver::new(gram(rows, &across))?;
    // the second round removes the round-off of the first
    for _ in 0..2 {
        let defect = DVector::from_fn(n, |i, _| {
            rows[i].as_ref().map_or(0.0, |row| {
                across[i].dot(row.rest - row.apply(twists[i], twists[before(i, n)]))
            })
        });
        let multipliers = solver.solve(&defect)?;
        for (i, twist) in twists.iter_mut().enumerate() {
            let next = (i + 1) % n;
            if let Some(row) = &rows[i] {
                *twist += across[i] * (6.0 * (1.0 - row.lambda0) * multipliers[i]);
            }
            if let Some(row) = &rows[next] {
                *twist += across[next] * (6.0 * row.lambda0 * multipliers[next]);
            }
        }
    }
    twists.iter().all(|t| t.is_finite()).then_some(twists)
}

/// `A Aᵀ`: the condition of spoke `i` touches the twists `i` and `i - 1`. Without a condition, a row of
/// its own.
fn gram(rows: &[Option<Row>], across: &[DVec3]) -> DMatrix<f64> {
    let n = rows.len();
    let mut gram = DMatrix::<f64>::zeros(n, n);
    for (i, row) in rows.iter().enumerate() {
        let Some(Row { lambda0: lambda, .. }) = row else {
            gram[(i, i)] = 36.0;
            continue;
        };
        let previous = before(i, n);
        gram[(i, i)] += 36.0 * ((1.0 - lambda).powi(2) + lambda.powi(2));
        if let Some(other) = &rows[previous] {
            let coupling = 36.0 * lambda * (1.0 - other.lambda0) * across[i].dot(across[previous]);
            gram[(i, previous)] += coupling;
            gram[(previous, i)] += coupling;
        }
    }
    gram
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
    rows: &[Option<Row>],
    twists: &[DVec3],
) -> Vec<(HalfedgeId, SpokeSolution)> {
    let n = spokes.len();
    let solution = |(i, twist): (usize, &DVec3)| {
        let mu1 = rows[i].as_ref().map_or(0.0, |row| {
            let lhs = row.apply(*twist, twists[before(i, n)]);
            let d = spokes[i].first;
            (lhs - row.rest).dot(d) / (4.0 * d.length_squared())
        });
        (spokes[i].halfedge, SpokeSolution { mu1, twist: origin + *twist })
    };
    twists.iter().enumerate().map(solution).collect()
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
