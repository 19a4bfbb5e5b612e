//! Points for random convex solids.

use glam::DVec3;

use crate::Numbers;

/// Points on the unit sphere, evenly distributed; other ones for every seed.
#[must_use]
pub fn sphere_points(seed: u64, count: usize) -> Vec<DVec3> {
    let mut numbers = Numbers::new(seed + 1);
    let mut points = Vec::new();
    while points.len() < count {
        let p = DVec3::new(numbers.signed(), numbers.signed(), numbers.signed());
        if p.length() > 0.1 && p.length() < 1.0 {
            points.push(p.normalize());
        }
    }
    points
}
