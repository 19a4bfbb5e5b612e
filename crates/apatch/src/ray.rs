//! Rays in space and their way through tetrahedra.

use glam::DVec3;

use crate::tetrahedron::Tetrahedron;

/// A half-line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; its length is the unit of distances along the ray.
    pub direction: DVec3,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit<C> {
    /// Distance from the origin in lengths of the ray's direction.
    pub distance: f64,
    /// Position.
    pub point: DVec3,
    /// Gradient of the function: normal to the surface, not of unit length.
    pub gradient: DVec3,
    /// The cell.
    pub cell: C,
}

/// A stretch of a ray inside a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    /// Distances at its ends.
    pub(crate) distances: [f64; 2],
    /// Barycentric coordinates at its ends.
    pub(crate) ends: [[f64; 4]; 2],
}

/// How far outside of a tetrahedron, in barycentric coordinates, still counts as inside: rays that
/// run along a common side must not slip through between neighbours.
const MARGIN: f64 = 1e-12;

impl Ray {
    /// The point at a distance, in lengths of the direction.
    #[must_use]
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }

    /// Where the ray enters a box, if it does before `far`.
    #[inline]
    #[must_use]
    pub fn enters(&self, [low, high]: [DVec3; 2], far: f64) -> Option<f64> {
        let (mut near, mut far) = (0.0_f64, far);
        for axis in 0..3 {
            let (o, d) = (self.origin[axis], self.direction[axis]);
            if d == 0.0 {
                if o < low[axis] || o > high[axis] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low[axis] - o) / d, (high[axis] - o) / d);
            near = near.max(a.min(b));
            far = far.min(a.max(b));
        }
        (near <= far).then_some(near)
    }

    /// Where the ray meets a triangle, with the normal of the triangle, not of unit length.
    pub(crate) fn meets(&self, [a, b, c]: [DVec3; 3]) -> Option<(f64, DVec3)> {
        let normal = (b - a).cross(c - a);
        let distance = (a - self.origin).dot(normal) / self.direction.dot(normal);
        // also false where the ray is parallel to the plane
        if !(distance >= 0.0 && distance.is_finite()) {
            return None;
        }
        let (point, area) = (self.at(distance), normal.length_squared());
        let sees = |p: DVec3, q: DVec3| (q - p).cross(point - p).dot(normal) >= -MARGIN * area;
        (sees(a, b) && sees(b, c) && sees(c, a)).then_some((distance, normal))
    }

    /// The part of the ray inside a tetrahedron.
    pub(crate) fn inside(&self, tetrahedron: &Tetrahedron) -> Option<Stretch> {
        let start = tetrahedron.barycentric(self.origin);
        let speed = tetrahedron.gradients().map(|g| g.dot(self.direction));
        let (mut near, mut far) = (0.0_f64, f64::INFINITY);
        for (&x, &v) in start.iter().zip(&speed) {
            let cross = -(x + MARGIN) / v;
            if v > 0.0 {
                near = near.max(cross);
            } else if v < 0.0 {
                far = far.min(cross);
            } else if x < -MARGIN {
                return None;
            }
        }
        // also false for numbers that are not finite: flat tetrahedra have no inside
        if !(near < far && far.is_finite()) {
            return None;
        }
        let distances = [near, far];
        let ends = distances.map(|s| tetrahedron.barycentric(self.at(s)));
        Some(Stretch { distances, ends })
    }
}

impl Stretch {
    /// Barycentric coordinates at a parameter from 0 to 1.
    #[inline]
    pub(crate) fn at(&self, s: f64) -> [f64; 4] {
        let [a, b] = &self.ends;
        std::array::from_fn(|i| a[i] * (1.0 - s) + b[i] * s)
    }

    /// The part between two parameters.
    pub(crate) fn part(&self, from: f64, to: f64) -> Self {
        let distance = |s: f64| self.distances[0] * (1.0 - s) + self.distances[1] * s;
        Self { distances: [distance(from), distance(to)], ends: [self.at(from), self.at(to)] }
    }
}
