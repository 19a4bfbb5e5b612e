//! The interior samples at which patches are fitted, and least-squares fits on them.

use std::sync::LazyLock;

use basemesh::{Foot, SurfaceTarget};
use bezier_core::glam::DVec3;
use bezier_core::{Barycentric, BezierTriangle, MultiIndex, PointMap};
use nalgebra::DMatrix;

/// Divisions of the sample grid; 9 to 18 change the deviation by less than 3 %.
const GRID: usize = 12;
/// Strictly inner points of that grid.
pub(crate) const SAMPLES: usize = 55;

/// One point per sample.
pub(crate) type Points = [DVec3; SAMPLES];
/// Where the surface is near each sample.
pub(crate) struct Feet {
    /// Unit normals of the surface.
    pub(crate) normals: Points,
    /// Distances from the samples to the surface along these.
    pub(crate) distances: [f64; SAMPLES],
}

/// The parameters of the samples.
pub(crate) fn parameters() -> &'static [Barycentric; SAMPLES] {
    static PARAMETERS: LazyLock<[Barycentric; SAMPLES]> = LazyLock::new(|| {
        let mut inner = Barycentric::inner_lattice(GRID);
        std::array::from_fn(|_| inner.next().expect("invariant: 55 inner points of degree 12"))
    });
    &PARAMETERS
}

/// Feet of 55 points close to the surface; `None` if one is missing.
fn feet(target: &dyn SurfaceTarget, points: &Points) -> Option<Feet> {
    let mut found: [Option<Foot>; SAMPLES] = [None; SAMPLES];
    target.linear_feet(points, &mut found);
    let mut feet = Feet { normals: [DVec3::ZERO; SAMPLES], distances: [0.0; SAMPLES] };
    for (j, foot) in found.iter().enumerate() {
        let Foot { point, normal } = foot.as_ref()?;
        feet.normals[j] = *normal;
        feet.distances[j] = (*point - points[j]).dot(*normal);
    }
    Some(feet)
}

/// Values of one basis polynomial of the net at all samples.
fn basis_column<const P: usize>(m: MultiIndex) -> [f64; SAMPLES] {
    let mut unit = BezierTriangle::<f64, P>::new([0.0; P]);
    unit[m] = 1.0;
    parameters().map(|at| unit.eval(at))
}

/// Fits `FREE` control points of a net to samples, the others being given: constant matrices, made
/// once.
pub(crate) struct NetFit<const P: usize, const FREE: usize> {
    free: [MultiIndex; FREE],
    from_samples: PointMap,
    /// From the whole net; the free points have no weight.
    from_given: PointMap,
}

impl<const P: usize, const FREE: usize> NetFit<P, FREE> {
    /// The fit of these control points.
    pub(crate) fn new(free: [MultiIndex; FREE]) -> Self {
        let degree = BezierTriangle::<f64, P>::DEGREE;
        let basis: Vec<[f64; SAMPLES]> = MultiIndex::all(degree).map(basis_column::<P>).collect();
        let free_basis =
            DMatrix::from_fn(SAMPLES, FREE, |sample, slot| basis[free[slot].rank()][sample]);
        let given_basis = DMatrix::from_fn(SAMPLES, P, |sample, rank| {
            let given = free.iter().all(|m| m.rank() != rank);
            if given { basis[rank][sample] } else { 0.0 }
        });
        // full rank and well conditioned: QR without a cut-off
        let qr = free_basis.qr();
        let pseudo_inverse = qr
            .r()
            .solve_upper_triangular(&qr.q().transpose())
            .expect("invariant: 55 samples determine the free control points");
        let from_given = &pseudo_inverse * given_basis;
        Self {
            free,
            from_samples: PointMap::new(FREE, SAMPLES, |slot, sample| {
                pseudo_inverse[(slot, sample)]
            }),
            from_given: PointMap::new(FREE, P, |slot, rank| -from_given[(slot, rank)]),
        }
    }

    /// Sets the free control points so that the patch is closest to `samples` in the sense of least
    /// squares.
    pub(crate) fn apply(&self, net: &mut BezierTriangle<DVec3, P>, samples: &Points) {
        // a local origin keeps the large coordinates of a far-away face out of the sums
        let origin = net.net()[0];
        let sampled: [DVec3; FREE] = self.from_samples.to_array(&samples.map(|p| p - origin));
        let given: [DVec3; FREE] = self.from_given.to_array(&net.net().map(|p| p - origin));
        for (slot, &m) in self.free.iter().enumerate() {
            net[m] = origin + sampled[slot] + given[slot];
        }
    }
}

/// Moves three control points of a net in rounds, each towards new feet of the samples.
pub(crate) struct FreePoints<const P: usize> {
    free: [MultiIndex; 3],
    basis: PointMap,
    columns: Columns,
}

/// Motion of each sample when a free point moves by one.
pub(crate) struct Columns {
    pub(crate) values: [[f64; SAMPLES]; 3],
    /// Sums over the samples with these weights, and with their products for the [`PAIRS`].
    pub(crate) sums: PointMap,
    pub(crate) pair_sums: PointMap,
}

/// Pairs of three things.
pub(crate) const PAIRS: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];

impl Columns {
    fn new(values: [[f64; SAMPLES]; 3]) -> Self {
        let product = |pair: usize, sample: usize| {
            let [a, b] = PAIRS[pair];
            values[a][sample] * values[b][sample]
        };
        Self {
            sums: PointMap::new(3, SAMPLES, |slot, sample| values[slot][sample]),
            pair_sums: PointMap::new(PAIRS.len(), SAMPLES, product),
            values,
        }
    }
}

impl<const P: usize> FreePoints<P> {
    /// These control points.
    pub(crate) fn new(free: [MultiIndex; 3]) -> Self {
        let degree = BezierTriangle::<f64, P>::DEGREE;
        let basis: Vec<[f64; SAMPLES]> = MultiIndex::all(degree).map(basis_column::<P>).collect();
        Self {
            free,
            basis: PointMap::new(SAMPLES, P, |sample, rank| basis[rank][sample]),
            columns: Columns::new(free.map(basis_column::<P>)),
        }
    }

    /// Moves the free points `rounds` times by the vectors that `motion` finds for the columns and the
    /// feet; ends early where a foot or the motion is missing.
    pub(crate) fn fit(
        &self,
        net: &mut BezierTriangle<DVec3, P>,
        rounds: usize,
        target: &dyn SurfaceTarget,
        motion: impl Fn(&Columns, &Feet) -> Option<[DVec3; 3]>,
    ) {
        let mut points: Points = self.basis.to_array(net.net());
        for round in 0..rounds {
            let moved = feet(target, &points);
            let moved = moved.and_then(|feet| motion(&self.columns, &feet));
            let Some([a, b, c]) = moved else { return };
            for (&m, step) in self.free.iter().zip([a, b, c]) {
                net[m] += step;
            }
            if round + 1 < rounds {
                let [ca, cb, cc] = &self.columns.values;
                for (j, point) in points.iter_mut().enumerate() {
                    *point += a * ca[j] + b * cb[j] + c * cc[j];
                }
            }
        }
    }
}
