//! Which objective chooses where constraints leave freedom.
//!
//! The smoothness conditions are the same in every case and hold exactly; what differs is the
//! solution that is picked. Choices are made per face and per edge, so that a patch that turns out
//! badly can be done again in another way without touching the rest.

use basemesh::{EdgeMap, FaceMap, Topology};

/// How a positional patch is fitted; its twist points and rows are what the smooth one starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Fill {
    /// Degree 7, fifteen free points: the published scheme.
    Septic,
    /// Degree 4, three free points, elevated: the mismatch between the parameters of curves and
    /// samples is not smeared into the twists.
    Quartic,
}

/// How the first inner rows along an edge are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Rows {
    /// The rows nearest to those of the positional patches: the published scheme.
    Nearest,
    /// The rows whose tangent planes come closest to those of the surface, of low degree along it.
    TangentPlanes,
}

/// What to do with the three control points of a patch that no smoothness condition touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum InnerPoints {
    /// Keep them as the positional patches have them: the published scheme.
    Keep,
    /// Fit them to the surface along its normals.
    PointToPlane,
    /// Make the patch as nearly of degree 5 as the other points allow, then fit it to the surface
    /// along one direction.
    LowDegree,
}

/// The objectives for one whole surface, or for one element of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settings {
    /// Positional patches.
    pub fill: Fill,
    /// First inner rows.
    pub rows: Rows,
    /// Free inner points.
    pub inner_points: InnerPoints,
}

impl Settings {
    /// The published scheme \[TK09\]: nearest solutions. Its smooth surface loses two orders of
    /// approximation against its positional patches.
    pub const PUBLISHED: Self =
        Self { fill: Fill::Septic, rows: Rows::Nearest, inner_points: InnerPoints::Keep };
    /// Our objectives on the same constraints: full order. They need curves that are close to the
    /// surface; with coarse unrefined curves patches can fold.
    pub const REFINED: Self = Self {
        fill: Fill::Quartic,
        rows: Rows::TangentPlanes,
        inner_points: InnerPoints::LowDegree,
    };
}

impl Default for Settings {
    fn default() -> Self {
        Self::REFINED
    }
}

/// The objectives of every element.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Positional patch of each face.
    pub fill: FaceMap<Fill>,
    /// Free inner points of each face.
    pub inner_points: FaceMap<InnerPoints>,
    /// First inner rows along each edge.
    pub rows: EdgeMap<Rows>,
}

impl Plan {
    /// The same objectives everywhere.
    #[must_use]
    pub fn uniform(topology: &Topology, settings: Settings) -> Self {
        Self {
            fill: FaceMap::from_vec(vec![settings.fill; topology.face_count()]),
            inner_points: FaceMap::from_vec(vec![settings.inner_points; topology.face_count()]),
            rows: EdgeMap::from_vec(vec![settings.rows; topology.edge_count()]),
        }
    }
}
