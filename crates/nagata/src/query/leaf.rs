//! Bounds of the distances of several patches from a point.

use std::hint::black_box;

use glam::DVec3;

use super::piece::Flat;
use super::tree::WIDTH;
use crate::curvature_parameter::{greater, lesser};
use crate::widest::{Loops, widest};

/// Up to eight neighbouring items, small enough to be read at once.
///
/// Coordinates are relative to the centre, in units of the tree; rounding to single precision is allowed
/// for in `off`.
#[derive(Clone, Debug)]
pub(super) struct Leaf {
    centre: DVec3,
    corners: [Singles; 3],
    curvature: [Singles; 3],
    /// How far the patch may be from the quadratic patch of these numbers, at the same parameters.
    off: [f32; WIDTH],
}

/// Vectors of each lane, component by component.
type Singles = [[f32; WIDTH]; 3];

/// How close a point is to each item: no point is closer than the first distance,
/// one is not farther than the second, up to round-off of the positions.
pub(super) type Reach = [[f64; WIDTH]; 2];

/// Twice the rounding error of a vector in single precision, relative to its length.
const ROUNDING: f64 = f32::EPSILON as f64;

impl Leaf {
    /// Of one to eight items; `scale` is one unit over the length of a unit.
    pub(super) fn new(items: &[Flat], scale: f64) -> Self {
        let centre = items.iter().map(Flat::centre).sum::<DVec3>() / items.len() as f64;
        let mut leaf = Self {
            centre,
            corners: [[[0.0; WIDTH]; 3]; 3],
            curvature: [[[0.0; WIDTH]; 3]; 3],
            off: [0.0; WIDTH],
        };
        for (lane, item) in items.iter().enumerate() {
            let corners = item.corners.map(|p| (p - centre) * scale);
            let curvature = item.curvature.map(|c| c * scale);
            for k in 0..3 {
                set(&mut leaf.corners[k], lane, corners[k]);
                set(&mut leaf.curvature[k], lane, curvature[k]);
            }
            let largest =
                corners.into_iter().chain(curvature).map(DVec3::length).fold(0.0, f64::max);
            let off = item.off_quadratic * scale + ROUNDING * largest;
            leaf.off[lane] = single(off).next_up();
        }
        leaf
    }

    /// Reads a number of each cache line, so that several leaves are waited for together.
    #[inline]
    pub(super) fn fetch(&self) {
        let all = self.corners.iter().chain(&self.curvature).flatten().map(|lanes| lanes[0]);
        black_box((all.sum::<f32>(), self.centre.x, self.off[WIDTH - 1]));
    }

    /// How close `p` is to each patch.
    pub(super) fn reach(&self, p: DVec3, scale: f64) -> Reach {
        widest(Reaching { leaf: self, p: (p - self.centre) * scale, unit: 1.0 / scale })
    }
}

struct Reaching<'a> {
    leaf: &'a Leaf,
    p: DVec3,
    unit: f64,
}

impl Loops for Reaching<'_> {
    type Output = Reach;

    #[inline(always)]
    fn run(self) -> Reach {
        let Leaf { corners, curvature, off, .. } = self.leaf;
        let mut all = [[0.0; WIDTH]; 2];
        for lane in 0..WIDTH {
            let corners = [0, 1, 2].map(|k| get(&corners[k], lane));
            let curvature = [0, 1, 2].map(|k| get(&curvature[k], lane));
            let [lower, upper] = reach(self.p, corners, curvature);
            let off = f64::from(off[lane]);
            all[0][lane] = greater(lower - off, 0.0) * self.unit;
            all[1][lane] = (upper + off) * self.unit;
        }
        all
    }
}

/// The second distance is that of the point of the quadratic patch above the point of the flat triangle
/// which is closest to `p`, the first the least distance in the same direction.
#[inline(always)]
fn reach(p: DVec3, corners: [DVec3; 3], [c0, c1, c2]: [DVec3; 3]) -> [f64; 2] {
    let [a, b, c] = corners;
    let [s, t, u] = closest_weights(p, corners);
    // from the point of the quadratic patch there
    let to = p - (a * s + b * t + c * u) + c0 * (t * u) + c1 * (u * s) + c2 * (s * t);
    let upper = to.length();
    // how far the patch is in this direction: a quadratic polynomial
    let heights = [to.dot(p - a), to.dot(p - b), to.dot(p - c)];
    // no number if all is zero, which `greater` takes for zero
    let lower = lowest(heights, [to.dot(c0), to.dot(c1), to.dot(c2)]) / upper;
    [lower, upper]
}

/// A lower bound of `Σ h_i b_i + Σ g_i b_j b_k` on the triangle: the least Bézier coefficient after all edges
/// are halved.
#[inline(always)]
fn lowest([h0, h1, h2]: [f64; 3], [g0, g1, g2]: [f64; 3]) -> f64 {
    let (m0, m1, m2) = ((h1 + h2 + g0) * 0.5, (h2 + h0 + g1) * 0.5, (h0 + h1 + g2) * 0.5);
    let middle = m0 + m1 + m2;
    let least3 = |a: f64, b: f64, c: f64| lesser(lesser(a, b), c);
    let corners = least3(h0, h1, h2);
    let halves = lesser(least3(h0 + m1, h1 + m2, h2 + m0), least3(h0 + m2, h1 + m0, h2 + m1));
    let on_edges = least3(h0 + 2.0 * m2 + h1, h1 + 2.0 * m0 + h2, h2 + 2.0 * m1 + h0);
    let quarters = lesser(on_edges, corners + middle);
    least3(corners, 0.5 * halves, 0.25 * quarters)
}

/// Barycentric weights of the point of a flat triangle closest to `p`, up to rounding; without branches.
#[inline(always)]
fn closest_weights(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let (ap, bp) = (p - a, p - b);
    let (g11, g12, g22) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
    let (r1, r2) = (ab.dot(ap), ac.dot(ap));
    let determinant = g11 * g22 - g12 * g12;
    let (s, t) = ((g22 * r1 - g12 * r2) / determinant, (g11 * r2 - g12 * r1) / determinant);
    let inside = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0) & (determinant > 0.0);
    // the closest point of each edge, the first one of an edge without length
    let to_c = unit_interval(r2 / g22);
    let to_b = unit_interval(r1 / g11);
    let from_b = unit_interval(bc.dot(bp) / bc.length_squared());
    let (on_ac, on_ab, on_bc) = (
        (ap - ac * to_c).length_squared(),
        (ap - ab * to_b).length_squared(),
        (bp - bc * from_b).length_squared(),
    );
    let select = |first: bool, x: [f64; 2], y: [f64; 2]| {
        [if first { x[0] } else { y[0] }, if first { x[1] } else { y[1] }]
    };
    // weights of b and c
    let best = select(on_ab <= on_ac, [to_b, 0.0], [0.0, to_c]);
    let best = select(on_bc < lesser(on_ab, on_ac), [1.0 - from_b, from_b], best);
    let [s, t] = select(inside, [s, t], best);
    [1.0 - s - t, s, t]
}

/// The nearest number from 0 to 1; 0 for no number.
#[inline(always)]
fn unit_interval(x: f64) -> f64 {
    let x = greater(x, 0.0);
    lesser(x, 1.0)
}

#[inline(always)]
fn get(lanes: &Singles, lane: usize) -> DVec3 {
    let [x, y, z] = lanes;
    DVec3::new(f64::from(x[lane]), f64::from(y[lane]), f64::from(z[lane]))
}

fn set(lanes: &mut Singles, lane: usize, v: DVec3) {
    for (lanes, x) in lanes.iter_mut().zip(v.to_array()) {
        lanes[lane] = single(x);
    }
}

#[allow(clippy::cast_possible_truncation, reason = "rounding is what is wanted")]
fn single(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use basemesh::FaceId;
    use bezier_core::Barycentric;
    use glam::DVec3;

    use super::super::bounds::Bounds;
    use super::*;
    use crate::surface::Patch;
    use crate::triangle::NagataTriangle;

    /// Triangles of all shapes, slivers and single points among them, seen from near and far, against points of
    /// their patches.
    #[test]
    fn closest_points_are_within_reach() {
        const DIVISIONS: usize = 24;
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(99_991);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut vector = |size: f64| DVec3::new(next(), next(), next()) * size;
        let mut tightest = f64::INFINITY;
        for round in 0..100 {
            let at = vector(2.0);
            let items: Vec<Flat> = (0..1 + round % WIDTH)
                .flat_map(|k| {
                    let a = at + vector(0.1);
                    let b = a + vector(0.1) * if k == 5 { 0.0 } else { 1.0 };
                    let c = b + vector(0.1) * if k % 3 == 0 { 1e-9 } else { 1.0 };
                    let curvature = [vector(0.02), vector(0.02), vector(0.02)];
                    let patch = Patch::Triangle(NagataTriangle { corners: [a, b, c], curvature });
                    Flat::all(&patch, Bounds::of(&patch), FaceId::new(k)).collect::<Vec<_>>()
                })
                .collect();
            let unit = 3.0;
            let leaf = Leaf::new(&items, 1.0 / unit);
            for distance in [0.01, 0.1, 1.0, 100.0, 1e9] {
                let p = at + vector(distance);
                let [least, most] = leaf.reach(p, 1.0 / unit);
                for (k, item) in items.iter().enumerate() {
                    let patch = item.quadratic();
                    let points = Barycentric::lattice(DIVISIONS).map(|at| patch.point(at));
                    let found = points.map(|x| x.distance(p)).fold(f64::INFINITY, f64::min);
                    let round_off = 1e-14 * (1.0 + p.length());
                    assert!(least[k] <= found + round_off, "{p}: {} > {found}", least[k]);
                    // between the points of the lattice
                    let spacing = (item.size() + 0.04) / DIVISIONS as f64;
                    assert!(most[k] >= found - spacing - round_off, "{p}: {} < {found}", most[k]);
                    tightest = tightest.min((most[k] - least[k]) / found);
                }
            }
        }
        assert!(tightest < 1e-6, "bounds that tell nothing: {tightest}");
    }

    #[test]
    fn overflow_keeps_all() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let patch = Patch::Triangle(NagataTriangle { corners, curvature: [DVec3::Z * 0.1; 3] });
        let items: Vec<Flat> = Flat::all(&patch, Bounds::of(&patch), FaceId::new(0)).collect();
        let [least, most] = Leaf::new(&items, 1.0).reach(DVec3::splat(1e300), 1.0);
        assert_eq!((least[0], most[0]), (0.0, f64::INFINITY), "no number is no bound");
    }
}
