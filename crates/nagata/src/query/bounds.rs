//! Bounds of the derivatives of a patch, and its box.

use bezier_core::{Barycentric, Corner, LocalEdge, PatchJet};
use glam::DVec3;

use super::piece::Aabb;
use crate::surface::Patch;
use crate::tangent_continuous::G1Triangle;

/// How much a patch bends; parameters are `[b_0, b_1]` or `[η, ζ]`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// Largest second derivative in a unit direction.
    pub second: f64,
    /// Largest change of it a unit of the parameters, apart from `jump`.
    pub third: f64,
    /// Largest change of it at the corners of G1 patches, where it has no limit.
    pub jump: f64,
}

impl Bounds {
    /// Of this patch. Exact inequalities for C0 patches; for G1 patches the part of the corrections is
    /// twice the largest of 25 samples.
    #[must_use]
    pub fn of(patch: &Patch) -> Self {
        match patch {
            Patch::Triangle(_) => Self { second: second(&patch.jet([0.0; 2])), ..Self::default() },
            Patch::Quad(quad) => {
                // second derivatives are linear along sides: the largest are at the corners
                let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                let [.., c21, c12] = quad.monomials();
                Self {
                    second: corners.map(|at| second(&quad.jet(at))).into_iter().fold(0.0, f64::max),
                    third: 4.0 * (c21.length() + c12.length()),
                    jump: 0.0,
                }
            }
            Patch::TangentPlane(triangle) => with_corrections(patch, triangle),
        }
    }
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
    let correction = if has_corrections(triangle) {
        let lattice = Barycentric::lattice(6).filter(|b| b.u.max(b.v).max(b.w) < 1.0);
        let sampled = lattice.map(|at| {
            let mut rest = patch.jet([at.u, at.v]);
            for (weight, jet) in at.to_array().into_iter().zip(&base) {
                rest.duu -= jet.duu * weight;
                rest.duv -= jet.duv * weight;
                rest.dvv -= jet.dvv * weight;
            }
            second(&rest)
        });
        2.0 * sampled.fold(0.0, f64::max)
    } else {
        0.0
    };
    Bounds {
        second: base_second + correction,
        third: change(0, 2) + change(1, 2),
        jump: 2.0 * correction,
    }
}

fn has_corrections(triangle: &G1Triangle) -> bool {
    Corner::ALL.into_iter().any(|corner| {
        let edge = LocalEdge::opposite(corner);
        [0.0, 0.3, 0.5, 0.7, 1.0].iter().any(|u| triangle.correction(edge, *u) != DVec3::ZERO)
    })
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
            // the correction vanishes at the boundary; `jump` is twice its second derivative
            Aabb::around(all).grown(bounds.jump / 8.0)
        }
    }
}

/// Inner control point of the cubic patch between three edge curves.
fn middle_control_point(corners: [DVec3; 3], curvature: &[DVec3; 3]) -> DVec3 {
    corners.into_iter().sum::<DVec3>() / 3.0 - curvature.iter().copied().sum::<DVec3>() / 6.0
}
