//! Second-order data of surfaces: of a parametrisation, and of the surface itself.

use glam::{DMat3, DVec3};

/// Point and partial derivatives of a patch with respect to `(u, v)`, where `w = 1 - u - v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchJet {
    /// Position.
    pub point: DVec3,
    /// First derivative in `u`.
    pub du: DVec3,
    /// First derivative in `v`.
    pub dv: DVec3,
    /// Second derivative in `u`.
    pub duu: DVec3,
    /// Mixed second derivative.
    pub duv: DVec3,
    /// Second derivative in `v`.
    pub dvv: DVec3,
}

/// Coefficients of a quadratic form `e du² + 2 f du dv + g dv²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FundamentalForm {
    /// Coefficient of `du²`.
    pub uu: f64,
    /// Half the coefficient of `du dv`.
    pub uv: f64,
    /// Coefficient of `dv²`.
    pub vv: f64,
}

impl FundamentalForm {
    /// Value of the bilinear form on two parameter directions `(du, dv)`.
    #[must_use]
    pub fn apply(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        self.uu * a[0] * b[0] + self.uv * (a[0] * b[1] + a[1] * b[0]) + self.vv * a[1] * b[1]
    }

    /// Determinant `uu vv - uv²`.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.uu * self.vv - self.uv * self.uv
    }
}

impl PatchJet {
    /// `du × dv`: its length is the area element, its direction the outward side.
    #[inline]
    #[must_use]
    pub fn area_normal(&self) -> DVec3 {
        self.du.cross(self.dv)
    }

    /// Unit normal, outward for counter-clockwise corners; `None` where the first derivatives are
    /// parallel.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> Option<DVec3> {
        self.area_normal().try_normalize()
    }

    /// First fundamental form (E, F, G).
    #[must_use]
    pub fn first_form(&self) -> FundamentalForm {
        FundamentalForm {
            uu: self.du.length_squared(),
            uv: self.du.dot(self.dv),
            vv: self.dv.length_squared(),
        }
    }

    /// Second fundamental form (L, M, N); `None` without a normal.
    #[must_use]
    pub fn second_form(&self) -> Option<FundamentalForm> {
        let n = self.normal()?;
        Some(FundamentalForm { uu: self.duu.dot(n), uv: self.duv.dot(n), vv: self.dvv.dot(n) })
    }

    /// Position, normal and shape of the surface, independent of the parametrisation; `None`
    /// without a normal.
    #[must_use]
    pub fn surface_jet(&self) -> Option<SurfaceJet> {
        let normal = self.normal()?;
        let second = self.second_form()?;
        let first = self.first_form();
        let det = first.determinant();
        // rows of the pseudo-inverse of [du dv]: tangent vector -> parameter direction
        let to_u = (self.du * first.vv - self.dv * first.uv) / det;
        let to_v = (self.dv * first.uu - self.du * first.uv) / det;
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        let form = outer(to_u, to_u) * second.uu
            + (outer(to_u, to_v) + outer(to_v, to_u)) * second.uv
            + outer(to_v, to_v) * second.vv;
        Some(SurfaceJet { point: self.point, normal, second_fundamental_form: form })
    }
}

/// Geometric second-order data of a surface at a point.
///
/// The second fundamental form is stored as the symmetric matrix `S` with `II(a, b) = aᵀ S b` for
/// tangent vectors, `S N = 0`. Its sign is that of `q''·N` for curves in the surface: a sphere of
/// radius R with outward normals has normal curvature `-1/R`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfaceJet {
    /// Position.
    pub point: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    /// Symmetric matrix of the second fundamental form.
    pub second_fundamental_form: DMat3,
}

impl SurfaceJet {
    /// `II(a, b)` of two tangent vectors; unit: length when `a` and `b` are lengths.
    #[inline]
    #[must_use]
    pub fn second_form(&self, a: DVec3, b: DVec3) -> f64 {
        a.dot(self.second_fundamental_form * b)
    }

    /// Normal curvature in the direction of a unit tangent vector; unit: 1 / length.
    #[inline]
    #[must_use]
    pub fn normal_curvature(&self, tangent: DVec3) -> f64 {
        self.second_form(tangent, tangent)
    }

    /// The smallest and the largest normal curvature; unit: 1 / length.
    #[must_use]
    pub fn principal_curvatures(&self) -> [f64; 2] {
        let (u, v) = self.normal.any_orthonormal_pair();
        let [uu, uv, vv] = [(u, u), (u, v), (v, v)].map(|(a, b)| self.second_form(a, b));
        let mean = 0.5 * (uu + vv);
        let half_difference = (0.5 * (uu - vv)).hypot(uv);
        [mean - half_difference, mean + half_difference]
    }

    /// The part of `v` that is tangent to the surface.
    #[inline]
    #[must_use]
    pub fn tangential(&self, v: DVec3) -> DVec3 {
        v - self.normal * v.dot(self.normal)
    }
}
