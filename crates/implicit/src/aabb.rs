//! Axis-aligned boxes.

use glam::DVec3;

use crate::interval::Interval;

/// An axis-aligned box, both ends included.
///
/// [`new`](Self::new) checks its corners; boxes built field by field are taken as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aabb {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

/// The corners given to [`Aabb::new`] are no box.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no box: the corners {min} and {max} are not finite or not in order")]
pub struct InvalidAabb {
    /// The first corner as it was given.
    pub min: DVec3,
    /// The second corner as it was given.
    pub max: DVec3,
}

impl Aabb {
    /// The box with these corners.
    ///
    /// # Errors
    /// If a coordinate is not finite or `min` exceeds `max` along an axis.
    /// Boxes without extent are allowed.
    pub fn new(min: DVec3, max: DVec3) -> Result<Self, InvalidAabb> {
        if min.is_finite() && max.is_finite() && min.cmple(max).all() {
            Ok(Self { min, max })
        } else {
            Err(InvalidAabb { min, max })
        }
    }

    /// The cube around the origin with half edge length |`half`|.
    #[must_use]
    pub const fn from_half_size(half: f64) -> Self {
        let half = half.abs();
        Self { min: DVec3::splat(-half), max: DVec3::splat(half) }
    }

    /// The smallest box around the points; `None` if there are none or one is not finite.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next()?;
        let mut extent = Self { min: first, max: first };
        let mut finite = first.is_finite();
        for p in points {
            finite &= p.is_finite();
            extent = Self { min: extent.min.min(p), max: extent.max.max(p) };
        }
        finite.then_some(extent)
    }

    /// The midpoint.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.min.midpoint(self.max)
    }

    /// The edge lengths.
    #[must_use]
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// The length of the space diagonal.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// Whether `p` lies in the box, boundary included.
    #[must_use]
    pub fn contains(&self, p: DVec3) -> bool {
        self.min.cmple(p).all() && p.cmple(self.max).all()
    }

    /// The box scaled by `factor` about its center.
    #[must_use]
    pub fn expanded(&self, factor: f64) -> Self {
        let center = self.center();
        let half = self.size() * (0.5 * factor.abs());
        Self { min: center - half, max: center + half }
    }

    /// The smallest box that contains both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The common part; `None` if the boxes do not touch.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        Self::new(self.min.max(other.min), self.max.min(other.max)).ok()
    }

    /// The eight corners; bit k of the index chooses the maximum along axis k.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick =
                |axis: usize| if i >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }

    /// The box as three intervals, the arguments of an interval evaluation.
    #[must_use]
    pub fn intervals(&self) -> [Interval; 3] {
        std::array::from_fn(|axis| Interval { lo: self.min[axis], hi: self.max[axis] })
    }
}
