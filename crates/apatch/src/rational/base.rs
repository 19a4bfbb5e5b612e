//! The function on the triangle itself: layer 0 of a face's tetrahedra.

/// The other two corners, counter-clockwise.
#[inline]
pub(crate) const fn others(corner: usize) -> [usize; 2] {
    [[1, 2], [2, 0], [0, 1]][corner]
}

/// Layer 0: a rational cubic (convex faces), or a cubic on each third of the triangle (nonconvex
/// faces).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseLayer {
    /// `e_ab` and `e_ac` for each corner `a`, `b` and `c` following it.
    e: [[f64; 2]; 3],
    /// The middle weight as each edge wants it, by opposite corner.
    g: [f64; 3],
    split: Option<Split>,
}

/// Weights of the Clough-Tocher split at the centroid `C`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Next to the corners: `V_a V_a C`.
    pub d: [f64; 3],
    /// In the thirds: `V_a V_b C`, by opposite corner.
    pub m: [f64; 3],
    /// Towards the centroid: `V_a C C`.
    pub r: [f64; 3],
    /// At the centroid: `C C C`.
    pub q: f64,
}

impl BaseLayer {
    /// From the weights on the edges and the middle weights by opposite corner.
    #[inline]
    pub(crate) fn new(e: [[f64; 2]; 3], g: [f64; 3], split: bool) -> Self {
        Self { e, g, split: split.then(|| Split::new(&e, &g)) }
    }

    /// `e_ab` and `e_ac` for each corner `a`, `b` and `c` following it.
    #[inline]
    pub(crate) const fn edge_weights(&self) -> &[[f64; 2]; 3] {
        &self.e
    }

    /// The weight of `V_a V_a V_b`.
    #[inline]
    #[must_use]
    pub fn edge_weight(&self, a: usize, b: usize) -> f64 {
        self.e[a][usize::from(others(a)[1] == b)]
    }

    /// The weight of `V_0 V_1 V_2` as each edge wants it, by opposite corner.
    #[inline]
    #[must_use]
    pub const fn middle_weights(&self) -> [f64; 3] {
        self.g
    }

    /// Whether it is a cubic on each third of the triangle.
    #[inline]
    #[must_use]
    pub const fn is_split(&self) -> bool {
        self.split.is_some()
    }

    /// Weights of the split at the centroid; `None` for the rational form.
    #[inline]
    #[must_use]
    pub const fn split(&self) -> Option<&Split> {
        self.split.as_ref()
    }

    /// Value at barycentric coordinates of the triangle.
    #[inline]
    #[must_use]
    pub fn value(&self, x: [f64; 3]) -> f64 {
        match &self.split {
            None => self.rational_value(x),
            Some(split) => self.third(split, third_of(x), x).0,
        }
    }

    /// The value of [`rational`](Self::rational) alone.
    #[inline]
    fn rational_value(&self, x: [f64; 3]) -> f64 {
        self.rational(x).0
    }

    /// Value and derivatives, as a homogeneous cubic in the three coordinates.
    #[inline]
    #[must_use]
    pub fn jet(&self, x: [f64; 3]) -> (f64, [f64; 3]) {
        match &self.split {
            None => self.rational(x),
            Some(split) => self.third(split, third_of(x), x),
        }
    }

    /// As [`jet`](Self::jet) for several points side by side: the same bits.
    #[inline]
    pub(crate) fn jets<const N: usize>(&self, x: &[[f64; N]; 3]) -> ([f64; N], [[f64; N]; 3]) {
        let (mut values, mut slopes) = ([0.0; N], [[0.0; N]; 3]);
        let mut set = |i: usize, (value, [s0, s1, s2]): (f64, [f64; 3])| {
            values[i] = value;
            (slopes[0][i], slopes[1][i], slopes[2][i]) = (s0, s1, s2);
        };
        match &self.split {
            None => (0..N).for_each(|i| set(i, self.rational([x[0][i], x[1][i], x[2][i]]))),
            Some(split) => (0..N).for_each(|i| {
                let x = [x[0][i], x[1][i], x[2][i]];
                set(i, self.third(split, third_of(x), x));
            }),
        }
        (values, slopes)
    }

    /// The denominator of the rational form.
    #[inline]
    pub(crate) fn denominator(x: [f64; 3]) -> f64 {
        x[1] * x[2] + x[2] * x[0] + x[0] * x[1]
    }

    /// `Σ 3 x_a² x_b e_ab + 6 Σ g_c x_c S_c² / ΣS_c` with `S_c = x_a x_b`; as
    /// `x_c S_c = x_0 x_1 x_2` the second term is `6 x_0 x_1 x_2` times a mean of the `g_c`.
    /// Where the denominator vanishes, so does the term with its derivatives.
    #[inline(always)]
    fn rational(&self, x: [f64; 3]) -> (f64, [f64; 3]) {
        let ([e0, e1, e2], g) = (&self.e, &self.g);
        let sums =
            [x[1] * e0[0] + x[2] * e0[1], x[2] * e1[0] + x[0] * e1[1], x[0] * e2[0] + x[1] * e2[1]];
        let squares = [3.0 * x[0] * x[0], 3.0 * x[1] * x[1], 3.0 * x[2] * x[2]];
        let edges = squares[0] * sums[0] + squares[1] * sums[1] + squares[2] * sums[2];
        let s = [x[1] * x[2], x[2] * x[0], x[0] * x[1]];
        let total = s[0] + s[1] + s[2];
        let share = if total == 0.0 { 0.0 } else { 1.0 / total };
        let product = x[0] * s[0];
        let mean = (g[0] * s[0] + g[1] * s[1] + g[2] * s[2]) * share;
        let d = [g[0] - mean, g[1] - mean, g[2] - mean];
        let part = product * share;
        let slopes = [
            6.0 * (x[0] * sums[0] + s[0] * mean + part * (d[1] * x[2] + d[2] * x[1]))
                + (squares[1] * e1[1] + squares[2] * e2[0]),
            6.0 * (x[1] * sums[1] + s[1] * mean + part * (d[2] * x[0] + d[0] * x[2]))
                + (squares[2] * e2[1] + squares[0] * e0[0]),
            6.0 * (x[2] * sums[2] + s[2] * mean + part * (d[0] * x[1] + d[1] * x[0]))
                + (squares[0] * e0[1] + squares[1] * e1[0]),
        ];
        (edges + 6.0 * product * mean, slopes)
    }

    /// The cubic on the third opposite to the corner `c`. Always inlined, so that the slopes cost nothing
    /// where only the value is used.
    #[inline(always)]
    fn third(&self, split: &Split, c: usize, x: [f64; 3]) -> (f64, [f64; 3]) {
        let [a, b] = others(c);
        let (y, z, h) = (x[a] - x[c], x[b] - x[c], 3.0 * x[c]);
        let (e_ab, e_ba) = (self.e[a][0], self.e[b][1]);
        let (d_a, d_b, m) = (split.d[a], split.d[b], split.m[c]);
        let (r_a, r_b, q) = (split.r[a], split.r[b], split.q);
        // layers by powers of h
        let edge = 3.0 * y * z * (y * e_ab + z * e_ba);
        let next = 3.0 * (y * (y * d_a + 2.0 * z * m) + z * z * d_b);
        let inner = 3.0 * (y * r_a + z * r_b);
        let value = edge + h * (next + h * (inner + h * q));
        let dy =
            3.0 * z * (2.0 * y * e_ab + z * e_ba) + h * (6.0 * (y * d_a + z * m) + h * (3.0 * r_a));
        let dz =
            3.0 * y * (y * e_ab + 2.0 * z * e_ba) + h * (6.0 * (y * m + z * d_b) + h * (3.0 * r_b));
        let dh = next + h * (2.0 * inner + h * (3.0 * q));
        let mut slopes = [0.0; 3];
        (slopes[a], slopes[b], slopes[c]) = (dy, dz, 3.0 * dh - dy - dz);
        (value, slopes)
    }
}

/// Which third of the split triangle holds these coordinates, by opposite corner.
#[inline]
fn third_of(x: [f64; 3]) -> usize {
    if x[0] <= x[1] && x[0] <= x[2] {
        0
    } else if x[1] <= x[2] {
        1
    } else {
        2
    }
}

impl Split {
    /// The C1 cubic on the three thirds \[XHB01 4.2\]. The weights `m` are those of the edges'
    /// blocks at `C`, a third of the way from the middle of the edge to the corner.
    #[inline]
    fn new(e: &[[f64; 2]; 3], g: &[f64; 3]) -> Self {
        let m: [f64; 3] = std::array::from_fn(|c| {
            let [a, b] = others(c);
            (e[a][0] + e[b][1] + g[c]) / 3.0
        });
        let d = e.map(|[e_ab, e_ac]| (e_ab + e_ac) / 3.0);
        let r = std::array::from_fn(|a| {
            let [b, c] = others(a);
            (d[a] + (m[b] + m[c])) / 3.0
        });
        Self { d, m, r, q: (r[0] + r[1] + r[2]) / 3.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(split: bool) -> BaseLayer {
        let e = [[0.3, -0.7], [0.2, 0.9], [-0.4, 0.1]];
        BaseLayer::new(e, [0.4, -0.3, 0.6], split)
    }

    /// Value and gradient agree on the lines from the corners to the centroid.
    #[test]
    fn the_thirds_join_smoothly() {
        let layer = layer(true);
        let split = layer.split.unwrap();
        for a in 0..3 {
            let [b, c] = others(a);
            for s in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let mut x = [s / 3.0; 3];
                x[a] = 1.0 - 2.0 * s / 3.0;
                let [one, two] = [b, c].map(|third| layer.third(&split, third, x));
                assert!((one.0 - two.0).abs() <= 1e-15, "value at {x:?}");
                for i in 0..3 {
                    assert!((one.1[i] - two.1[i]).abs() <= 4e-15, "slope {i} at {x:?}");
                }
            }
        }
    }

    #[test]
    fn slopes_are_derivatives() {
        for layer in [layer(false), layer(true)] {
            let x = [0.2, 0.5, 0.3];
            let (value, slopes) = layer.jet(x);
            assert_eq!(layer.value(x).to_bits(), value.to_bits(), "the value alone");
            // Euler's identity of homogeneous cubics
            let sum: f64 = (0..3).map(|i| x[i] * slopes[i]).sum();
            assert!((sum - 3.0 * value).abs() <= 1e-15, "{sum} {value}");
            let difference = |h: f64, i: usize| {
                let mut ends = [x, x];
                (ends[0][i], ends[1][i]) = (x[i] + h, x[i] - h);
                (layer.value(ends[0]) - layer.value(ends[1])) / (2.0 * h)
            };
            for (i, slope) in slopes.into_iter().enumerate() {
                // the error of central differences falls by four when the step is halved
                let [coarse, fine] = [1e-2, 5e-3].map(|h| difference(h, i) - slope);
                assert!(fine.abs() <= 0.3 * coarse.abs() + 1e-12, "slope {i}: {coarse} {fine}");
            }
        }
    }
}
