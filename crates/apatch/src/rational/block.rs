//! The building block of all weights next to an edge.

use glam::DVec3;

/// The affine function `N_ab` of an edge `ab`: at any point `X` it is the cubic weight of
/// `p_a p_b X` \[XHB01 (4.10)-(4.12)\].
///
/// It makes the gradient at the middle of the edge, perpendicular to it, the mean of the normals at
/// the ends. All tetrahedra at an edge use the same function: that is why they join smoothly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeBlock {
    middle: DVec3,
    /// At the middle: the mean of the weights `e_ab` (its value at `p_a`) and `e_ba` (at `p_b`).
    value: f64,
    pub(crate) gradient: DVec3,
}

impl EdgeBlock {
    #[inline]
    pub(crate) fn new(ends: [DVec3; 2], normals: [DVec3; 2], weights: [f64; 2]) -> Self {
        let [a, b] = ends;
        let chord = a - b;
        let turn = chord * (3.0 * (weights[0] - weights[1]) / chord.length_squared());
        Self {
            middle: (a + b) * 0.5,
            value: 0.5 * (weights[0] + weights[1]),
            gradient: ((normals[0] + normals[1]) / 3.0 + turn) * 0.5,
        }
    }

    /// Value at a point.
    #[inline]
    pub(crate) fn at(&self, x: DVec3) -> f64 {
        self.value + self.gradient.dot(x - self.middle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENDS: [DVec3; 2] = [DVec3::new(0.1, -0.2, 0.3), DVec3::new(1.1, 0.4, 0.1)];
    const NORMALS: [DVec3; 2] = [DVec3::new(0.2, -0.3, 1.4), DVec3::new(-0.1, 0.5, 0.8)];

    fn block() -> (EdgeBlock, [f64; 2]) {
        let chord = ENDS[1] - ENDS[0];
        let weights = [chord.dot(NORMALS[0]) / 3.0, -chord.dot(NORMALS[1]) / 3.0];
        (EdgeBlock::new(ENDS, NORMALS, weights), weights)
    }

    /// As printed in the paper.
    #[test]
    fn the_printed_formula() {
        let (block, [e_ab, e_ba]) = block();
        let ([a, b], [na, nb]) = (ENDS, NORMALS);
        for x in [DVec3::new(0.7, 2.0, -1.0), DVec3::new(-3.0, 0.2, 0.9), a, b] {
            let alpha = (2.0 * (x - b) + (x - a)).dot(a - b) / (a - b).length_squared();
            let printed = 0.5
                * ((x - a).dot(na) / 3.0
                    + (x - b).dot(nb) / 3.0
                    + alpha * e_ab
                    + (1.0 - alpha) * e_ba);
            assert!((block.at(x) - printed).abs() <= 32.0 * f64::EPSILON, "at {x}");
        }
    }

    #[test]
    fn the_ends_exchanged_give_the_same_bits() {
        let (block, [e_ab, e_ba]) = block();
        let turned = EdgeBlock::new([ENDS[1], ENDS[0]], [NORMALS[1], NORMALS[0]], [e_ba, e_ab]);
        assert_eq!(block, turned);
    }
}
