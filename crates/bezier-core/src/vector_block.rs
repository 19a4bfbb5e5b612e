//! Sums of weighted points with vector instructions, and from vectors of coordinates to points.

use glam::DVec3;
use pulp::Simd;

/// Vectors whose sums are kept at a time: with three coordinates each they fill the registers.
pub(crate) const MOST: usize = 4;

/// `K` vectors of combinations of points: the first weights of each row belong to a point.
#[inline(always)]
pub(crate) fn sums<'a, S: Simd, const K: usize>(
    simd: S,
    rows: impl Iterator<Item = &'a [f64]>,
    points: &[DVec3],
) -> [[S::f64s; 3]; K] {
    let mut sums = [[simd.splat_f64s(0.0); 3]; K];
    for (row, point) in rows.zip(points) {
        let (row, _) = S::as_simd_f64s(&row[..K * S::F64_LANES]);
        let point = point.to_array().map(|c| simd.splat_f64s(c));
        for (sums, &weight) in sums.iter_mut().zip(row) {
            for (sum, c) in sums.iter_mut().zip(point) {
                *sum = simd.mul_add_e_f64s(weight, c, *sum);
            }
        }
    }
    sums
}

/// Lanes of the widest vectors.
const WIDEST: usize = 8;

/// The coordinates of as many points as a vector has lanes.
pub(crate) struct VectorBlock {
    lanes: usize,
    coordinates: [[f64; WIDEST]; 3],
}

impl VectorBlock {
    #[inline(always)]
    pub(crate) fn of<S: Simd>(vectors: [S::f64s; 3]) -> Self {
        let mut coordinates = [[0.0; WIDEST]; 3];
        for (values, vector) in coordinates.iter_mut().zip(vectors) {
            S::as_mut_simd_f64s(&mut values[..S::F64_LANES]).0[0] = vector;
        }
        Self { lanes: S::F64_LANES, coordinates }
    }

    /// Writes the points to the first places, as many as there are.
    #[inline(always)]
    pub(crate) fn write(&self, out: &mut [DVec3]) {
        let [x, y, z] = &self.coordinates;
        for (lane, out) in out.iter_mut().take(self.lanes).enumerate() {
            *out = DVec3::new(x[lane], y[lane], z[lane]);
        }
    }
}
