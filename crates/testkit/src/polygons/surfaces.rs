//! Surfaces of which the distance and the normal are known.

use std::f64::consts::PI;

use glam::DVec3;

/// A surface `f = 0` with unit gradient on it, so that `f` is the distance near by.
#[derive(Clone, Copy, Debug)]
pub struct KnownSurface {
    /// `f`.
    pub distance: fn(DVec3) -> f64,
    /// Gradient of `f`, of length one.
    pub normal: fn(DVec3) -> DVec3,
}

/// Radius 1.
pub const SPHERE: KnownSurface =
    KnownSurface { distance: |p| p.length() - 1.0, normal: |p| p.normalize() };

/// Radius 1, around the z axis.
pub const CYLINDER: KnownSurface = KnownSurface {
    distance: |p| p.truncate().length() - 1.0,
    normal: |p| p.truncate().normalize().extend(0.0),
};

/// Radii 2 and 1.
pub const TORUS: KnownSurface = KnownSurface {
    distance: |p| (p - torus_axis(p)).length() - 1.0,
    normal: |p| (p - torus_axis(p)).normalize(),
};

fn torus_axis(p: DVec3) -> DVec3 {
    (p.truncate().normalize() * 2.0).extend(0.0)
}

/// Apex (0, 0, 1), base circle of radius 1 at z = 0.
pub const CONE: KnownSurface = KnownSurface {
    distance: |p| (p.truncate().length() + p.z - 1.0) * 0.5_f64.sqrt(),
    normal: |p| (p.truncate().normalize().extend(1.0)).normalize(),
};

/// Height of the monkey saddle.
#[must_use]
pub fn monkey(x: f64, y: f64) -> f64 {
    x * x * x - 3.0 * x * y * y
}

/// Height of a wavy sheet.
#[must_use]
pub fn sine(x: f64, y: f64) -> f64 {
    (PI * x).sin() * (PI * y).sin() * 0.3
}

/// The graph of [`monkey`].
pub const MONKEY: KnownSurface = KnownSurface {
    distance: |p| (p.z - monkey(p.x, p.y)) / slope(p).length(),
    normal: |p| slope(p).normalize(),
};

fn slope(p: DVec3) -> DVec3 {
    DVec3::new(3.0 * (p.y * p.y - p.x * p.x), 6.0 * p.x * p.y, 1.0)
}

/// The graph of [`sine`].
pub const SINE: KnownSurface = KnownSurface {
    distance: |p| (p.z - sine(p.x, p.y)) / sine_slope(p).length(),
    normal: |p| sine_slope(p).normalize(),
};

fn sine_slope(p: DVec3) -> DVec3 {
    let ((sx, cx), (sy, cy)) = ((PI * p.x).sin_cos(), (PI * p.y).sin_cos());
    DVec3::new(-0.3 * PI * cx * sy, -0.3 * PI * sx * cy, 1.0)
}
