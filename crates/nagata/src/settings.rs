//! Settings of the construction; all numbers are dimensionless.

use crate::error::SurfaceError;

/// How smoothly neighbouring patches join.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Continuity {
    /// C0: common edge curves. Triangles and quadrilaterals, polynomials of degree two.
    #[default]
    Position,
    /// G1: common tangent planes as well. Triangles only, rational patches.
    TangentPlane(TangentPlanes),
}

/// How the tangent planes along an edge are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TangentPlanes {
    /// As printed in \[Nagata10\]: the normal turns from `n_j` to `±n_k` in the plane of both. Fails
    /// on edges along which the surface changes from convex to concave.
    Published,
    /// The interpolated normal, made orthogonal to the edge's tangent: works for any edge. Where a
    /// quadratic edge cannot meet the normals, it is replaced by a cubic one. \[ours\]
    #[default]
    Robust,
}

/// When an edge's curvature parameter is accepted; see
/// [`curvature_parameter`](crate::curvature_parameter).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EdgeSettings {
    /// ε: directions with a squared singular value below this times the largest one are left out.
    ///
    /// 1e-14 suits normals with 16 digits, 1e-7 normals with 7 digits: a noise η of the normals
    /// becomes an error η/θ of the tangents, θ the angle between the normals of the ends.
    pub rank: f64,
    /// δ_c: longest accepted curvature parameter, in chords; `None` accepts any \[Nagata10 (2.6)\].
    ///
    /// It must exceed 1: an arc of 90 degrees has exactly 1, one of 120 degrees 1.73.
    pub max_curvature: Option<f64>,
    /// δ_s: longest accepted tangential part of the curvature parameter, in chords; `None` accepts
    /// any. \[ours\]
    ///
    /// Without it, edges along which a surface changes from convex to concave can fold patches over
    /// at any resolution. 0.2 suits general meshes; the eight patches of the ellipsoid of \[Nagata10\],
    /// Figure 3, need 0.447.
    pub max_shear: Option<f64>,
    /// ρ: largest accepted ratio `|C·d| / |d|²`; below 1 both end tangents point forward. `None`
    /// accepts any. \[ours\]
    ///
    /// Values below 1 forbid the exact cones, whose rulings have `C = d`.
    pub max_advance: Option<f64>,
}

impl EdgeSettings {
    /// As in \[Nagata10\]: no limits but ε and δ_c.
    pub const PUBLISHED: Self =
        Self { rank: 1e-14, max_curvature: Some(2.0), max_shear: None, max_advance: None };
}

impl Default for EdgeSettings {
    fn default() -> Self {
        Self { max_shear: Some(0.2), ..Self::PUBLISHED }
    }
}

/// When the correction for common tangent planes is accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CorrectionSettings {
    /// ε_g: rank threshold of the 2x2 system \[Nagata10 (2.74)\]. Values up to 1e-6 make no difference,
    /// larger ones leave kinks.
    pub rank: f64,
    /// Edges with `|c|, |d|` below this times the chord count as straight \[Nagata10 (2.42b)\].
    ///
    /// Zero would take round-off on straight edges for inflections.
    pub straight: f64,
    /// δ_g: longest accepted correction vector, in chords. Regular meshes stay below 1.03, the
    /// octahedron of \[Nagata10\], Figure 3, needs 2.
    pub max_length: f64,
    /// Largest error of an edge's end tangents against the normals, in chords, for which the
    /// quadratic edge is kept; beyond it, [`TangentPlanes::Robust`] takes a cubic edge.
    pub max_misfit: f64,
}

impl Default for CorrectionSettings {
    fn default() -> Self {
        Self { rank: 1e-20, straight: 1e-12, max_length: 10.0, max_misfit: 1e-9 }
    }
}

/// Settings of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settings {
    /// How smoothly neighbouring patches join.
    pub continuity: Continuity,
    /// When an edge's curvature parameter is accepted.
    pub edges: EdgeSettings,
    /// When the correction for common tangent planes is accepted.
    pub correction: CorrectionSettings,
}

impl Settings {
    /// C0 with the recommended settings.
    #[must_use]
    pub fn position() -> Self {
        Self::default()
    }

    /// G1 with the recommended settings.
    ///
    /// Shear is limited to 0.07: cubic edges are at hand, and the normals gain.
    #[must_use]
    pub fn tangent_plane() -> Self {
        Self {
            continuity: Continuity::TangentPlane(TangentPlanes::Robust),
            edges: EdgeSettings { max_shear: Some(0.07), ..EdgeSettings::default() },
            ..Self::default()
        }
    }

    /// G1 as printed in \[Nagata10\].
    #[must_use]
    pub fn published() -> Self {
        Self {
            continuity: Continuity::TangentPlane(TangentPlanes::Published),
            edges: EdgeSettings::PUBLISHED,
            correction: CorrectionSettings::default(),
        }
    }

    /// The misfit, in chords, from which on cubic curves replace quadratic ones; `None` if they never do.
    pub(crate) fn max_misfit(&self) -> Option<f64> {
        (self.continuity == Continuity::TangentPlane(TangentPlanes::Robust))
            .then_some(self.correction.max_misfit)
    }

    /// Refuses numbers with which the construction makes no sense.
    pub(crate) fn check(&self) -> Result<(), SurfaceError> {
        let Self { edges, correction, .. } = self;
        let limits = [
            ("edges.max_curvature", edges.max_curvature),
            ("edges.max_shear", edges.max_shear),
            ("edges.max_advance", edges.max_advance),
            ("edges.rank", Some(edges.rank)),
            ("correction.rank", Some(correction.rank)),
            ("correction.straight", Some(correction.straight)),
            ("correction.max_length", Some(correction.max_length)),
            ("correction.max_misfit", Some(correction.max_misfit)),
        ];
        for (name, value) in limits {
            // NaN is refused as well
            if let Some(value) = value.filter(|v| !(*v >= 0.0 && v.is_finite())) {
                return Err(SurfaceError::Setting {
                    name,
                    value,
                    expected: "finite and not negative",
                });
            }
        }
        Ok(())
    }
}
