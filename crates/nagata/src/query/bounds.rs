//! Bounds of the derivatives of a patch, and its box.

use bezier_core::{Barycentric, Corner, LocalEdge, PatchJet};
use glam::DVec3;

use super::piece::Aabb;
use crate::blend::{largest_second, largest_value};
use crate::surface::Patch;
use crate::tangent_continuous::G1Triangle;

/// How much a patch bends; parameters are `[b_0, b_1]` or `[η, ζ]`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// Farthest that the patch is from the flat triangle of its corners; from the flat triangles
    /// `[0, 1, 3]` and `[1, 2, 3]` of its corners if it is a quadrilateral. A piece of the patch with half
    /// the size in the parameters is four times nearer to that of its own corners.
    pub bulge: f64,
    /// Largest second derivative in a unit direction.
    pub second: f64,
    /// Largest change of it a unit of the parameters, apart from `jump`.
    pub third: f64,
    /// Largest change of it at the corners of G1 patches, where it has no limit.
    pub jump: f64,
    /// Farthest that a G1 patch is from the quadratic patch with the same corners and curvature parameters,
    /// at the same parameters.
    pub off_quadratic: f64,
}

impl Bounds {
    /// Of this patch. Inequalities; but if the normal along an edge of a G1 patch nearly vanishes, as that
    /// of an edge which turns by about 180 degrees, the part of the corrections is twice the largest of 25
    /// samples.
    #[must_use]
    pub fn of(patch: &Patch) -> Self {
        match patch {
            Patch::Triangle(triangle) => Self {
                bulge: bow(&triangle.curvature),
                second: second(&patch.jet([0.0; 2])),
                ..Self::default()
            },
            Patch::Quad(quad) => {
                // second derivatives are linear along sides: the largest are at the corners
                let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                let [.., c21, c12] = quad.monomials();
                let second =
                    corners.map(|at| second(&quad.jet(at))).into_iter().fold(0.0, f64::max);
                Self {
                    bulge: SAGGING * second,
                    second,
                    third: 4.0 * (c21.length() + c12.length()),
                    ..Self::default()
                }
            }
            Patch::TangentPlane(triangle) => with_corrections(patch, triangle),
        }
    }
}

/// A function with second derivatives up to `M` is within `½ M Σ b_i b_j |e_ij|²` of the linear function
/// with the same values at the corners; for legs of length one the sum is at most a half.
const SAGGING: f64 = 0.25;

/// Bound of `|Σ C_i b_j b_k|`: the sum of the products of the parameters is at most a third.
fn bow(curvature: &[DVec3; 3]) -> f64 {
    curvature.iter().map(|c| c.length_squared()).fold(0.0, f64::max).sqrt() / 3.0
}

/// Bound of `|D²x[v, v]|` for unit vectors `v`.
fn second(jet: &PatchJet) -> f64 {
    jet.duu.length().max(jet.dvv.length()) + jet.duv.length()
}

fn with_corrections(patch: &Patch, triangle: &G1Triangle) -> Bounds {
    // at the corners there is no correction; that of the base patch is linear
    let base = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]].map(|at| patch.jet(at));
    let base_second = base.iter().map(second).fold(0.0, f64::max);
    let change = |a: usize, b: usize| second(&difference(&base[a], &base[b]));
    let (value, correction) = triangle.correction_bounds().map_or_else(
        || sampled(patch, &base),
        |bounds| (largest_value(bounds[0]), largest_second(bounds)),
    );
    let skews: f64 = triangle.edges().iter().map(|edge| edge.skew.length()).sum();
    let second = base_second + correction;
    Bounds {
        bulge: SAGGING * second,
        second,
        third: change(0, 2) + change(1, 2),
        jump: 2.0 * correction,
        off_quadratic: value + LARGEST_SKEW * skews,
    }
}

/// Bound of `b_j b_k |b_j - b_k|`: `√3/18`.
const LARGEST_SKEW: f64 = 0.0963;

/// Estimates of the largest correction and its second derivatives.
fn sampled(patch: &Patch, base: &[PatchJet; 3]) -> (f64, f64) {
    let lattice = Barycentric::lattice(6).filter(|b| b.u.max(b.v).max(b.w) < 1.0);
    let samples = lattice.map(|at| {
        let mut rest = patch.jet([at.u, at.v]);
        for (weight, jet) in at.to_array().into_iter().zip(base) {
            rest.duu -= jet.duu * weight;
            rest.duv -= jet.duv * weight;
            rest.dvv -= jet.dvv * weight;
        }
        second(&rest)
    });
    let largest = 2.0 * samples.fold(0.0, f64::max);
    // it vanishes at the corners
    (SAGGING * largest, largest)
}

fn difference(a: &PatchJet, b: &PatchJet) -> PatchJet {
    PatchJet { duu: a.duu - b.duu, duv: a.duv - b.duv, dvv: a.dvv - b.dvv, ..*a }
}

/// A box around a patch with these bounds, from Bézier control points.
pub(super) fn aabb(patch: &Patch, bounds: &Bounds) -> Aabb {
    match patch {
        Patch::Triangle(p) => Aabb::around(*p.bezier().net()),
        Patch::Quad(p) => {
            let (corners, c) = (p.corners, p.curvature);
            let middles = [0, 1, 2, 3].map(|s| (corners[s] + corners[(s + 1) % 4] - c[s]) * 0.5);
            // biquadratic control point in the middle
            let all = corners.into_iter().sum::<DVec3>() - c.into_iter().sum::<DVec3>();
            Aabb::around(corners.into_iter().chain(middles).chain([all * 0.25]))
        }
        Patch::TangentPlane(p) => {
            let corners = p.corners();
            let edges = Corner::ALL.map(|corner| {
                let edge = LocalEdge::opposite(corner);
                let ends = [edge.start(), edge.end()].map(|end| corners[end.index()]);
                p.edges()[corner.index()].bezier(ends).points
            });
            let middle = middle_control_point(corners, &p.edges().map(|edge| edge.curvature));
            let all = edges.into_iter().flatten().chain([middle]);
            Aabb::around(all).grown(bounds.off_quadratic)
        }
    }
}

/// Inner control point of the cubic patch between three edge curves.
fn middle_control_point(corners: [DVec3; 3], curvature: &[DVec3; 3]) -> DVec3 {
    corners.into_iter().sum::<DVec3>() / 3.0 - curvature.iter().copied().sum::<DVec3>() / 6.0
}
