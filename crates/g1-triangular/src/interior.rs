//! Step 5: the three control points that no smoothness condition touches.

use basemesh::{FaceMap, Foot, SurfaceTarget};
use bezier_core::{Barycentric, MultiIndex, SepticTriangle};
use nalgebra::{SMatrix, SVector};

use crate::fill::{SAMPLES, sample_parameters};

/// The free control points, by exponents.
const FREE: [MultiIndex; 3] =
    [MultiIndex::new(3, 2, 2), MultiIndex::new(2, 3, 2), MultiIndex::new(2, 2, 3)];
/// Rounds of projecting and fitting.
const ROUNDS: usize = 2;
/// Damping of the displacement, as a fraction of the mean diagonal of the normal equations.
const DAMPING: f64 = 1e-2;

/// Moves the free points of every patch so that it comes closer to the surface along the
/// surface's normals, in the sense of damped least squares. A patch whose samples cannot be
/// projected keeps its points.
pub(crate) fn fit_point_to_plane(
    nets: &FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
) -> FaceMap<SepticTriangle> {
    nets.map(|_, net| (0..ROUNDS).fold(*net, |net, _| fit_once(&net, target).unwrap_or(net)))
}

fn fit_once(net: &SepticTriangle, target: &dyn SurfaceTarget) -> Option<SepticTriangle> {
    let parameters = sample_parameters();
    let points = parameters.map(|at| net.eval(at));
    let mut feet: [Option<Foot>; SAMPLES] = [None; SAMPLES];
    target.feet(&points, &mut feet);

    let mut matrix = SMatrix::<f64, 9, 9>::zeros();
    let mut rhs = SVector::<f64, 9>::zeros();
    for ((at, point), foot) in parameters.iter().zip(points).zip(feet) {
        let foot = foot?;
        let row =
            SVector::<f64, 9>::from_fn(|c, _| basis_value(FREE[c / 3], *at) * foot.normal[c % 3]);
        matrix += row * row.transpose();
        rhs += row * (foot.point - point).dot(foot.normal);
    }
    let damping = DAMPING * matrix.trace() / 9.0;
    let damped = matrix + SMatrix::<f64, 9, 9>::identity() * damping;
    let displacement = damped.cholesky()?.solve(&rhs);

    let mut fitted = *net;
    for (slot, m) in FREE.into_iter().enumerate() {
        for axis in 0..3 {
            fitted[m][axis] += displacement[3 * slot + axis];
        }
    }
    Some(fitted)
}

fn basis_value(m: MultiIndex, at: Barycentric) -> f64 {
    let mut unit = SepticTriangle::<f64>::new([0.0; 36]);
    unit[m] = 1.0;
    unit.eval(at)
}
