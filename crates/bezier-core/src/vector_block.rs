//! From vectors of coordinates to points.

use glam::DVec3;
use pulp::Simd;

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
