//! The C0 patch of a quadrilateral: the eight-node serendipity element.

use bezier_core::PatchJet;
use glam::DVec3;

use crate::curvature_parameter::one_each;
use crate::sample::{Row, fill_rows};
use crate::settings::EdgeSettings;
use crate::triangle::corner_direction;
use crate::unit::cross_direction;

/// The patch over a quadrilateral with corners `P_0 … P_3`, counter-clockwise seen from outside, at
/// the parameters `(η, ζ)` = (0, 0), (1, 0), (1, 1), (0, 1) \[Nagata10, section 2.1\]:
///
/// ```text
/// x = bilinear(P) - C_0 η(1-η)(1-ζ) - C_1 ζ(1-ζ)η - C_2 η(1-η)ζ - C_3 ζ(1-ζ)(1-η)
/// ```
///
/// `C_s` is the curvature parameter of the side that starts at corner `s`. On a side it takes the
/// values of [`EdgeCurve::point`](crate::EdgeCurve::point) bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NagataQuad {
    /// Corners, counter-clockwise seen from outside.
    pub corners: [DVec3; 4],
    /// Curvature parameter of the side that starts at each corner.
    pub curvature: [DVec3; 4],
}

impl NagataQuad {
    /// A patch from one unit normal at each corner.
    #[must_use]
    pub fn from_normals(corners: [DVec3; 4], normals: [DVec3; 4], settings: &EdgeSettings) -> Self {
        let curvature = std::array::from_fn(|s| {
            let e = (s + 1) % 4;
            one_each(corners[e] - corners[s], [normals[s], normals[e]], settings).value
        });
        Self { corners, curvature }
    }

    /// The point at the parameters `[η, ζ]`.
    #[inline]
    #[must_use]
    pub fn point(&self, [eta, zeta]: [f64; 2]) -> DVec3 {
        let [p00, p10, p11, p01] = self.corners;
        let [c0, c1, c2, c3] = self.curvature;
        let (e, z) = (1.0 - eta, 1.0 - zeta);
        let flat = p00 * (e * z) + p10 * (eta * z) + p11 * (eta * zeta) + p01 * (e * zeta);
        let (bow_eta, bow_zeta) = (e * eta, z * zeta);
        flat - (c0 * (bow_eta * z)
            + c1 * (bow_zeta * eta)
            + c2 * (bow_eta * zeta)
            + c3 * (bow_zeta * e))
    }

    /// Point and derivatives to second order; `u` is η and `v` is ζ here.
    #[must_use]
    pub fn jet(&self, [eta, zeta]: [f64; 2]) -> PatchJet {
        let [_, c10, c01, c11, c20, c02, c21, c12] = self.monomials();
        PatchJet {
            point: self.point([eta, zeta]),
            du: c10 + c20 * (2.0 * eta) + (c11 + c21 * (2.0 * eta) + c12 * zeta) * zeta,
            dv: c01 + c02 * (2.0 * zeta) + (c11 + c12 * (2.0 * zeta) + c21 * eta) * eta,
            duu: (c20 + c21 * zeta) * 2.0,
            duv: c11 + c21 * (2.0 * eta) + c12 * (2.0 * zeta),
            dvv: (c02 + c12 * eta) * 2.0,
        }
    }

    /// `x_η × x_ζ`: its length is the area element; zero where the patch is singular.
    #[inline]
    #[must_use]
    pub fn area_normal(&self, at: [f64; 2]) -> DVec3 {
        self.jet(at).area_normal()
    }

    /// Unit normal at a corner, counted from 0; `None` if the tangents of its two sides are parallel or
    /// vanish.
    ///
    /// # Panics
    ///
    /// If there is no such corner.
    #[must_use]
    pub fn corner_normal(&self, corner: usize) -> Option<DVec3> {
        let (next, previous) = ((corner + 1) % 4, (corner + 3) % 4);
        let leaving = self.corners[next] - self.corners[corner];
        let arriving = self.corners[previous] - self.corners[corner];
        let normal = (leaving - self.curvature[corner]).cross(arriving - self.curvature[previous]);
        corner_direction(normal, [leaving, arriving])
    }

    /// Unit normal, outward for counter-clockwise corners; `None` where the patch is singular.
    #[inline]
    #[must_use]
    pub fn normal(&self, at: [f64; 2]) -> Option<DVec3> {
        let PatchJet { du, dv, .. } = self.jet(at);
        let size = self.corners.into_iter().fold(DVec3::ZERO, |all, p| all.max(p.abs()));
        cross_direction(du, dv, size.max_element())
    }

    /// Coefficients `[c00, c10, c01, c11, c20, c02, c21, c12]`; `c_mn` belongs to `η^m ζ^n`.
    #[must_use]
    pub fn monomials(&self) -> [DVec3; 8] {
        let [p00, p10, p11, p01] = self.corners;
        let [c1, c2, c3, c4] = self.curvature;
        [
            p00,
            p10 - p00 - c1,
            p01 - p00 - c4,
            (p00 - p10) + (p11 - p01) + (c1 - c2 - c3 + c4),
            c1,
            c4,
            c3 - c1,
            c2 - c4,
        ]
    }

    /// Mid-side nodes, by the corner where their side starts: with the corners, the nodes of the
    /// eight-node serendipity element, which is this patch exactly.
    #[must_use]
    pub fn mid_side_nodes(&self) -> [DVec3; 4] {
        std::array::from_fn(|s| {
            (self.corners[s] + self.corners[(s + 1) % 4]) * 0.5 - self.curvature[s] * 0.25
        })
    }

    /// Points at the regular grid with this many divisions each way, `ζ` running fastest: the fast
    /// road, equal to [`point`](Self::point) to round-off.
    ///
    /// # Panics
    ///
    /// If `divisions` is zero or `points` has not the length `(divisions + 1)²`.
    pub fn sample(&self, divisions: usize, points: &mut [DVec3]) {
        assert!(divisions >= 1, "a grid needs at least one division");
        let side = divisions + 1;
        assert_eq!(points.len(), side * side, "one point for each grid point");
        let [c00, c10, c01, c11, c20, c02, c21, c12] = self.monomials();
        let row = |eta: f64| Row {
            constant: c00 + (c10 + c20 * eta) * eta,
            linear: c01 + (c11 + c21 * eta) * eta,
            quadratic: c02 + c12 * eta,
        };
        fill_rows([points], divisions, |_| side, |eta| [row(eta)]);
    }
}
