//! Lengths that count the turning of the surface normal.

use glam::DVec3;

use super::surface_mesh::SurfaceMesh;
use crate::ids::VertexId;

/// The squared length of an edge is `|Δp|² + scale² |Δn|²`, with positions `p` and unit surface
/// normals `n`.
///
/// A mesh whose edges are equally long in this sense is finer across a ridge than along it, and
/// finer where the surface is more curved; triangles are equilateral where it is flat or round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Metric {
    /// Square of a length.
    scale_squared: f64,
}

impl Metric {
    /// Lengths in space only.
    pub(crate) const SPACE: Self = Self { scale_squared: 0.0 };

    /// The metric in which turning has `weight` times the part of distances in the sum of the squared
    /// lengths of all edges.
    pub(crate) fn with_turning(surface: &SurfaceMesh<'_>, weight: f64) -> Self {
        let mesh = &surface.mesh;
        let (mut space, mut turning) = (0.0, 0.0);
        for h in mesh.edges() {
            let (a, b) = (mesh.origin(h), mesh.target(h));
            space += mesh.position(a).distance_squared(mesh.position(b));
            turning += surface.normal(a).distance_squared(surface.normal(b));
        }
        // a flat mesh has no turning to count
        Self { scale_squared: if turning > 0.0 { weight * space / turning } else { 0.0 } }
    }

    /// Squared length between two points with their unit normals.
    pub(crate) fn between(&self, (p, n): (DVec3, DVec3), (q, m): (DVec3, DVec3)) -> f64 {
        let turning = if self.scale_squared > 0.0 { n.distance_squared(m) } else { 0.0 };
        p.distance_squared(q) + self.scale_squared * turning
    }

    /// Squared length of the edge between two vertices.
    pub(crate) fn squared(&self, surface: &SurfaceMesh<'_>, a: VertexId, b: VertexId) -> f64 {
        let [here, there] = [a, b].map(|v| (surface.mesh.position(v), surface.normal(v)));
        self.between(here, there)
    }

    /// Four times the area of the faces around a vertex.
    pub(crate) fn area(&self, surface: &SurfaceMesh<'_>, v: VertexId) -> f64 {
        let mesh = &surface.mesh;
        let face = |h| {
            let [q, r] = [mesh.target(h), mesh.apex(h)];
            let [a, b, c] = [[q, r], [v, q], [v, r]].map(|[x, y]| self.squared(surface, x, y));
            // Heron's formula
            (2.0 * (a * b + b * c + c * a) - a * a - b * b - c * c).max(0.0).sqrt()
        };
        mesh.fan(v).map(face).sum()
    }
}

/// The sums that lead from a corner `p` to the circumcentre of its triangle.
///
/// `opposite`, `left` and `right` are the squared lengths of the side opposite to `p` and of the
/// sides from `p` to `q` and `r`. Returns 16 times the squared area and the way from `p` to the
/// circumcentre times the same factor; the centre of an obtuse triangle counts as the middle of its
/// longest side.
pub(crate) fn to_circumcentre(
    [p, q, r]: [DVec3; 3],
    [opposite, left, right]: [f64; 3],
) -> (f64, DVec3) {
    // barycentric coordinates of the circumcentre times 16 area²
    let at_p = opposite * (left + right - opposite);
    let at_q = right * (opposite + left - right);
    let at_r = left * (right + opposite - left);
    let area = at_p + at_q + at_r;
    let [at_p, at_q, at_r] = [at_p, at_q, at_r].map(|x| x.max(0.0));
    let inside = at_p + at_q + at_r;
    if area <= 0.0 || inside <= 0.0 {
        return (0.0, DVec3::ZERO);
    }
    (area, (area / inside) * (at_q * (q - p) + at_r * (r - p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn squares([p, q, r]: [DVec3; 3]) -> [f64; 3] {
        [q.distance_squared(r), p.distance_squared(q), p.distance_squared(r)]
    }

    #[test]
    fn circumcentre_of_an_acute_triangle() {
        let centre = DVec3::new(0.3, -0.2, 0.7);
        let triangle = [0.1_f64, 2.2, 4.0]
            .map(|t| centre + 3.0 * DVec3::new(t.cos(), 0.6 * t.sin(), 0.8 * t.sin()));
        let [p, q, r] = triangle;
        let (weight, way) = to_circumcentre(triangle, squares(triangle));
        let area_squared = 0.25 * (q - p).cross(r - p).length_squared();
        assert!((weight / area_squared - 16.0).abs() < 1e-12, "{weight} for {area_squared}");
        assert!((p + way / weight).distance(centre) < 1e-13, "{}", p + way / weight);
    }

    #[test]
    fn obtuse_triangles_have_the_middle_of_their_longest_side() {
        let triangle @ [_, q, r] =
            [DVec3::ZERO, DVec3::new(-2.0, 1.0, 0.0), DVec3::new(3.0, 1.0, 0.0)];
        let (weight, way) = to_circumcentre(triangle, squares(triangle));
        let share = (way / weight - q).length() / (r - q).length();
        assert!((way / weight).y > 1.0 - 1e-12 && share > 0.3 && share < 0.7, "{way} / {weight}");
    }

    #[test]
    fn degenerate_triangles_have_no_weight() {
        let line = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X];
        assert!(to_circumcentre(line, squares(line)).0 <= 0.0, "no area");
    }
}
