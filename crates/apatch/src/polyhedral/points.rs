//! Points of the surface on the rays of its tetrahedra.

use glam::DVec3;

use super::hull::Cell;
use super::surface::PolyhedralSurface;
use crate::bernstein;
use crate::cubic_root::RayCubic;
use crate::segment_polynomial::SegmentPolynomial;
use crate::tetrahedron::gradient;

/// A point of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub point: DVec3,
    /// Gradient of the function: normal to the surface, outwards, not of unit length.
    pub gradient: DVec3,
    /// How far along its ray, from 0 on the triangulation to 1 at the upper end.
    pub t: f64,
    /// Barycentric coordinates in its tetrahedron.
    pub at: [f64; 4],
}

impl SurfacePoint {
    /// Unit normal, outwards; zero at a singular point.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.gradient.normalize_or_zero()
    }
}

/// How often a ray meets the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meets {
    /// The ray starts above the surface, and stays there: its point is on the other side.
    Elsewhere,
    Once,
    Wrongly,
}

impl PolyhedralSurface {
    /// Bernstein coefficients along the ray between two points in barycentric coordinates, times the
    /// sign of the cell's side: a ray starts below zero.
    #[inline]
    pub(crate) fn ray(&self, cell: usize, foot: [f64; 4], top: [f64; 4]) -> [f64; 6] {
        let sign = self.hull.cells[cell].side().sign();
        bernstein::along(self.degree, self.weights(cell), foot, top).map(|b| sign * b)
    }

    /// The point of the surface on the ray of a cell from `foot` to `top`, both in barycentric
    /// coordinates: `foot` on the triangulation, `top` at the apex or between the split point and the
    /// apex. `None` if the ray does not start below the surface, or does not reach it.
    #[inline]
    #[must_use]
    pub fn point(&self, cell: usize, foot: [f64; 4], top: [f64; 4]) -> Option<SurfacePoint> {
        let ray = self.ray(cell, foot, top);
        let t = self.first_root(&ray)?;
        let at = std::array::from_fn(|c| foot[c] * (1.0 - t) + top[c] * t);
        let tetrahedron = self.hull.tetrahedron(self.hull.cells[cell]);
        let jet = bernstein::jet(self.degree, self.weights(cell), at);
        let gradient = gradient(jet.first, &tetrahedron.gradients());
        Some(SurfacePoint { point: tetrahedron.point(at), gradient, t, at })
    }

    fn first_root(&self, ray: &[f64; 6]) -> Option<f64> {
        if ray[0] >= 0.0 {
            return (ray[0] == 0.0).then_some(0.0);
        }
        if self.degree == 3 {
            RayCubic([ray[0], ray[1], ray[2], ray[3]]).first_root()
        } else {
            SegmentPolynomial::from_bernstein(self.degree, ray).first_root(|_| true)
        }
    }

    /// Whether a ray crosses the surface once. Values below round-off count as zero.
    pub(crate) fn meets(&self, cell: usize, foot: [f64; 4], top: [f64; 4]) -> Meets {
        let ray = self.ray(cell, foot, top);
        let used = &ray[..=self.degree];
        let largest = used.iter().fold(0.0_f64, |m, b| m.max(b.abs()));
        if used.iter().any(|b| b.is_nan()) {
            return Meets::Wrongly;
        }
        let noise = 64.0 * f64::EPSILON * largest;
        let clean = ray.map(|b| if b.abs() <= noise { 0.0 } else { b });
        if clean[0] > 0.0 {
            // the point is on the other side: there must be none here
            let positive = clean[..=self.degree].iter().all(|b| *b >= 0.0);
            let misses = positive || self.roots(&clean) == 0;
            return if misses { Meets::Elsewhere } else { Meets::Wrongly };
        }
        let mut signs = clean[..=self.degree].iter().copied().filter(|b| *b != 0.0).peekable();
        let rising = signs.peek().is_some_and(|b| *b > 0.0);
        if rising {
            // the ray starts on the surface: nothing may come after
            return if signs.all(|b| b > 0.0) || self.roots(&clean) <= 1 {
                Meets::Once
            } else {
                Meets::Wrongly
            };
        }
        if clean[self.degree] <= 0.0 {
            return Meets::Wrongly;
        }
        let falls =
            clean[..=self.degree].windows(2).skip_while(|p| p[0] <= 0.0).any(|p| p[1] < 0.0);
        if !falls || self.roots(&clean) == 1 { Meets::Once } else { Meets::Wrongly }
    }

    fn roots(&self, ray: &[f64; 6]) -> usize {
        let mut count = 0;
        SegmentPolynomial::from_bernstein(self.degree, ray).first_root(|_| {
            count += 1;
            false
        });
        count
    }

    /// Feet and tops of a grid of rays with `n` steps along each side of a cell.
    pub(crate) fn ray_grid(cell: Cell, n: usize) -> impl Iterator<Item = [[f64; 4]; 2]> {
        let step = move |i: usize| i as f64 / n as f64;
        let face = move || {
            (0..=n).flat_map(move |i| {
                (0..=n - i)
                    .map(move |j| [[step(n - i - j), step(i), step(j), 0.0], [0.0, 0.0, 0.0, 1.0]])
            })
        };
        let edge = move || {
            (0..=n).flat_map(move |i| {
                (0..=n).map(move |j| {
                    [[1.0 - step(i), step(i), 0.0, 0.0], [0.0, 0.0, step(j), 1.0 - step(j)]]
                })
            })
        };
        let is_face = cell.base() == 3;
        is_face.then(face).into_iter().flatten().chain((!is_face).then(edge).into_iter().flatten())
    }

    /// Rays of a grid with `n` steps in every cell that do not meet the surface exactly once, and the
    /// number of all. Where the signs of the weights decide, the rays are only counted.
    #[must_use]
    pub fn count_bad_rays(&self, n: usize) -> [usize; 2] {
        let mut counts = [0, 0];
        for (index, &cell) in self.hull.cells.iter().enumerate() {
            counts[1] += if cell.base() == 3 { (n + 1) * (n + 2) / 2 } else { (n + 1) * (n + 1) };
            counts[0] += self.bad_rays(index, n).count();
        }
        counts
    }

    /// Rays of a cell's grid that do not meet the surface exactly once.
    pub(crate) fn bad_rays(&self, cell: usize, n: usize) -> impl Iterator<Item = [[f64; 4]; 2]> {
        let rays = (!self.is_single_sheet(cell)).then(|| Self::ray_grid(self.hull.cells[cell], n));
        rays.into_iter()
            .flatten()
            .filter(move |&[foot, top]| self.meets(cell, foot, top) == Meets::Wrongly)
    }

    /// Whether the weights change sign once from layer to layer, so that every ray crosses the surface
    /// once \[BCX94 Theorem 2.1\].
    fn is_single_sheet(&self, cell: usize) -> bool {
        let (base, sign) = (self.hull.cells[cell].base(), self.hull.cells[cell].side().sign());
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 6];
        let mut largest = 0.0_f64;
        for (index, weight) in bernstein::indices(self.degree).zip(self.weights(cell)) {
            let [low, high] = &mut bounds[index[base..].iter().sum::<usize>()];
            (*low, *high) = (low.min(sign * weight), high.max(sign * weight));
            largest = largest.max(weight.abs());
        }
        let layers = &bounds[..=self.degree];
        let rising = layers.iter().rposition(|l| l[0] < 0.0);
        let below = rising.is_none_or(|k| layers[..k].iter().all(|l| l[1] <= 0.0));
        below && layers[self.degree][0] > 64.0 * f64::EPSILON * largest
    }
}
