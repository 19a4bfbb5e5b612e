//! Settings of the construction.

/// What to do with the three control points of a patch that no smoothness condition touches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum InnerPoints {
    /// Keep them as the positional patches have them: the published scheme.
    #[default]
    Keep,
    /// Fit them to the surface along its normals.
    PointToPlane,
}

/// Numbers and choices that steer [`join`](crate::join).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settings {
    /// The free inner points.
    pub inner_points: InnerPoints,
}
