//! The interior samples at which patches are fitted, and least-squares fits on them.

use std::sync::LazyLock;

use basemesh::{Foot, SurfaceTarget};
use bezier_core::glam::DVec3;
use bezier_core::{Barycentric, BezierTriangle, MultiIndex};
use nalgebra::{DMatrix, SMatrix, SVector};

/// Divisions of the sample grid; 9 to 18 change the deviation by less than 3 %.
const GRID: usize = 12;
/// Strictly inner points of that grid.
pub(crate) const SAMPLES: usize = 55;

/// One foot per sample.
pub(crate) type Feet = [Foot; SAMPLES];

/// The parameters of the samples.
pub(crate) fn parameters() -> &'static [Barycentric; SAMPLES] {
    static PARAMETERS: LazyLock<[Barycentric; SAMPLES]> = LazyLock::new(|| {
        let mut inner = Barycentric::inner_lattice(GRID);
        std::array::from_fn(|_| inner.next().expect("invariant: 55 inner points of degree 12"))
    });
    &PARAMETERS
}

/// Feet of 55 points close to the surface; `None` if one is missing.
pub(crate) fn feet(target: &dyn SurfaceTarget, points: &[DVec3; SAMPLES]) -> Option<Feet> {
    let mut found: [Option<Foot>; SAMPLES] = [None; SAMPLES];
    target.linear_feet(points, &mut found);
    let mut feet = [Foot { point: DVec3::ZERO, normal: DVec3::ZERO }; SAMPLES];
    for (slot, foot) in feet.iter_mut().zip(found) {
        *slot = foot?;
    }
    Some(feet)
}

/// Values of one basis polynomial of the net at all samples.
pub(crate) fn basis_column<const P: usize>(m: MultiIndex) -> [f64; SAMPLES] {
    let mut unit = BezierTriangle::<f64, P>::new([0.0; P]);
    unit[m] = 1.0;
    parameters().map(|at| unit.eval(at))
}

/// Fits some control points of a net to samples, the others being given: constant matrices, made
/// once.
pub(crate) struct NetFit<const P: usize> {
    free: Vec<usize>,
    fixed: Vec<usize>,
    from_samples: Vec<[f64; SAMPLES]>,
    from_fixed: Vec<Vec<f64>>,
}

impl<const P: usize> NetFit<P> {
    /// The fit of the control points for which `is_free` holds.
    pub(crate) fn new(is_free: impl Fn(MultiIndex) -> bool) -> Self {
        let degree = BezierTriangle::<f64, P>::DEGREE;
        let (free, fixed): (Vec<MultiIndex>, Vec<MultiIndex>) =
            MultiIndex::all(degree).partition(|&m| is_free(m));
        let basis = |indices: &[MultiIndex]| {
            let columns: Vec<[f64; SAMPLES]> =
                indices.iter().map(|&m| basis_column::<P>(m)).collect();
            DMatrix::from_fn(SAMPLES, indices.len(), |row, column| columns[column][row])
        };
        // full rank and well conditioned: QR without a cut-off
        let qr = basis(&free).qr();
        let pseudo_inverse = qr
            .r()
            .solve_upper_triangular(&qr.q().transpose())
            .expect("invariant: 55 samples determine the free control points");
        let from_fixed = -(&pseudo_inverse * basis(&fixed));
        Self {
            free: free.iter().map(|m| m.rank()).collect(),
            fixed: fixed.iter().map(|m| m.rank()).collect(),
            from_samples: pseudo_inverse
                .row_iter()
                .map(|row| std::array::from_fn(|j| row[j]))
                .collect(),
            from_fixed: from_fixed.row_iter().map(|row| row.iter().copied().collect()).collect(),
        }
    }

    /// Sets the free control points so that the patch is closest to `samples` in the sense of least
    /// squares.
    pub(crate) fn apply(&self, net: &mut BezierTriangle<DVec3, P>, samples: &[DVec3; SAMPLES]) {
        // a local origin keeps the large coordinates of a far-away face out of the sums
        let origin = net.net()[0];
        for ((&rank, from_samples), from_fixed) in
            self.free.iter().zip(&self.from_samples).zip(&self.from_fixed)
        {
            let sampled = weighted_sum(from_samples, samples, origin);
            let given: DVec3 = from_fixed
                .iter()
                .zip(&self.fixed)
                .fold(DVec3::ZERO, |sum, (&w, &f)| sum + (net.net()[f] - origin) * w);
            net.net_mut()[rank] = origin + sampled + given;
        }
    }
}

fn weighted_sum(weights: &[f64; SAMPLES], points: &[DVec3; SAMPLES], origin: DVec3) -> DVec3 {
    weights.iter().zip(points).fold(DVec3::ZERO, |sum, (&w, &p)| sum + (p - origin) * w)
}

/// Moves three control points of a net so that it comes closer to the surface along the surface's
/// normals: one round of damped least squares over nine unknowns, `damping` being a fraction of the
/// mean diagonal of the normal equations, which the damping keeps well conditioned. `None` where a
/// foot is missing.
pub(crate) fn point_to_plane<const P: usize>(
    net: &BezierTriangle<DVec3, P>,
    free: [MultiIndex; 3],
    columns: &[[f64; SAMPLES]; 3],
    damping: f64,
    target: &dyn SurfaceTarget,
) -> Option<BezierTriangle<DVec3, P>> {
    let points = parameters().map(|at| net.eval(at));
    let feet = feet(target, &points)?;
    let mut matrix = SMatrix::<f64, 9, 9>::zeros();
    let mut rhs = SVector::<f64, 9>::zeros();
    for (j, (point, foot)) in points.iter().zip(&feet).enumerate() {
        let row = SVector::<f64, 9>::from_fn(|c, _| columns[c / 3][j] * foot.normal[c % 3]);
        matrix.ger(1.0, &row, &row, 1.0);
        rhs.axpy((foot.point - point).dot(foot.normal), &row, 1.0);
    }
    let ridge = damping * matrix.trace() / 9.0;
    let displacement = (matrix + SMatrix::<f64, 9, 9>::identity() * ridge).cholesky()?.solve(&rhs);
    let mut moved = *net;
    for (slot, m) in free.into_iter().enumerate() {
        for axis in 0..3 {
            moved[m][axis] += displacement[3 * slot + axis];
        }
    }
    Some(moved)
}
