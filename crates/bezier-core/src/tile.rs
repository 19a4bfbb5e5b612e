//! A patch at sixteen parameters at a time.

use glam::DVec3;

use crate::barycentric::Barycentric;
use crate::bernstein::binomial;
use crate::multi_index::MultiIndex;
use crate::triangle::{BezierTriangle, MAX_DEGREE};

/// Parameters that are taken together.
pub(crate) const TILE: usize = 16;

/// One quantity at all parameters of a tile.
pub(crate) type Row = [f64; TILE];

/// Up to [`TILE`] parameters for patches with `P` control points; zeros fill it up.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tile<const P: usize> {
    /// The barycentric coordinates.
    coordinates: [Row; 3],
    /// Bernstein polynomials of one degree less by rank; only the first [`LOWER`] count.
    basis: [Row; P],
}

/// Control points of a net of one degree less.
const fn lower(points: usize) -> usize {
    let mut degree = 0;
    while MultiIndex::count(degree) < points {
        degree += 1;
    }
    points - degree - 1
}

/// The nets of one degree less at the three corners of a patch; only the first of each count, as in
/// [`Tile`].
pub(crate) struct Subnets<const P: usize>([[DVec3; P]; 3]);

impl<const P: usize> Tile<P> {
    const DEGREE: usize = BezierTriangle::<f64, P>::DEGREE - 1;

    /// What each polynomial is multiplied with, and its exponents.
    const TERMS: [(f64, [usize; 3]); P] = {
        let mut terms = [(0.0, [0; 3]); P];
        let mut rank = 0;
        while rank < lower(P) {
            let MultiIndex { i, j, k } = MultiIndex::at_rank(Self::DEGREE, rank);
            terms[rank] = (binomial(Self::DEGREE, i) * binomial(j + k, k), [i, j, k]);
            rank += 1;
        }
        terms
    };

    pub(crate) fn new(parameters: &[Barycentric]) -> Self {
        let mut tile = Self::default();
        tile.fill(parameters);
        tile
    }

    /// Takes other parameters.
    #[inline(always)]
    pub(crate) fn fill(&mut self, parameters: &[Barycentric]) {
        for (lane, at) in parameters.iter().enumerate() {
            for (row, x) in self.coordinates.iter_mut().zip(at.to_array()) {
                row[lane] = x;
            }
        }
        let mut powers = [[[1.0; TILE]; MAX_DEGREE + 1]; 3];
        for (powers, row) in powers.iter_mut().zip(&self.coordinates) {
            for d in 1..=Self::DEGREE {
                powers[d] = product(&powers[d - 1], row);
            }
        }
        let [pu, pv, pw] = &powers;
        for (values, &(count, [i, j, k])) in self.basis.iter_mut().zip(&Self::TERMS[..lower(P)]) {
            *values = product(&[count; TILE], &product(&pu[i], &product(&pv[j], &pw[k])));
        }
    }

    #[inline(always)]
    pub(crate) fn rows(&self) -> &[Row] {
        &self.basis[..lower(P)]
    }
}

impl<const P: usize> Default for Tile<P> {
    fn default() -> Self {
        Self { coordinates: [[0.0; TILE]; 3], basis: [[0.0; TILE]; P] }
    }
}

#[inline(always)]
fn product(a: &Row, b: &Row) -> Row {
    std::array::from_fn(|lane| a[lane] * b[lane])
}

impl<const P: usize> Subnets<P> {
    pub(crate) fn of(patch: &BezierTriangle<DVec3, P>) -> Self {
        let mut subnets = [[DVec3::ZERO; P]; 3];
        let net = patch.net();
        for (rank, m) in MultiIndex::all(Tile::<P>::DEGREE).enumerate() {
            let below = rank + m.j + m.k + 1;
            for (subnet, source) in subnets.iter_mut().zip([rank, below, below + 1]) {
                subnet[rank] = net[source];
            }
        }
        Self(subnets)
    }
}

impl<const P: usize> Subnets<P> {
    /// Points and area normals `du × dv` of the patch at the parameters of a tile, for as many of them
    /// as there are places.
    pub(crate) fn points_and_area_normals(
        &self,
        tile: &Tile<P>,
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) {
        #[cfg(feature = "simd")]
        pulp::Arch::new().dispatch(vector::LastStep { subnets: self, tile, points, normals });
        #[cfg(not(feature = "simd"))]
        last_step(tile, &self.0.each_ref().map(|net| corner(tile, net)), points, normals);
    }

    /// The same at any parameters, with the values of the basis computed first.
    pub(crate) fn points_and_area_normals_at(
        &self,
        parameters: &[Barycentric],
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) {
        let mut tile = Tile::default();
        let places = points.chunks_mut(TILE).zip(normals.chunks_mut(TILE));
        for (parameters, (points, normals)) in parameters.chunks(TILE).zip(places) {
            fill(&mut tile, parameters);
            self.points_and_area_normals(&tile, points, normals);
        }
    }
}

#[cfg(feature = "simd")]
fn fill<const P: usize>(tile: &mut Tile<P>, parameters: &[Barycentric]) {
    pulp::Arch::new().dispatch(vector::Fill { tile, parameters });
}

#[cfg(not(feature = "simd"))]
fn fill<const P: usize>(tile: &mut Tile<P>, parameters: &[Barycentric]) {
    tile.fill(parameters);
}

/// What follows from the last triangle of de Casteljau's algorithm, coordinate by coordinate.
#[inline(always)]
fn last_step<const P: usize>(
    tile: &Tile<P>,
    [a, b, c]: &[[Row; 3]; 3],
    points: &mut [DVec3],
    normals: &mut [DVec3],
) {
    let degree = BezierTriangle::<f64, P>::DEGREE as f64;
    let [u, v, w] = &tile.coordinates;
    let mut places = [[0.0; TILE]; 3];
    let mut sides = [[[0.0; TILE]; 3]; 2];
    for axis in 0..3 {
        let (a, b, c) = (&a[axis], &b[axis], &c[axis]);
        for lane in 0..TILE {
            places[axis][lane] = a[lane] * u[lane] + b[lane] * v[lane] + c[lane] * w[lane];
            sides[0][axis][lane] = (a[lane] - c[lane]) * degree;
            sides[1][axis][lane] = (b[lane] - c[lane]) * degree;
        }
    }
    let [du, dv] = &sides;
    let mut area = [[0.0; TILE]; 3];
    for (axis, area) in area.iter_mut().enumerate() {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        for lane in 0..TILE {
            area[lane] = du[next][lane] * dv[last][lane] - du[last][lane] * dv[next][lane];
        }
    }
    write(&places, points);
    write(&area, normals);
}

/// Coordinate rows as points.
#[inline(always)]
fn write([x, y, z]: &[Row; 3], out: &mut [DVec3]) {
    for (lane, out) in out.iter_mut().take(TILE).enumerate() {
        *out = DVec3::new(x[lane], y[lane], z[lane]);
    }
}

/// One point of the last triangle at all parameters.
#[cfg(not(feature = "simd"))]
fn corner<const P: usize>(tile: &Tile<P>, net: &[DVec3; P]) -> [Row; 3] {
    let mut sums = [[0.0; TILE]; 3];
    for (row, point) in tile.rows().iter().zip(net) {
        for (sum, c) in sums.iter_mut().zip(point.to_array()) {
            for lane in 0..TILE {
                sum[lane] += row[lane] * c;
            }
        }
    }
    sums
}

#[cfg(feature = "simd")]
mod vector {
    use glam::DVec3;
    use pulp::{Simd, WithSimd};

    use super::{Row, Subnets, TILE, Tile, last_step};
    use crate::barycentric::Barycentric;
    use crate::vector_block::{MOST, sums};

    pub(super) struct LastStep<'a, const P: usize> {
        pub(super) subnets: &'a Subnets<P>,
        pub(super) tile: &'a Tile<P>,
        pub(super) points: &'a mut [DVec3],
        pub(super) normals: &'a mut [DVec3],
    }

    impl<const P: usize> WithSimd for LastStep<'_, P> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let mut corners = [[[0.0; TILE]; 3]; 3];
            for (corner, net) in corners.iter_mut().zip(&self.subnets.0) {
                sum_up(simd, self.tile, net, corner);
            }
            last_step(self.tile, &corners, self.points, self.normals);
        }
    }

    pub(super) struct Fill<'a, const P: usize> {
        pub(super) tile: &'a mut Tile<P>,
        pub(super) parameters: &'a [Barycentric],
    }

    impl<const P: usize> WithSimd for Fill<'_, P> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) {
            self.tile.fill(self.parameters);
        }
    }

    #[inline(always)]
    fn sum_up<S: Simd, const P: usize>(
        simd: S,
        tile: &Tile<P>,
        net: &[DVec3; P],
        corner: &mut [Row; 3],
    ) {
        const { assert!(TILE.is_multiple_of(MOST * S::F64_LANES), "tiles are whole blocks") };
        for first in (0..TILE).step_by(MOST * S::F64_LANES) {
            let rows = tile.rows().iter().map(|row| &row[first..]);
            let sums = sums::<S, MOST>(simd, rows, net);
            for (k, sums) in sums.into_iter().enumerate() {
                let at = first + k * S::F64_LANES;
                for (row, sum) in corner.iter_mut().zip(sums) {
                    S::as_mut_simd_f64s(&mut row[at..at + S::F64_LANES]).0[0] = sum;
                }
            }
        }
    }
}
