//! Boxes and the points in them, for the suites about enclosures of derivatives.

use implicit::glam::DVec3;
use implicit::{Aabb, Formula};
use testkit::conformance::field::sample_points;

pub(crate) fn formula(text: &str) -> Formula {
    Formula::parse(text).expect("a formula")
}

/// A cube; without extent for `size` 0.
pub(crate) fn cube(center: DVec3, size: f64) -> Aabb {
    let half = DVec3::splat(0.5 * size);
    Aabb { min: center - half, max: center + half }
}

/// The corners and `count` points inside.
pub(crate) fn samples(region: &Aabb, count: u32) -> impl Iterator<Item = DVec3> {
    let inside = sample_points(region, count).into_iter();
    // the sample may round out of a box that is hardly larger than its distance from zero
    inside.map(|p| p.clamp(region.min, region.max)).chain(region.corners())
}
