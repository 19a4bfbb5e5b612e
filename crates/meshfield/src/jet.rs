//! The surface near one vertex: a polynomial over a tangent plane.

use bezier_core::{PatchJet, SurfaceJet};
use glam::{DQuat, DVec3};
use implicit::Number;

use crate::polynomial::Polynomial;

/// How well the neighbours of a vertex agree with its polynomial.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FitQuality {
    /// Degree of the polynomial; 1 where no polynomial agrees with the faces: then the normal is their
    /// mean, and the curvatures are those that the normals along edges show.
    pub degree: usize,
    /// Points that were used.
    pub points: usize,
    /// Rings of neighbours that these come from.
    pub rings: usize,
    /// Condition number of the scaled equations.
    pub condition: f64,
    /// Weighted root mean square distance of the points from the polynomial, over the radius.
    pub residual: f64,
    /// Largest angle between the polynomial's normals at neighbours along edges and the mean normals of the
    /// faces there. Unit: radians.
    pub normal_error: f64,
    /// Distance of the farthest point in the tangent plane. Unit: length.
    pub radius: f64,
}

/// A polynomial over the tangent plane of a vertex: the surface there is
/// `origin + radius (x X + y Y + f(x, y) Z)`, and `f(0, 0) = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexJet {
    pub(crate) origin: DVec3,
    /// Orthonormal, right-handed; the third is nearly the normal.
    pub(crate) axes: [DVec3; 3],
    pub(crate) polynomial: Polynomial,
    pub(crate) quality: FitQuality,
}

impl VertexJet {
    /// How well it fits.
    #[must_use]
    pub fn quality(&self) -> &FitQuality {
        &self.quality
    }

    /// Position, normal and second fundamental form at the vertex.
    #[must_use]
    pub fn surface_jet(&self) -> Option<SurfaceJet> {
        let [x, y, z] = self.axes;
        let c = |a, b| self.polynomial.coefficient(a, b);
        let bend = 1.0 / self.quality.radius;
        PatchJet {
            point: self.origin,
            du: x + z * c(1, 0),
            dv: y + z * c(0, 1),
            duu: z * (2.0 * c(2, 0) * bend),
            duv: z * (c(1, 1) * bend),
            dvv: z * (2.0 * c(0, 2) * bend),
        }
        .surface_jet()
    }

    /// The same polynomial turned about its vertex, so that its unit normal there is this one.
    #[must_use]
    pub fn turned_to(&self, normal: DVec3) -> Option<Self> {
        let turn = DQuat::from_rotation_arc(self.surface_jet()?.normal, normal);
        let axes = self.axes.map(|axis| turn * axis);
        axes.iter().all(|axis| axis.is_finite()).then_some(Self { axes, ..*self })
    }

    /// Unit normal of the polynomial under or over a point.
    pub(crate) fn normal_at(&self, p: DVec3) -> Option<DVec3> {
        let height = self.height(implicit::Jet1::variables(p.to_array()));
        DVec3::from_array(height.gradient).try_normalize()
    }

    /// Height of a point over the polynomial, along the third axis. Unit: length.
    #[inline]
    pub(crate) fn height<T: Number>(&self, p: [T; 3]) -> T {
        let radius = self.quality.radius;
        let [x, y, z] = self.axes.map(|axis| along(p, self.origin, axis) / radius);
        (z - self.polynomial.eval(x, y)) * radius
    }
}

/// `(p - origin) · direction`.
#[inline]
pub(crate) fn along<T: Number>(p: [T; 3], origin: DVec3, direction: DVec3) -> T {
    let [x, y, z] = p;
    (x - origin.x) * direction.x + (y - origin.y) * direction.y + (z - origin.z) * direction.z
}
