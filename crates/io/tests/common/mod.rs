//! Surfaces with random control points that neighbours share exactly.

#![allow(dead_code, reason = "each test file uses a part of it")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use std::collections::HashMap;

use io::Encoding;
use io::basemesh::{FaceMap, Topology, VertexId};
use io::bezier_core::{BezierTriangle, MultiIndex};
use io::glam::DVec3;

pub(crate) const ENCODINGS: [Encoding; 3] = [Encoding::Binary, Encoding::Appended, Encoding::Ascii];

pub(crate) fn octahedron() -> Topology {
    let faces =
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    Topology::from_faces(6, &faces).unwrap()
}

/// A torus of `2 n²` triangles.
pub(crate) fn torus(n: usize) -> Topology {
    let at = |i: usize, j: usize| (i % n) * n + j % n;
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let faces: Vec<_> = quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [c, d, a]]
        })
        .collect();
    Topology::from_faces(n * n, &faces).unwrap()
}

/// Three triangles with a boundary, corners turned, not in vertex order.
pub(crate) fn strip() -> Topology {
    Topology::from_faces(5, &[[4, 0, 2], [2, 3, 4], [3, 2, 1]]).unwrap()
}

/// One patch per face from a source of points, with shared points drawn once.
///
/// Points are keyed by the vertices they are a combination of, an independent way to say "shared".
pub(crate) fn nets_from<const P: usize>(
    topology: &Topology,
    mut draw: impl FnMut() -> DVec3,
) -> FaceMap<BezierTriangle<DVec3, P>> {
    let mut shared: HashMap<Vec<(usize, usize)>, DVec3> = HashMap::new();
    let nets = topology.faces().map(|face| {
        let corners = topology.corners(face).map(VertexId::index);
        BezierTriangle::from_fn(|MultiIndex { i, j, k }| {
            let mut key: Vec<_> = corners.into_iter().zip([i, j, k]).filter(|e| e.1 > 0).collect();
            key.sort_unstable();
            *shared.entry(key).or_insert_with(&mut draw)
        })
    });
    FaceMap::from_vec(nets.collect())
}

/// Points near the octahedron of size one: a regular closed surface.
pub(crate) fn bulged<const P: usize>(
    topology: &Topology,
    corners: &[DVec3],
    bulge: impl Fn(DVec3) -> DVec3 + Sync,
) -> FaceMap<BezierTriangle<DVec3, P>> {
    let degree = BezierTriangle::<DVec3, P>::DEGREE as f64;
    FaceMap::from_fn(topology.face_count(), |face| {
        let ids = topology.corners(face).map(VertexId::index);
        BezierTriangle::from_fn(|MultiIndex { i, j, k }| {
            let mut terms = [(ids[0], i), (ids[1], j), (ids[2], k)];
            // neighbours add in the same order, so they agree bit for bit
            terms.sort_unstable();
            let sum = terms.into_iter().map(|(v, n)| corners[v] * (n as f64 / degree)).sum();
            bulge(sum)
        })
    })
}

pub(crate) const OCTAHEDRON_CORNERS: [DVec3; 6] =
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];

/// A splitmix generator: the same numbers in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [-1, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn point(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// Any finite number, all exponents alike, with zeros of both signs and subnormal numbers.
    pub(crate) fn any_finite(&mut self) -> f64 {
        match self.bits() % 8 {
            0 => -0.0,
            1 => f64::from_bits(self.bits() >> 12),
            _ => loop {
                let x = f64::from_bits(self.bits());
                if x.is_finite() {
                    return x;
                }
            },
        }
    }
}
