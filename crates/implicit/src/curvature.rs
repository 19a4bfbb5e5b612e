//! Second-order geometry of the zero set.

use glam::{DMat3, DVec3};

use crate::field::TwiceDifferentiable;

/// What the surface looks like at a point: normal and second fundamental form.
///
/// A sphere of radius R with the normal outward has normal curvature −1/R.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfacePoint {
    /// The point.
    pub point: DVec3,
    /// The unit normal N = ∇f/|∇f|, outward.
    pub normal: DVec3,
    /// The second fundamental form as a symmetric matrix, II(a, b) = aᵀ M b with
    /// M = −P H P/|∇f| and P = I − N Nᵀ; one over length, zero along the normal.
    pub second_fundamental_form: DMat3,
}

/// The gradient vanishes, or the value or a derivative is not finite: the surface has no normal or no curvature
/// there.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no normal or curvature at {point}: the gradient is {gradient}")]
pub struct SingularPoint {
    /// The point.
    pub point: DVec3,
    /// The gradient there.
    pub gradient: DVec3,
}

/// The extreme normal curvatures at a point and their directions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PrincipalCurvatures {
    /// The smaller curvature, signed, in one over length.
    pub min: f64,
    /// The larger curvature.
    pub max: f64,
    /// The unit tangent of the smaller one; `direction_min` × `direction_max` is the normal.
    pub direction_min: DVec3,
    /// The unit tangent of the larger one.
    pub direction_max: DVec3,
    /// Whether the two curvatures agree to round-off, so that the directions are any orthonormal
    /// pair of tangents.
    pub umbilic: bool,
}

/// Curvatures that differ by no more than this many units of round-off, relative to the size of
/// the second fundamental form, count as equal.
/// Projecting the Hessian and rotating it into the tangent plane sums about a dozen products, each
/// with one unit.
const UMBILIC_ULPS: f64 = 16.0;

/// Normal and second fundamental form of the level set through `p`, which need not be the zero
/// set.
///
/// # Errors
/// If the gradient is exactly zero, or the value or a derivative is not finite. Nearness to a singular point is
/// no error: the curvature is then large.
///
/// \[TK09 (5)\] with the sign that its Eq. (8) uses and the symmetric P H P: (I − N Nᵀ) H alone is not
/// symmetric, and N is no eigenvector of it.
pub fn surface_point(
    field: &dyn TwiceDifferentiable,
    p: DVec3,
) -> Result<SurfacePoint, SingularPoint> {
    let jet = field.jet(p);
    let slope = jet.gradient.length();
    if !(slope > 0.0 && slope.is_finite() && jet.value.is_finite() && jet.hessian.is_finite()) {
        return Err(SingularPoint { point: p, gradient: jet.gradient });
    }
    let normal = jet.gradient / slope;
    Ok(SurfacePoint {
        point: p,
        normal,
        second_fundamental_form: project_to_tangent(jet.hessian, normal) * (-1.0 / slope),
    })
}

/// P H P for P = I − N Nᵀ, symmetric bit for bit.
fn project_to_tangent(hessian: DMat3, normal: DVec3) -> DMat3 {
    // P H P = H − (w Nᵀ + N wᵀ) with w = H N − N (NᵀH N)/2
    let image = hessian * normal;
    let w = image - normal * (0.5 * normal.dot(image));
    let entry = |i: usize, j: usize| hessian.col(j)[i] - (w[i] * normal[j] + w[j] * normal[i]);
    let (xy, yz, zx) = (entry(0, 1), entry(1, 2), entry(2, 0));
    DMat3::from_cols_array(&[entry(0, 0), xy, zx, xy, entry(1, 1), yz, zx, yz, entry(2, 2)])
}

impl SurfacePoint {
    /// The normal curvature II(t, t)/(t·t) in the direction of `tangent`, which need not have unit
    /// length; its normal component is ignored. NaN if nothing tangential is left.
    #[must_use]
    pub fn normal_curvature(&self, tangent: DVec3) -> f64 {
        let tangent = tangent - self.normal * self.normal.dot(tangent);
        self.second_form(tangent, tangent) / tangent.length_squared()
    }

    /// The second fundamental form II(a, b).
    #[must_use]
    pub fn second_form(&self, a: DVec3, b: DVec3) -> f64 {
        a.dot(self.second_fundamental_form * b)
    }

    /// Principal curvatures and directions.
    ///
    /// At umbilics the directions are some orthonormal tangent pair, always the same for the same
    /// input.
    #[must_use]
    pub fn principal(&self) -> PrincipalCurvatures {
        let (u, v) = self.normal.any_orthonormal_pair();
        let (uu, uv, vv) = (self.second_form(u, u), self.second_form(u, v), self.second_form(v, v));
        let mean = 0.5 * (uu + vv);
        let half_difference = 0.5 * (uu - vv);
        let spread = (half_difference * half_difference + uv * uv).sqrt();
        // the double angle has no branch where the curvatures agree: atan2(0, 0) = 0
        let (sin, cos) = (0.5 * uv.atan2(half_difference)).sin_cos();
        let size = uu.abs() + uv.abs() + vv.abs();
        PrincipalCurvatures {
            min: mean - spread,
            max: mean + spread,
            direction_min: u * sin - v * cos,
            direction_max: u * cos + v * sin,
            umbilic: spread <= UMBILIC_ULPS * f64::EPSILON * size,
        }
    }
}
