//! Fields that count, lie, scale and make noise.

use std::sync::atomic::{AtomicUsize, Ordering};

use basemesh::{PolygonizeError, PolygonizeSettings, TriMesh};
use implicit::glam::DVec3;
use implicit::{Aabb, BoundedField, ImplicitField, Interval};

/// The mesh with `cells` cells along the longest side.
pub(crate) fn mesh_of(
    field: &dyn BoundedField,
    region: &Aabb,
    cells: usize,
) -> Result<TriMesh, PolygonizeError> {
    basemesh::polygonize(field, region, &PolygonizeSettings::with_cells(cells))
}

/// Counts what a field is asked for.
pub(crate) struct Counted<F> {
    pub(crate) field: F,
    pub(crate) values: AtomicUsize,
    pub(crate) enclosures: AtomicUsize,
}

impl<F> Counted<F> {
    pub(crate) fn new(field: F) -> Self {
        Self { field, values: AtomicUsize::new(0), enclosures: AtomicUsize::new(0) }
    }
}

impl<F: BoundedField> ImplicitField for Counted<F> {
    fn value(&self, p: DVec3) -> f64 {
        self.values.fetch_add(1, Ordering::Relaxed);
        self.field.value(p)
    }
    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        self.field.value_gradient(p)
    }
    fn values(&self, points: &[DVec3], out: &mut [f64]) {
        self.values.fetch_add(points.len(), Ordering::Relaxed);
        self.field.values(points, out);
    }
}

impl<F: BoundedField> BoundedField for Counted<F> {
    fn enclosure(&self, region: &Aabb) -> Interval {
        self.enclosures.fetch_add(1, Ordering::Relaxed);
        self.field.enclosure(region)
    }
}

/// A field given by its value alone, with any enclosure.
pub(crate) struct Custom<V, E> {
    pub(crate) value: V,
    pub(crate) enclosure: E,
}

impl<V: Fn(DVec3) -> f64 + Sync, E: Sync> ImplicitField for Custom<V, E> {
    fn value(&self, p: DVec3) -> f64 {
        (self.value)(p)
    }
    fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        ((self.value)(p), DVec3::NAN)
    }
}

impl<V, E> BoundedField for Custom<V, E>
where
    V: Fn(DVec3) -> f64 + Sync,
    E: Fn(&Aabb) -> Interval + Sync,
{
    fn enclosure(&self, region: &Aabb) -> Interval {
        (self.enclosure)(region)
    }
}

/// A field of which nothing is known but its values.
pub(crate) fn unbounded(value: impl Fn(DVec3) -> f64 + Sync) -> impl BoundedField {
    Custom { value, enclosure: |_: &Aabb| Interval::ENTIRE }
}

/// Well mixed bits of a number: the finalizer of SplitMix64.
pub(crate) fn mixed(seed: u64) -> u64 {
    let mut bits = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ bits >> 31
}

/// A number in [0, 1) that depends on a point in no visible way.
pub(crate) fn noise(seed: u64, p: DVec3) -> f64 {
    let bits = p.to_array().iter().fold(seed, |bits, c| mixed(bits ^ c.to_bits()));
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// Signs at the points of a grid with spacing one: `inside` is asked for the indices of a unit cube;
/// all sizes of the values differ, and outside [0, size)³ the field is positive.
#[expect(clippy::cast_possible_truncation, reason = "indices lie in 0..size")]
pub(crate) fn sign_grid(
    size: u32,
    seed: u64,
    inside: impl Fn([u32; 3]) -> bool + Sync,
) -> impl BoundedField {
    unbounded(move |p| {
        let index = p.floor().to_array();
        let within = index.iter().all(|&i| i >= 0.0 && i < f64::from(size));
        let negative = within && inside(index.map(|i| i as u32));
        let size = 0.01 + noise(seed, p);
        if negative { -size } else { size }
    })
}

/// The region for which [`sign_grid`] has one grid node in each unit cube.
pub(crate) fn sign_grid_region(size: u32) -> Aabb {
    Aabb { min: DVec3::ZERO, max: DVec3::splat(f64::from(size)) }
}
