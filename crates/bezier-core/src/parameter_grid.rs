//! Many patches at the same parameters, or one patch at many.

use glam::DVec3;

use crate::barycentric::Barycentric;
use crate::multi_index::MultiIndex;
use crate::point_map::PointMap;
use crate::tile::{Subnets, TILE, Tile};
use crate::triangle::BezierTriangle;

/// Parameters at which many patches with `P` control points are evaluated: the values of the basis
/// are computed once.
///
/// Several times as fast as [`BezierTriangle::point_and_area_normal`] at each parameter, and equal
/// to it up to rounding. See [`PointMap`] for the feature `simd`.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterGrid<const P: usize> {
    parameters: Vec<Barycentric>,
    points: PointMap,
    tiles: Vec<Tile<P>>,
}

impl<const P: usize> ParameterGrid<P> {
    /// The grid of these parameters.
    #[must_use]
    pub fn new(parameters: impl IntoIterator<Item = Barycentric>) -> Self {
        let parameters: Vec<Barycentric> = parameters.into_iter().collect();
        let units: Vec<BezierTriangle<f64, P>> = MultiIndex::all(BezierTriangle::<f64, P>::DEGREE)
            .map(|m| BezierTriangle::from_fn(|n| f64::from(u8::from(m == n))))
            .collect();
        let value = |at: usize, rank: usize| units[rank].eval(parameters[at]);
        let points = PointMap::new(parameters.len(), P, value);
        let tiles = parameters.chunks(TILE).map(Tile::new).collect();
        Self { parameters, points, tiles }
    }

    /// The regular grid with so many divisions, see [`Barycentric::lattice`].
    #[must_use]
    pub fn lattice(divisions: usize) -> Self {
        Self::new(Barycentric::lattice(divisions))
    }

    /// The parameters, in the order in which they were given.
    #[must_use]
    pub fn parameters(&self) -> &[Barycentric] {
        &self.parameters
    }

    /// The points of a patch at the parameters.
    ///
    /// # Panics
    ///
    /// If `out` has another length than the grid.
    pub fn points(&self, patch: &BezierTriangle<DVec3, P>, out: &mut [DVec3]) {
        self.points.apply(patch.net(), out);
    }

    /// The points of a patch at the parameters and its area normals `du × dv`, not normalised.
    ///
    /// # Panics
    ///
    /// If `points` or `normals` has another length than the grid.
    pub fn points_and_area_normals(
        &self,
        patch: &BezierTriangle<DVec3, P>,
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) {
        let count = self.parameters.len();
        assert_eq!([points.len(), normals.len()], [count; 2], "one place for each parameter");
        let subnets = Subnets::of(patch);
        let places = points.chunks_mut(TILE).zip(normals.chunks_mut(TILE));
        for (tile, (points, normals)) in self.tiles.iter().zip(places) {
            subnets.points_and_area_normals(tile, points, normals);
        }
    }
}

impl<const P: usize> BezierTriangle<DVec3, P> {
    /// [`point_and_area_normal`](Self::point_and_area_normal) at many parameters; the same bits as
    /// from a [`ParameterGrid`] of them.
    ///
    /// # Panics
    ///
    /// If the three slices are not of the same length.
    pub fn points_and_area_normals(
        &self,
        parameters: &[Barycentric],
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) {
        let count = parameters.len();
        assert_eq!([points.len(), normals.len()], [count; 2], "one place for each parameter");
        Subnets::of(self).points_and_area_normals_at(parameters, points, normals);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{QuarticTriangle, SepticTriangle};

    fn wavy<const P: usize>() -> BezierTriangle<DVec3, P> {
        BezierTriangle::from_fn(|m| {
            let [i, j, k] = [m.i, m.j, m.k].map(|e| e as f64);
            DVec3::new(1e3 + i, (j * k).sin(), (i - 2.0 * k).cos())
        })
    }

    /// All ways to evaluate agree up to rounding, for whole tiles and remainders.
    fn agrees<const P: usize>(patch: &BezierTriangle<DVec3, P>) {
        for count in [1, 3, 15, 16, 17, 45, 153] {
            let parameters: Vec<Barycentric> = Barycentric::lattice(16).take(count).collect();
            let grid = ParameterGrid::<P>::new(parameters.iter().copied());
            let mut by_grid = [vec![DVec3::NAN; count], vec![DVec3::NAN; count]];
            let mut at_once = by_grid.clone();
            let mut points = vec![DVec3::NAN; count];
            let [p, n] = &mut by_grid;
            grid.points_and_area_normals(patch, p, n);
            let [p, n] = &mut at_once;
            patch.points_and_area_normals(&parameters, p, n);
            assert_eq!(by_grid, at_once, "the same bits");
            grid.points(patch, &mut points);
            let size = 1e3 * f64::EPSILON;
            for (lane, &at) in parameters.iter().enumerate() {
                let (point, normal) = patch.point_and_area_normal(at);
                let n = f64::from(u8::try_from(P).expect("a small net"));
                assert!(points[lane].distance(point) <= n * size, "{at:?}");
                assert!(by_grid[0][lane].distance(point) <= n * size, "{at:?}");
                // differences of the corners, times lengths of the net of at most ten
                assert!(by_grid[1][lane].distance(normal) <= 100.0 * n * n * size, "{at:?}");
            }
        }
    }

    #[test]
    fn agrees_with_single_points() {
        agrees(&wavy::<36>());
        agrees::<15>(&wavy());
        let _: (SepticTriangle, QuarticTriangle) = (wavy(), wavy());
    }
}
