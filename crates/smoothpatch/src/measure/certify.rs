//! An upper bound of the distance from the patches to the zero set, not from samples but from
//! enclosures.
//!
//! A patch is cut into pieces. On a piece around the parameter `c`, with a Taylor remainder `R` from
//! bounds of the second derivatives and with the gradient of `f` enclosed in a box `G` around the
//! piece, the mean value theorem gives
//!
//! ```text
//! |f(b(u))| ≤ |f(b(c))| + max |∇f·J (u - c)| + |∇f| |R| + Σ |G_i - ∂_i f| |b(u) - b(c)|_i .
//! ```
//!
//! If the slope of `f` along a fixed direction is at least `m` in that box, enlarged by `d`, there
//! is a zero within `|f| / m` of every point of the piece, provided that this is at most `d`.
//! Pieces are cut in four until they are within the goal or as small as allowed. The last two terms
//! fall with the square of the size of a piece only: the bound stays above the deviation of a good
//! patch unless the pieces are very small.

use basemesh::glam::DVec3;
use basemesh::{FaceId, FaceMap};
use bezier_core::{Barycentric, MultiIndex, ParametricPatch, SepticTriangle};
use implicit::{Aabb, ImplicitSurface, Interval};
use serde::{Deserialize, Serialize};

/// Cuts of a patch in four that [`certify`] is usually called with: up to 1024 pieces, a few
/// milliseconds.
pub const USUAL_CUTS: usize = 5;
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
/// divides the bound by four until it comes near the deviation. The distance in the other direction,
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
    let second = SecondDerivatives::of(net);
    let size = net.net().iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let rounding = ROUNDING * size;
    let mut bound = 0.0_f64;
    let mut pieces = 0;
    let mut waiting = vec![(0, [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])];
    while let Some((depth, corners)) = waiting.pop() {
        pieces += 1;
        let found = piece_bound(net, field, &second, corners, rounding);
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

/// Bounds of the lengths of the second derivatives of a patch.
struct SecondDerivatives {
    uu: f64,
    uv: f64,
    vv: f64,
}

impl SecondDerivatives {
    /// From the second differences of the control points, whose convex hull the derivatives are in.
    fn of(net: &SepticTriangle) -> Self {
        let degree = SepticTriangle::<DVec3>::DEGREE;
        let factor = (degree * (degree - 1)) as f64;
        let largest = |difference: &dyn Fn(MultiIndex) -> DVec3| {
            MultiIndex::all(degree - 2).map(|m| factor * difference(m).length()).fold(0.0, f64::max)
        };
        let at = |m: MultiIndex, i: usize, j: usize, k: usize| {
            net[MultiIndex::new(m.i + i, m.j + j, m.k + k)]
        };
        Self {
            uu: largest(&|m| at(m, 2, 0, 0) - 2.0 * at(m, 1, 0, 1) + at(m, 0, 0, 2)),
            uv: largest(&|m| at(m, 1, 1, 0) - at(m, 1, 0, 1) - at(m, 0, 1, 1) + at(m, 0, 0, 2)),
            vv: largest(&|m| at(m, 0, 2, 0) - 2.0 * at(m, 0, 1, 1) + at(m, 0, 0, 2)),
        }
    }

    /// Bound of the Taylor remainder at a distance of at most `du`, `dv` in the parameters.
    fn remainder(&self, du: f64, dv: f64) -> f64 {
        0.5 * self.uu * du * du + self.uv * du * dv + 0.5 * self.vv * dv * dv
    }
}

/// Bound of the distance of a piece, if there is one.
fn piece_bound(
    net: &SepticTriangle,
    field: &dyn ImplicitSurface,
    second: &SecondDerivatives,
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
    let remainder = second.remainder(du, dv) + rounding;
    let steps = offsets.map(|[s, t]| jet.du * s + jet.dv * t);
    let reach = steps.iter().fold(DVec3::ZERO, |reach, step| reach.max(step.abs()))
        + DVec3::splat(remainder);
    // room for the way to the surface
    let room = reach.max_element().max(2.0 * value.abs() / slope);
    let margin = reach + DVec3::splat(room);
    let region = Aabb { min: jet.point - margin, max: jet.point + margin };
    let enclosed = field.gradient_enclosure(&region);
    let linear = steps.iter().map(|step| gradient.dot(*step).abs()).fold(0.0, f64::max);
    let spread: f64 =
        (0..3).map(|axis| farthest(enclosed[axis], gradient[axis]) * reach[axis]).sum();
    let largest = value.abs() + linear + slope * remainder + spread;
    let direction = gradient / slope;
    let least: f64 = (0..3).map(|axis| smallest(enclosed[axis], direction[axis])).sum();
    // one part in a thousand for the rounding of these lines
    let distance = 1.001 * largest / least;
    (least > 0.0 && distance <= room).then_some(distance)
}

/// Largest distance of a number in an interval from `x`.
fn farthest(interval: Interval, x: f64) -> f64 {
    (interval.hi - x).max(x - interval.lo)
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
    fn the_bound_is_above_the_measured_deviation_and_of_second_order() {
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
            assert!(fine.bound <= 1e-3, "{name}: {fine:?}");
            assert!(fine.bound <= coarse.bound / 3.0, "{name}: {fine:?} {coarse:?}");
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
