//! An upper bound of the distance from the patches to the zero set, not from samples but from
//! enclosures.
//!
//! A patch `b` is cut into pieces. On a piece around the parameter `c`, Taylor's theorem for
//! `g = f∘b` gives
//!
//! ```text
//! |g(u)| ≤ |g(c)| + max |g'(c) (u - c)| + ½ max |g''| |u - c|²,
//! g'' = bᵤᵀ H bᵥ + ∇f·bᵤᵥ ,
//! ```
//!
//! with gradient and Hessian of `f` enclosed over a box around the piece, and the derivatives of `b`
//! enclosed by those at `c` and bounds of the next higher ones. The two terms of `g''` nearly cancel on
//! a patch that follows the surface, so the last term falls with the cube of the size of a piece. If
//! the slope of `f` along a fixed direction is at least `m` in that box, enlarged by `d`, there
//! is a zero within `|f| / m` of every point of the piece, provided that this is at most `d`.
//! Pieces are cut in four until they are within the goal or as small as allowed.

use basemesh::glam::DVec3;
use basemesh::{FaceId, FaceMap};
use bezier_core::{Barycentric, MultiIndex, ParametricPatch, SepticTriangle};
use implicit::{Aabb, ImplicitSurface, Interval};
use serde::{Deserialize, Serialize};

/// Cuts of a patch in four that [`certify`] is usually called with: up to 4096 pieces, some ten
/// milliseconds.
pub const USUAL_CUTS: usize = 6;
/// Rounding of positions that is allowed for, in units of the last place of the largest coordinate:
/// an evaluation of degree 7 makes fewer errors than that.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A proven bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// No point of the patches that are not listed in `open` is farther from the zero set, in
    /// diagonals.
    pub bound: f64,
    /// The face where the bound is loosest.
    pub loosest_face: usize,
    /// Faces for which no bound was found: too small a gradient, too wild a function, too few cuts.
    pub open: Vec<usize>,
    /// The pieces that were looked at.
    pub pieces: usize,
}

/// Bounds the distance from every point of the patches to the zero set of `field`.
///
/// `goal` is a bound that is good enough, as a length: twice the measured deviation is sensible.
/// Pieces with a larger one are cut, at most `cuts` times; each cut multiplies the work by four and
/// divides the bound by eight until it comes near the deviation. The distance in the other direction,
/// from the zero set to the patches, is not bounded: a piece of surface that the base mesh has missed
/// is not seen.
#[must_use]
pub fn certify(
    nets: &FaceMap<SepticTriangle>,
    field: &dyn ImplicitSurface,
    goal: f64,
    cuts: usize,
    diagonal: f64,
) -> Certificate {
    let faces = FaceMap::from_fn(nets.len(), |face| certify_patch(&nets[face], field, goal, cuts));
    let mut result = Certificate { bound: 0.0, loosest_face: 0, open: Vec::new(), pieces: 0 };
    for (face, &(bound, pieces)) in faces.iter() {
        result.pieces += pieces;
        match bound {
            Some(bound) if bound / diagonal > result.bound => {
                result.bound = bound / diagonal;
                result.loosest_face = face.index();
            }
            Some(_) => {}
            None => result.open.push(FaceId::index(face)),
        }
    }
    result
}

/// The bound of one patch, if there is one, and the number of pieces.
fn certify_patch(
    net: &SepticTriangle,
    field: &dyn ImplicitSurface,
    goal: f64,
    cuts: usize,
) -> (Option<f64>, usize) {
    let third = ThirdDerivatives::of(net);
    let size = net.net().iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let rounding = ROUNDING * size;
    let mut bound = 0.0_f64;
    let mut pieces = 0;
    let mut waiting = vec![(0, [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])];
    while let Some((depth, corners)) = waiting.pop() {
        pieces += 1;
        let found = piece_bound(net, field, &third, corners, rounding);
        match found {
            Some(distance) if distance <= goal || depth == cuts => bound = bound.max(distance),
            None if depth == cuts => return (None, pieces),
            _ => waiting.extend(quarters(corners).map(|quarter| (depth + 1, quarter))),
        }
    }
    (Some(bound), pieces)
}

/// The four triangles between the corners and the middles of the sides.
fn quarters([a, b, c]: [[f64; 2]; 3]) -> [[[f64; 2]; 3]; 4] {
    let middle = |p: [f64; 2], q: [f64; 2]| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// Bounds of the lengths of the third derivatives of a patch, by the number of times that they are
/// taken in `v`.
struct ThirdDerivatives([f64; 4]);

impl ThirdDerivatives {
    /// From the third differences of the control points, whose convex hull the derivatives are in.
    fn of(net: &SepticTriangle) -> Self {
        let degree = SepticTriangle::<DVec3>::DEGREE;
        let factor = (degree * (degree - 1) * (degree - 2)) as f64;
        // differences of the control points in u and in v
        let du = |m: [usize; 3], f: &dyn Fn([usize; 3]) -> DVec3| {
            f([m[0] + 1, m[1], m[2]]) - f([m[0], m[1], m[2] + 1])
        };
        let dv = |m: [usize; 3], f: &dyn Fn([usize; 3]) -> DVec3| {
            f([m[0], m[1] + 1, m[2]]) - f([m[0], m[1], m[2] + 1])
        };
        let point = |m: [usize; 3]| net[MultiIndex::new(m[0], m[1], m[2])];
        let bound = |in_v: usize| {
            let step = |count: usize, m: [usize; 3], f: &dyn Fn([usize; 3]) -> DVec3| {
                if count < in_v { dv(m, f) } else { du(m, f) }
            };
            let first = |m: [usize; 3]| step(0, m, &point);
            let second = |m: [usize; 3]| step(1, m, &first);
            MultiIndex::all(degree - 3)
                .map(|m| factor * step(2, [m.i, m.j, m.k], &second).length())
                .fold(0.0, f64::max)
        };
        Self([0, 1, 2, 3].map(bound))
    }

    /// How far the second derivatives `uu`, `uv`, `vv` can be from those at the centre, at a
    /// distance of at most `du`, `dv` in the parameters.
    fn spread(&self, du: f64, dv: f64) -> [f64; 3] {
        let [uuu, uuv, uvv, vvv] = self.0;
        [uuu * du + uuv * dv, uuv * du + uvv * dv, uvv * du + vvv * dv]
    }
}

/// A vector enclosed by one interval for each coordinate.
type Enclosed = [Interval; 3];

/// All vectors within `radius` of `centre`.
fn around(centre: DVec3, radius: f64) -> Enclosed {
    // one unit in the last place more than the sum, for its rounding
    let radius = radius + f64::EPSILON * centre.abs().max_element();
    centre.to_array().map(|x| Interval::new(x - radius, x + radius))
}

/// The part of a piece that is taken from its patch.
struct Piece {
    /// Largest distances in the parameters from the centre.
    du: f64,
    dv: f64,
    first: [Enclosed; 2],
    second: [Enclosed; 3],
}

impl Piece {
    /// Bound of `½ |g''|` times the squared distance from the centre.
    fn second_order(&self, gradient: &Enclosed, hessian: &[Interval; 6]) -> f64 {
        let [bu, bv] = &self.first;
        let [uu, uv, vv] = &self.second;
        let bend = |a: &Enclosed, b: &Enclosed, second: &Enclosed| {
            magnitude(quadratic(hessian, a, b) + dot(gradient, second))
        };
        0.5 * bend(bu, bu, uu) * self.du * self.du
            + bend(bu, bv, uv) * self.du * self.dv
            + 0.5 * bend(bv, bv, vv) * self.dv * self.dv
    }
}

/// Bound of the distance of a piece, if there is one.
fn piece_bound(
    net: &SepticTriangle,
    field: &dyn ImplicitSurface,
    third: &ThirdDerivatives,
    corners: [[f64; 2]; 3],
    rounding: f64,
) -> Option<f64> {
    let [u, v] = [0, 1].map(|i| (corners[0][i] + corners[1][i] + corners[2][i]) / 3.0);
    let jet = net.jet(Barycentric::new(u, v));
    let (value, gradient) = field.value_gradient(jet.point);
    let slope = gradient.length();
    if !(slope > 0.0 && slope.is_finite() && value.is_finite()) {
        return None;
    }
    let offsets = corners.map(|[s, t]| [s - u, t - v]);
    let [du, dv] = [0, 1].map(|i| offsets.iter().map(|o| o[i].abs()).fold(0.0, f64::max));
    let spread = third.spread(du, dv);
    let [uu, uv, vv] = [(jet.duu, spread[0]), (jet.duv, spread[1]), (jet.dvv, spread[2])];
    let size = |(second, spread): (DVec3, f64)| second.length() + spread;
    let piece = Piece {
        du,
        dv,
        first: [
            around(jet.du, size(uu) * du + size(uv) * dv),
            around(jet.dv, size(uv) * du + size(vv) * dv),
        ],
        second: [uu, uv, vv].map(|(second, spread)| around(second, spread)),
    };
    let bulge = 0.5 * size(uu) * du * du + size(uv) * du * dv + 0.5 * size(vv) * dv * dv;
    let steps = offsets.map(|[s, t]| jet.du * s + jet.dv * t);
    let reach = steps.iter().fold(DVec3::ZERO, |reach, step| reach.max(step.abs()))
        + DVec3::splat(bulge + rounding);
    let region = |margin: DVec3| Aabb { min: jet.point - margin, max: jet.point + margin };
    let near = region(reach);
    let linear = steps.iter().map(|step| gradient.dot(*step).abs()).fold(0.0, f64::max);
    let curved =
        piece.second_order(&field.gradient_enclosure(&near), &field.hessian_enclosure(&near));
    let largest = value.abs() + linear + curved + slope * rounding;
    // room for the way to the surface
    let room = reach.max_element().max(2.0 * value.abs() / slope);
    let enclosed = field.gradient_enclosure(&region(reach + DVec3::splat(room)));
    let direction = gradient / slope;
    let least: f64 = (0..3).map(|axis| smallest(enclosed[axis], direction[axis])).sum();
    // one part in a thousand for the rounding of these lines
    let distance = 1.001 * largest / least;
    (least > 0.0 && distance <= room).then_some(distance)
}

fn magnitude(interval: Interval) -> f64 {
    interval.lo.abs().max(interval.hi.abs())
}

fn dot(a: &Enclosed, b: &Enclosed) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `aᵀ H b` for a symmetric matrix given as xx, yy, zz, xy, yz, zx.
fn quadratic(h: &[Interval; 6], a: &Enclosed, b: &Enclosed) -> Interval {
    let [xx, yy, zz, xy, yz, zx] = *h;
    let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    dot(a, &rows.map(|row| dot(&row, b)))
}

/// Smallest product of a number in an interval with `x`.
fn smallest(interval: Interval, x: f64) -> f64 {
    (interval.lo * x).min(interval.hi * x)
}

#[cfg(test)]
mod tests {
    use implicit::{NamedShape, Sphere};

    use super::*;
    use crate::measure::deviation;
    use crate::{FieldSource, Settings, Silent, fit};

    #[test]
    fn the_bound_is_above_the_measured_deviation_and_of_third_order() {
        for (name, faces) in [("sphere", 200), ("torus", 600)] {
            let shape = NamedShape::find(name).expect("a shape");
            let field = shape.field();
            let settings = Settings::with_faces(faces);
            let surface = fit(&*field, &shape.region, &settings, &mut Silent).expect("a surface");
            let diagonal = surface.mesh.diagonal();
            let source = FieldSource::new(&*field, diagonal, settings.projection);
            let nets = &surface.patches.nets;
            let (measured, _) = deviation(nets, &source, diagonal);
            let goal = 2.0 * measured.max * diagonal;
            let coarse = certify(nets, &*field, goal, 4, diagonal);
            let fine = certify(nets, &*field, goal, 5, diagonal);
            assert!(coarse.open.is_empty() && fine.open.is_empty(), "{name}: {fine:?}");
            assert!(fine.bound >= measured.max, "{name}: {fine:?} {measured:?}");
            assert!(fine.bound <= 5e-5, "{name}: {fine:?} {measured:?}");
            assert!(fine.bound <= coarse.bound / 6.0, "{name}: {fine:?} {coarse:?}");
        }
    }

    /// A flat patch beside the sphere: from 0.05 to 0.0689 outside.
    #[test]
    fn nothing_false_is_proven() {
        let net = SepticTriangle::from_fn(|m| {
            DVec3::new(0.2 * m.i as f64 / 7.0, 0.2 * m.j as f64 / 7.0, 1.05)
        });
        let nets = FaceMap::from_vec(vec![net]);
        let proven = certify(&nets, &Sphere::default(), 0.07, 5, 1.0);
        assert!(proven.open.is_empty(), "{proven:?}");
        let farthest = 0.2_f64.hypot(1.05) - 1.0;
        assert!(proven.bound >= farthest && proven.bound <= 1.2 * farthest, "{proven:?}");
    }
}
