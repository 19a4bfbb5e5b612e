//! How much unit normals turn.

use glam::DVec3;

/// Mean direction and spread of unit normals along a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning {
    /// Twice the largest distance of a normal from the mean: the turning of a circular arc, in
    /// radians, for small angles.
    pub angle: f64,
    /// The mean direction, a unit vector.
    pub mean: DVec3,
}

impl Turning {
    /// Mean and spread of at least one unit normal; `None` if they cancel.
    #[must_use]
    pub fn of(normals: &[DVec3]) -> Option<Self> {
        let mean = normals.iter().sum::<DVec3>().try_normalize()?;
        let spread = normals.iter().map(|n| n.distance(mean)).fold(0.0, f64::max);
        Some(Self { angle: 2.0 * spread, mean })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc() {
        let arc = 0.02_f64;
        let normals =
            [-0.5, 0.0, 0.5].map(|s: f64| DVec3::new((s * arc).sin(), 0.0, (s * arc).cos()));
        let turning = Turning::of(&normals).unwrap();
        assert!((turning.angle - arc).abs() <= arc.powi(3));
        assert!(turning.mean.distance(DVec3::Z) <= 2.0 * f64::EPSILON);
        assert_eq!(Turning::of(&[DVec3::X, -DVec3::X]), None);
    }
}
