//! Step 1: patches whose boundaries are the network, joined without gaps (G0).
//!
//! Each patch is the degree-7 polynomial with the given boundary that fits, in the sense of least
//! squares, the projections of a regular grid on the flat triangle [TK09 (12)].

use std::sync::LazyLock;

use basemesh::{FaceId, FaceMap, Foot, SurfaceTarget, TriMesh};
use bezier_core::glam::DVec3;
use bezier_core::{Barycentric, LocalEdge, MultiIndex, SepticTriangle};
use nalgebra::DMatrix;

use crate::faces::{corner_halfedges, is_boundary};
use crate::network::CurveNetwork;

/// Divisions of the sample grid; 9 to 18 change the deviation by less than 3 %.
const GRID: usize = 12;
/// Strictly inner points of that grid.
pub(crate) const SAMPLES: usize = 55;
const INNER: usize = 15;
const BOUNDARY: usize = 21;

/// Patches that join without gaps, not yet smoothly.
#[derive(Clone, Debug)]
pub struct PositionalPatches {
    /// Control nets by face.
    pub nets: FaceMap<SepticTriangle>,
    /// Samples per face whose projection failed and was replaced by the flat point; normally zero.
    pub failed_feet: FaceMap<usize>,
}

/// The parameters of the interior samples of a face.
pub(crate) fn sample_parameters() -> &'static [Barycentric; SAMPLES] {
    static PARAMETERS: LazyLock<[Barycentric; SAMPLES]> = LazyLock::new(|| {
        let mut inner = Barycentric::inner_lattice(GRID);
        std::array::from_fn(|_| inner.next().expect("invariant: 55 inner points of degree 12"))
    });
    &PARAMETERS
}

/// Inner control points as fixed combinations of boundary control points and samples.
struct Fit {
    inner_ranks: [usize; INNER],
    boundary_ranks: [usize; BOUNDARY],
    from_boundary: Vec<[f64; BOUNDARY]>,
    from_samples: Vec<[f64; SAMPLES]>,
}

static FIT: LazyLock<Fit> = LazyLock::new(|| {
    let ranks_where = |boundary: bool| {
        MultiIndex::all(7).filter(move |&m| is_boundary(m) == boundary).map(MultiIndex::rank)
    };
    let mut inner = ranks_where(false);
    let mut boundary = ranks_where(true);
    let inner_ranks: [usize; INNER] =
        std::array::from_fn(|_| inner.next().expect("invariant: 15 inner points of degree 7"));
    let boundary_ranks: [usize; BOUNDARY] =
        std::array::from_fn(|_| boundary.next().expect("invariant: 21 boundary points"));
    let basis = |ranks: &[usize]| {
        DMatrix::from_fn(SAMPLES, ranks.len(), |row, column| {
            let mut unit = [0.0; 36];
            unit[ranks[column]] = 1.0;
            SepticTriangle::<f64>::new(unit).eval(sample_parameters()[row])
        })
    };
    let inner_basis = basis(&inner_ranks);
    // full rank, well conditioned: QR, no cut-off
    let qr = inner_basis.qr();
    let pseudo_inverse = qr
        .r()
        .solve_upper_triangular(&qr.q().transpose())
        .expect("invariant: 55 samples determine 15 control points");
    let from_boundary = -(&pseudo_inverse * basis(&boundary_ranks));
    Fit {
        inner_ranks,
        boundary_ranks,
        from_boundary: rows(&from_boundary),
        from_samples: rows(&pseudo_inverse),
    }
});

fn rows<const N: usize>(matrix: &DMatrix<f64>) -> Vec<[f64; N]> {
    (0..matrix.nrows()).map(|i| std::array::from_fn(|j| matrix[(i, j)])).collect()
}

/// Fills every face of the mesh with a patch over the curve network.
#[must_use]
pub fn fill(
    mesh: &TriMesh,
    network: &CurveNetwork,
    target: &dyn SurfaceTarget,
) -> PositionalPatches {
    let filled = FaceMap::from_fn(mesh.topology().face_count(), |face| {
        fill_face(mesh, network, target, face)
    });
    PositionalPatches {
        nets: filled.map(|_, (net, _)| *net),
        failed_feet: filled.map(|_, &(_, failed)| failed),
    }
}

fn fill_face(
    mesh: &TriMesh,
    network: &CurveNetwork,
    target: &dyn SurfaceTarget,
    face: FaceId,
) -> (SepticTriangle, usize) {
    let mut net = boundary_net(mesh, network, face);
    let [a, b, c] = mesh.triangle(face);
    let flat = sample_parameters().map(|at| a * at.u + b * at.v + c * at.w);
    let mut feet: [Option<Foot>; SAMPLES] = [None; SAMPLES];
    target.feet(&flat, &mut feet);
    let failed = feet.iter().filter(|foot| foot.is_none()).count();
    // a local origin keeps the large coordinates of a far-away face out of the sums
    let origin = a;
    let samples: [DVec3; SAMPLES] =
        std::array::from_fn(|j| feet[j].map_or(flat[j], |foot| foot.point) - origin);

    let fit = &*FIT;
    let boundary: [DVec3; BOUNDARY] =
        std::array::from_fn(|j| net.net()[fit.boundary_ranks[j]] - origin);
    for (i, &rank) in fit.inner_ranks.iter().enumerate() {
        net.net_mut()[rank] = origin
            + weighted_sum(&fit.from_samples[i], &samples)
            + weighted_sum(&fit.from_boundary[i], &boundary);
    }
    (net, failed)
}

/// A net with the three boundary curves of a face and zeros inside.
fn boundary_net(mesh: &TriMesh, network: &CurveNetwork, face: FaceId) -> SepticTriangle {
    let mut net = SepticTriangle::new([DVec3::ZERO; 36]);
    for (edge, h) in LocalEdge::ALL.into_iter().zip(corner_halfedges(face)) {
        net.set_boundary(edge, &network.elevated_along(mesh.topology(), h));
    }
    net
}

fn weighted_sum<const N: usize>(weights: &[f64; N], points: &[DVec3; N]) -> DVec3 {
    weights.iter().zip(points).fold(DVec3::ZERO, |sum, (&weight, &point)| sum + point * weight)
}
