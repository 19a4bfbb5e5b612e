//! A partition of unity over the triangles of a mesh.
//!
//! `W_i = Σ_e E_e G_e,i` over the two edges `e` at corner `i`. `E_e` selects the edge: one there, zero
//! on the two others, with two derivatives that vanish. `G_e,i` runs from one at corner `i` to zero at
//! the other end of the edge and depends on the position along the edge in space, so that it is the same
//! function for the two faces of the edge. At an edge, the weights of both faces agree to second order.

use glam::DVec3;
use implicit::Number;

use crate::jet::along;

/// The triangle under a point.
pub(crate) struct Place {
    /// The corners, and their global numbers.
    pub(crate) corners: [DVec3; 3],
    pub(crate) ids: [usize; 3],
    /// Weights of the closest point of the triangle; exactly zero for corners that do not count.
    pub(crate) weights: [f64; 3],
}

/// Weights of the three corners at the point `p`, once as coordinates and once as numbers with
/// derivatives.
pub(crate) fn corner_weights<T: Number>(place: &Place, at: DVec3, p: [T; 3]) -> [T; 3] {
    let mut weights = [T::constant(0.0); 3];
    if let Some(corner) = place.weights.iter().position(|&w| w == 1.0) {
        weights[corner] = T::constant(1.0);
        return weights;
    }
    for (opposite, selector) in edge_selectors(place, p).into_iter().enumerate() {
        let Some(selector) = selector else { continue };
        let [mut i, mut j] = [(opposite + 1) % 3, (opposite + 2) % 3];
        if place.ids[i] > place.ids[j] {
            (i, j) = (j, i);
        }
        let share = share_of_end(place.corners[i], place.corners[j], at, p);
        weights[i] = weights[i] + selector * (-share + 1.0);
        weights[j] = weights[j] + selector * share;
    }
    weights
}

/// How much each edge counts, by its opposite corner; they add up to one.
fn edge_selectors<T: Number>(place: &Place, p: [T; 3]) -> [Option<T>; 3] {
    if let Some(opposite) = place.weights.iter().position(|&w| w == 0.0) {
        let mut selectors = [None; 3];
        selectors[opposite] = Some(T::constant(1.0));
        return selectors;
    }
    let [a, b, c] = place.corners;
    let normal = (b - a).cross(c - a);
    let square = normal.length_squared();
    let barycentric =
        [(b, c), (c, a), (a, b)].map(|(from, to)| along(p, from, normal.cross(to - from) / square));
    let product = |i: usize, j: usize| (barycentric[i] * barycentric[j]).powi(3);
    let products = [product(1, 2), product(2, 0), product(0, 1)];
    let sum = products[0] + products[1] + products[2];
    products.map(|product| Some(product / sum))
}

/// `6 t⁵ - 15 t⁴ + 10 t³` of the position `t` along an edge; constant beyond its ends.
fn share_of_end<T: Number>(start: DVec3, end: DVec3, at: DVec3, p: [T; 3]) -> T {
    let direction = (end - start) / (end - start).length_squared();
    let position = (at - start).dot(direction);
    if position <= 0.0 {
        return T::constant(0.0);
    }
    if position >= 1.0 {
        return T::constant(1.0);
    }
    let t = along(p, start, direction);
    t.powi(3) * ((t * 6.0 - 15.0) * t + 10.0)
}

#[cfg(test)]
mod tests {
    use implicit::Jet2;

    use super::*;

    const CORNERS: [DVec3; 3] =
        [DVec3::ZERO, DVec3::new(1.0, 0.25, 0.0), DVec3::new(0.25, 1.0, 0.5)];

    fn weights_at(weights: [f64; 3]) -> [Jet2; 3] {
        let [a, b, c] = CORNERS;
        let at = a * weights[0] + b * weights[1] + c * weights[2];
        let place = Place { corners: CORNERS, ids: [7, 2, 9], weights };
        corner_weights(&place, at, Jet2::variables(at.to_array()))
    }

    fn size(jet: Jet2) -> f64 {
        jet.gradient.iter().chain(&jet.hessian).fold(0.0, |sum, d| sum + d.abs())
    }

    #[test]
    fn they_add_up_to_one_with_all_derivatives() {
        for weights in [[0.25, 0.25, 0.5], [0.1, 0.7, 0.2], [1e-3, 0.5, 0.499], [0.3, 0.7, 0.0]] {
            let [u, v, w] = weights_at(weights);
            let sum = u + v + w;
            assert!((sum.value - 1.0).abs() < 1e-14, "{weights:?}");
            assert!(size(sum) < 1e-10 * (1.0 + size(u)), "{weights:?}: {sum:?}");
        }
    }

    #[test]
    fn at_an_edge_only_its_position_along_the_edge_counts() {
        let (inside, on_edge) = (weights_at([0.3, 0.7 - 1e-9, 1e-9]), weights_at([0.3, 0.7, 0.0]));
        for corner in 0..3 {
            let difference = inside[corner] - on_edge[corner];
            assert!(difference.value.abs() < 1e-8, "corner {corner}");
            assert!(size(difference) < 1e-6, "corner {corner}: {difference:?}");
        }
        assert_eq!(on_edge[2].value, 0.0, "the third corner does not count");
    }

    #[test]
    fn derivatives_vanish_at_corners() {
        let near = weights_at([1.0 - 3e-6, 1e-6, 2e-6]);
        assert!((near[0].value - 1.0).abs() < 1e-15, "{}", near[0].value);
        assert!(near.into_iter().all(|w| size(w) < 1e-3), "{near:?}");
    }
}
