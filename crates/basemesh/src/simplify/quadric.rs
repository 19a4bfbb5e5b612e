//! Quadric error of a vertex: squared distances to the planes it stands for.

use glam::{DMat3, DVec3};

/// A quadratic form `x·A x + 2 b·x + c` in coordinates relative to its own vertex.
///
/// The reference point is the vertex, not a common origin: the squared distances are of the size
/// of the local features and do not drown in the squared size of the model. Values have the unit
/// length⁴ (squared distance times area).
///
/// Garland and Heckbert, "Surface simplification using quadric error metrics" (1997); the weak
/// pull towards the vertices themselves is ours, see [`Quadric::of_triangle`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadric {
    /// Upper triangle of `A`, by rows.
    a: [f64; 6],
    b: DVec3,
    c: f64,
}

impl Quadric {
    /// One third of the squared distance to the plane of a triangle, weighted by its area, seen from
    /// its corner `p`.
    ///
    /// `isotropy` (dimensionless, about 1e-3) adds that multiple of the squared distance to `p`: in
    /// flat regions, where plane distances decide nothing, it prefers short edges, and it keeps the
    /// 3 × 3 systems regular.
    pub(super) fn of_triangle(p: DVec3, q: DVec3, r: DVec3, isotropy: f64) -> Self {
        let doubled = (q - p).cross(r - p);
        let area = doubled.length();
        if area == 0.0 {
            return Self::default();
        }
        let n = doubled / area;
        let w = area / 6.0;
        let pull = isotropy * w;
        Self {
            a: [
                w * n.x * n.x + pull,
                w * n.x * n.y,
                w * n.x * n.z,
                w * n.y * n.y + pull,
                w * n.y * n.z,
                w * n.z * n.z + pull,
            ],
            b: DVec3::ZERO,
            c: 0.0,
        }
    }

    /// The sum of two forms with the same reference point.
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut a = self.a;
        for (sum, term) in a.iter_mut().zip(other.a) {
            *sum += term;
        }
        Self { a, b: self.b + other.b, c: self.c + other.c }
    }

    /// The same form relative to a reference point that lies `offset` away from the old one.
    pub(super) fn moved_by(&self, offset: DVec3) -> Self {
        let ad = self.times(offset);
        Self { a: self.a, b: self.b + ad, c: self.c + 2.0 * self.b.dot(offset) + offset.dot(ad) }
    }

    /// Value at a point given relative to the reference point; never negative up to rounding.
    pub(super) fn value(&self, x: DVec3) -> f64 {
        x.dot(self.times(x)) + 2.0 * self.b.dot(x) + self.c
    }

    /// Value at a point per unit of area: a mean squared distance.
    ///
    /// Collapses of equal mean error leave a mesh of equal error. By the plain sum, large triangles
    /// of small error would cost as much as small triangles of large error.
    pub(super) fn mean(&self, x: DVec3) -> f64 {
        // the trace of the projector onto a normal is one: the area up to a constant factor
        let [xx, _, _, yy, _, zz] = self.a;
        let area = xx + yy + zz;
        if area > 0.0 { self.value(x).max(0.0) / area } else { 0.0 }
    }

    /// Where the form is smallest, relative to the reference point; `None` if the matrix is
    /// singular to working precision.
    pub(super) fn minimum(&self) -> Option<DVec3> {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let rows = [DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz)];
        let matrix = DMat3::from_cols(
            rows[1].cross(rows[2]),
            rows[2].cross(rows[0]),
            rows[0].cross(rows[1]),
        );
        let determinant = rows[0].dot(matrix.x_axis);
        let size = (xx + yy + zz) / 3.0;
        if determinant <= SINGULAR * size * size * size {
            return None;
        }
        Some(matrix * (-self.b / determinant))
    }

    fn times(&self, v: DVec3) -> DVec3 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        DVec3::new(
            xx * v.x + xy * v.y + xz * v.z,
            xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z,
        )
    }
}

/// Determinant of the matrix relative to the cube of its mean eigenvalue below which it is taken for
/// singular: rounding leaves about 1e-16.
const SINGULAR: f64 = 1e-14;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minimum_of_three_planes_is_their_common_point() {
        let apex = DVec3::new(0.3, -0.2, 0.7);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let reference = DVec3::new(2.0, 1.0, -1.0);
        let mut sum = Quadric::default();
        for k in 0..3 {
            let (u, v) = (axes[k], axes[(k + 1) % 3]);
            let p = apex + 0.5 * u + 2.0 * v;
            let q = Quadric::of_triangle(p, p + u, p + v, 0.0);
            sum = sum.plus(&q.moved_by(reference - p));
        }
        let x = sum.minimum().unwrap();
        assert!((reference + x - apex).length() < 1e-14, "{x}");
        assert!(sum.value(x).abs() < 1e-14, "{}", sum.value(x));
    }

    #[test]
    fn a_single_plane_has_no_minimum_point() {
        let q = Quadric::of_triangle(DVec3::ZERO, DVec3::X, DVec3::Y, 0.0);
        assert!(q.minimum().is_none(), "a plane is a singular form");
        let height = 0.25;
        let expected = height * height / 6.0;
        assert!((q.value(height * DVec3::Z) - expected).abs() < 1e-16, "squared distance by area");
    }
}
