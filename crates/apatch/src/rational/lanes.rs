//! Several surface points of one tetrahedron side by side: number `i` of every array belongs to point
//! `i`, and no step depends on how many there are.

use glam::DVec3;

use super::base::BaseLayer;
use super::edge::{EdgePatch, EdgeSide};
use super::face::{FacePatch, FaceSide, ON_SURFACE};
use super::kinds::Side;
use super::points::SurfacePoint;
use crate::cubic_root::first_roots;

/// Points that are found together.
pub(crate) const LANES: usize = 8;

/// Points that wait until there are enough of them: the place of each, and `K` numbers.
#[derive(Clone, Copy)]
pub(crate) struct Queue<const K: usize> {
    count: usize,
    places: [usize; LANES],
    columns: [[f64; LANES]; K],
}

impl<const K: usize> Default for Queue<K> {
    fn default() -> Self {
        Self { count: 0, places: [0; LANES], columns: [[0.0; LANES]; K] }
    }
}

impl<const K: usize> Queue<K> {
    #[inline]
    pub(crate) fn push(&mut self, place: usize, numbers: [f64; K]) {
        self.places[self.count] = place;
        for (column, number) in self.columns.iter_mut().zip(numbers) {
            column[self.count] = number;
        }
        self.count += 1;
    }

    pub(crate) const fn is_full(&self) -> bool {
        self.count == LANES
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Finds the last `N` points, or all if there are fewer, and takes them out.
    #[inline]
    pub(crate) fn empty<const N: usize>(
        &mut self,
        out: &mut [Option<SurfacePoint>],
        solve: impl Fn(&[[f64; N]; K], &mut [Option<SurfacePoint>; N]),
    ) {
        // fewer than N: whatever numbers are left there fill up, and their results are dropped
        let first = self.count.saturating_sub(N);
        let columns = self.columns.each_ref().map(|c| std::array::from_fn(|i| c[first + i]));
        let mut points = [None; N];
        solve(&columns, &mut points);
        for (point, place) in points.into_iter().zip(&self.places[first..self.count]) {
            out[*place] = point;
        }
        self.count = first;
    }
}

/// Points of a triangle, and layer 0 there with its slopes.
pub(crate) struct FaceFeet<const N: usize> {
    pub(crate) x: [[f64; N]; 3],
    pub(crate) value: [f64; N],
    pub(crate) slopes: [[f64; N]; 3],
}

impl<const N: usize> FaceFeet<N> {
    #[inline]
    pub(crate) fn new(base: &BaseLayer, at: &[[f64; 3]; N]) -> Self {
        let mut x = [[0.0; N]; 3];
        for (i, at) in at.iter().enumerate() {
            (x[0][i], x[1][i], x[2][i]) = (at[0], at[1], at[2]);
        }
        let (value, slopes) = base.jets(&x);
        Self { x, value, slopes }
    }

    /// All numbers of one point.
    #[inline]
    pub(crate) fn row(&self, i: usize) -> [f64; 7] {
        let ([x0, x1, x2], [s0, s1, s2]) = (&self.x, &self.slopes);
        [x0[i], x1[i], x2[i], self.value[i], s0[i], s1[i], s2[i]]
    }

    #[inline]
    pub(crate) fn from_rows(&[x0, x1, x2, value, s0, s1, s2]: &[[f64; N]; 7]) -> Self {
        Self { x: [x0, x1, x2], value, slopes: [s0, s1, s2] }
    }
}

/// One tetrahedron over a face.
pub(crate) struct FaceSolver<'a> {
    side: Side,
    s: &'a FaceSide,
    corners: &'a [DVec3; 3],
    gradients: [DVec3; 4],
    /// Values on the triangle up to this count as zero.
    least: f64,
}

impl<'a> FaceSolver<'a> {
    #[inline]
    pub(crate) fn new(patch: &'a FacePatch, side: Side) -> Option<Self> {
        let s = patch.sides[side.index()].as_ref()?;
        let gradients = s.tetrahedron(&patch.corners).gradients();
        let least = ON_SURFACE * s.scale();
        Some(Self { side, s, corners: &patch.corners, gradients, least })
    }

    /// Whether the transversal of a point with this value goes to this side.
    #[inline]
    pub(crate) fn takes(&self, value: f64) -> bool {
        -self.side.sign() * value > self.least
    }

    /// The points over feet that go to this side.
    #[inline]
    pub(crate) fn points<const N: usize>(
        &self,
        feet: &FaceFeet<N>,
        out: &mut [Option<SurfacePoint>; N],
    ) {
        let (v, e, l2) = (&self.s.l1v, &self.s.l1e, &self.s.l2v);
        let (free, sign) = (self.s.free, self.side.sign());
        let x = &feet.x;
        // half the slopes of layer 1, layers 1 and 2
        let mut half = [[0.0; N]; 3];
        let (mut one, mut two) = ([0.0; N], [0.0; N]);
        let mut cubics = [[0.0; N]; 4];
        for i in 0..N {
            let x = [x[0][i], x[1][i], x[2][i]];
            half[0][i] = x[0] * v[0] + x[1] * e[2] + x[2] * e[1];
            half[1][i] = x[1] * v[1] + x[2] * e[0] + x[0] * e[2];
            half[2][i] = x[2] * v[2] + x[0] * e[1] + x[1] * e[0];
            one[i] = x[0] * half[0][i] + x[1] * half[1][i] + x[2] * half[2][i];
            two[i] = x[0] * l2[0] + x[1] * l2[1] + x[2] * l2[2];
            cubics[0][i] = sign * feet.value[i];
            cubics[1][i] = sign * one[i];
            cubics[2][i] = sign * two[i];
            cubics[3][i] = sign * free;
        }
        let roots = first_roots(&cubics);
        let mut slopes = [[0.0; N]; 4];
        for i in 0..N {
            // the layers are homogeneous: at (1 - t) x they are known from x
            let (t, r) = (roots[i], 1.0 - roots[i]);
            for a in 0..3 {
                slopes[a][i] =
                    r * r * feet.slopes[a][i] + 3.0 * t * (2.0 * r * half[a][i] + t * l2[a]);
            }
            slopes[3][i] = 3.0 * (r * r * one[i] + t * (2.0 * r * two[i] + t * free));
        }
        let mut weights = [roots; 4];
        for i in 0..N {
            for a in 0..3 {
                weights[a][i] = x[a][i] * (1.0 - roots[i]);
            }
        }
        let [a, b, c] = *self.corners;
        let corners = [a, b, c, self.s.apex];
        found(self.side, &roots, [&corners, &self.gradients], [&weights, &slopes], out);
    }
}

/// One tetrahedron over an edge.
pub(crate) struct EdgeSolver<'a> {
    pub(crate) side: Side,
    s: &'a EdgeSide,
    weights: [f64; 2],
    corners: [DVec3; 4],
    gradients: [DVec3; 4],
}

impl<'a> EdgeSolver<'a> {
    #[inline]
    pub(crate) fn new(patch: &'a EdgePatch, side: Side) -> Option<Self> {
        let s = patch.sides[side.index()].as_ref()?;
        let tetrahedron = s.tetrahedron(&patch.ends);
        let (corners, gradients) = (tetrahedron.corners, tetrahedron.gradients());
        Some(Self { side, s, weights: patch.weights, corners, gradients })
    }

    /// The points for parameters `x`, `y` that go to this side.
    ///
    /// Written out from [`EdgeSide::jet`] for `k + l = 1`: every part is homogeneous in the ends and in
    /// the apices, so that those of the foot give the slopes at the root.
    #[inline]
    pub(crate) fn points<const N: usize>(
        &self,
        at: &[[f64; N]; 2],
        out: &mut [Option<SurfacePoint>; N],
    ) {
        let (kk, ll) = (&self.s.left, &self.s.right);
        let ([e_ij, e_ji], sign) = (self.weights, self.side.sign());
        let mut cubics = [[0.0; N]; 4];
        // a third of the slopes towards right apex, ends, left apex, by powers of the root
        let mut parts = [[[0.0; N]; 3]; 4];
        for n in 0..N {
            let (i, k) = (at[0][n], at[1][n]);
            let (j, l) = (1.0 - i, 1.0 - k);
            // on the edge
            let (b_i, b_j) = (j * (2.0 * i * e_ij + j * e_ji), i * (i * e_ij + 2.0 * j * e_ji));
            // layer 1 of both faces, and half of its slopes
            let (u_i, u_j) = (k * kk.l1v[0] + l * ll.l1v[0], k * kk.l1v[1] + l * ll.l1v[1]);
            let u_ij = k * kk.l1e + l * ll.l1e;
            let (h_i, h_j) = (i * u_i + j * u_ij, j * u_j + i * u_ij);
            let one_k = i * (i * kk.l1v[0] + 2.0 * j * kk.l1e) + j * j * kk.l1v[1];
            let one_l = i * (i * ll.l1v[0] + 2.0 * j * ll.l1e) + j * j * ll.l1v[1];
            // layer 2, the rational middle, layer 3
            let (w_i, w_j) = (
                k * k * kk.l2v[0]
                    + l * l * ll.l2v[0]
                    + 2.0 * k * l * (k * kk.middle[0] + l * ll.middle[0]),
                k * k * kk.l2v[1]
                    + l * l * ll.l2v[1]
                    + 2.0 * k * l * (k * kk.middle[1] + l * ll.middle[1]),
            );
            let (two_k, two_l) = (i * kk.l2v[0] + j * kk.l2v[1], i * ll.l2v[0] + j * ll.l2v[1]);
            let mid_k = i * kk.middle[0] + j * kk.middle[1];
            let mid_l = i * ll.middle[0] + j * ll.middle[1];
            let mid = k * mid_k + l * mid_l;
            let three_k = k * (k * kk.free + 2.0 * l * kk.inner) + l * l * ll.inner;
            let three_l = l * (l * ll.free + 2.0 * k * ll.inner) + k * k * kk.inner;
            cubics[0][n] = sign * (i * b_i + j * b_j);
            cubics[1][n] = sign * (k * one_k + l * one_l);
            cubics[2][n] = sign * (i * w_i + j * w_j);
            cubics[3][n] = sign * (k * three_k + l * three_l);
            let columns = [
                [one_l, 2.0 * (l * two_l + k * (k * mid + l * mid_l)), three_l],
                [b_i, 2.0 * h_i, w_i],
                [b_j, 2.0 * h_j, w_j],
                [one_k, 2.0 * (k * two_k + l * (l * mid + k * mid_k)), three_k],
            ];
            for (part, column) in parts.iter_mut().zip(columns) {
                (part[0][n], part[1][n], part[2][n]) = (column[0], column[1], column[2]);
            }
        }
        let roots = first_roots(&cubics);
        let (mut slopes, mut weights) = ([[0.0; N]; 4], [[0.0; N]; 4]);
        for n in 0..N {
            let (t, r) = (roots[n], 1.0 - roots[n]);
            for (slope, p) in slopes.iter_mut().zip(&parts) {
                slope[n] = 3.0 * (r * (r * p[0][n] + t * p[1][n]) + t * t * p[2][n]);
            }
            weights[0][n] = t * (1.0 - at[1][n]);
            weights[1][n] = r * at[0][n];
            weights[2][n] = r * (1.0 - at[0][n]);
            weights[3][n] = t * at[1][n];
        }
        found(self.side, &roots, [&self.corners, &self.gradients], [&weights, &slopes], out);
    }
}

/// The points at roots, none where a root is not a number: position and gradient are sums of
/// `vectors` with `factors`.
#[inline]
fn found<const N: usize>(
    side: Side,
    roots: &[f64; N],
    vectors: [&[DVec3; 4]; 2],
    factors: [&[[f64; N]; 4]; 2],
    out: &mut [Option<SurfacePoint>; N],
) {
    let points = combined(vectors[0], factors[0]);
    let gradients = combined(vectors[1], factors[1]);
    for (i, out) in out.iter_mut().enumerate() {
        *out = (roots[i] >= 0.0).then(|| SurfacePoint {
            point: DVec3::new(points[0][i], points[1][i], points[2][i]),
            gradient: DVec3::new(gradients[0][i], gradients[1][i], gradients[2][i]),
            t: roots[i],
            side: (roots[i] > 0.0).then_some(side),
        });
    }
}

/// Sums of four vectors with factors, coordinate by coordinate.
#[inline]
fn combined<const N: usize>(vectors: &[DVec3; 4], factors: &[[f64; N]; 4]) -> [[f64; N]; 3] {
    let [a, b, c, d] = vectors.map(|v| v.to_array());
    let mut sums = [[0.0; N]; 3];
    for i in 0..N {
        for (axis, sum) in sums.iter_mut().enumerate() {
            sum[i] = (factors[0][i] * a[axis] + factors[1][i] * b[axis])
                + (factors[2][i] * c[axis] + factors[3][i] * d[axis]);
        }
    }
    sums
}
