//! Barycentric coordinates of a tetrahedron and their gradients.

use glam::{DMat3, DVec3};

/// A tetrahedron by its corners, in any orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tetrahedron {
    /// The corners; barycentric coordinates are in the same order.
    pub corners: [DVec3; 4],
}

impl Tetrahedron {
    /// From its corners.
    #[must_use]
    pub const fn new(corners: [DVec3; 4]) -> Self {
        Self { corners }
    }

    /// Six times the signed volume: positive if the last corner sees the first three
    /// counter-clockwise.
    #[inline]
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let [a, b, c, d] = self.corners;
        (b - a).cross(c - a).dot(d - a)
    }

    /// Gradients of the four barycentric coordinates; they add up to zero. Not finite if the
    /// tetrahedron is flat.
    #[inline]
    #[must_use]
    pub fn gradients(&self) -> [DVec3; 4] {
        let [a, b, c, d] = self.corners;
        let (p, q, r) = (b - a, c - a, d - a);
        let (qr, rp, pq) = (q.cross(r), r.cross(p), p.cross(q));
        let scale = 1.0 / p.dot(qr);
        let [gb, gc, gd] = [qr * scale, rp * scale, pq * scale];
        [-(gb + gc + gd), gb, gc, gd]
    }

    /// Barycentric coordinates of a point; they add up to one. Not finite if the tetrahedron is
    /// flat.
    #[inline]
    #[must_use]
    pub fn barycentric(&self, p: DVec3) -> [f64; 4] {
        self.barycentric_by(&self.gradients(), p)
    }

    /// As [`barycentric`](Self::barycentric), with known gradients.
    #[inline]
    pub(crate) fn barycentric_by(&self, gradients: &[DVec3; 4], p: DVec3) -> [f64; 4] {
        // from the nearest corner, so that the small coordinates keep their digits
        let squares = self.corners.map(|corner| corner.distance_squared(p));
        let nearer = |i: usize, j: usize| if squares[j] < squares[i] { j } else { i };
        let near = nearer(nearer(0, 1), nearer(2, 3));
        let offset = p - self.corners[near];
        let mut x = gradients.map(|g| g.dot(offset));
        x[near] += 1.0;
        x
    }

    /// The point with these barycentric coordinates.
    #[inline]
    #[must_use]
    pub fn point(&self, x: [f64; 4]) -> DVec3 {
        let [a, b, c, d] = self.corners;
        a * x[0] + b * x[1] + c * x[2] + d * x[3]
    }

    /// Volume over the cube of the longest edge: how far from flat, without a unit.
    #[must_use]
    pub fn flatness(&self) -> f64 {
        let [a, b, c, d] = self.corners;
        let longest = [a - b, a - c, a - d, b - c, b - d, c - d]
            .map(DVec3::length)
            .into_iter()
            .fold(0.0, f64::max);
        let unit = DMat3::from_cols((b - a) / longest, (c - a) / longest, (d - a) / longest);
        unit.determinant().abs() / 6.0
    }

    /// Lower and upper corner of the bounding box.
    #[must_use]
    pub fn bounding_box(&self) -> [DVec3; 2] {
        let [a, b, c, d] = self.corners;
        [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
    }
}

/// The gradient in space of a function given by its derivatives in the four barycentric
/// coordinates.
#[inline]
pub(crate) fn gradient(derivatives: [f64; 4], gradients: &[DVec3; 4]) -> DVec3 {
    (gradients[0] * derivatives[0] + gradients[1] * derivatives[1])
        + (gradients[2] * derivatives[2] + gradients[3] * derivatives[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_and_gradients_agree() {
        let t = Tetrahedron::new([
            DVec3::new(0.1, 0.2, -0.3),
            DVec3::new(1.2, 0.1, 0.2),
            DVec3::new(0.3, 1.5, 0.1),
            DVec3::new(0.2, 0.4, 0.9),
        ]);
        let x = [0.3, -0.2, 0.5, 0.4];
        let found = t.barycentric(t.point(x));
        for (found, expected) in found.into_iter().zip(x) {
            assert!((found - expected).abs() <= 8.0 * f64::EPSILON, "{found} is not {expected}");
        }
        for (i, g) in t.gradients().into_iter().enumerate() {
            let slope = g.dot(t.corners[(i + 1) % 4] - t.corners[i]);
            assert!((slope + 1.0).abs() <= 16.0 * f64::EPSILON, "coordinate {i}: {slope}");
        }
        assert!(t.determinant() > 0.0 && t.flatness() > 0.01, "a fat tetrahedron");
    }
}
