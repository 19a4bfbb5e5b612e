//! The surface that a base mesh stands for.

use glam::DVec3;

/// A point of the target surface with its unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// The point on the surface.
    pub point: DVec3,
    /// The unit normal there, pointing outwards.
    pub normal: DVec3,
}

/// A smooth surface that points near it can be moved onto.
///
/// Implementations are pure functions of the point, so that results do not depend on the order or
/// the number of threads. An implicit function is one implementor (projection along its gradient),
/// a surface reconstructed from a mesh another.
pub trait SurfaceTarget: Sync {
    /// A surface point near `near` and the unit normal there; `None` if none was found.
    ///
    /// The point need not be the closest one.
    fn foot(&self, near: DVec3) -> Option<Foot>;

    /// Feet of many points; `feet[i]` belongs to `points[i]`, same values as
    /// [`foot`](Self::foot).
    ///
    /// # Panics
    ///
    /// If the two slices differ in length.
    fn feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        assert_eq!(points.len(), feet.len(), "one foot per point");
        for (point, foot) in points.iter().zip(feet) {
            *foot = self.foot(*point);
        }
    }

    /// Feet of points that are close to the surface already, in one step: both the foot and its
    /// normal are right up to the square of the distance, times the curvature.
    ///
    /// Enough for rounds of fitting, at a fraction of the cost of [`feet`](Self::feet), which is the
    /// default.
    ///
    /// # Panics
    ///
    /// If the two slices differ in length.
    fn linear_feet(&self, points: &[DVec3], feet: &mut [Option<Foot>]) {
        self.feet(points, feet);
    }
}
