//! What every field of `implicit` promises.

use glam::DVec3;
use implicit::{Aabb, BoundedField, FieldJet, TwiceDifferentiable};

/// Points spread over a box without pattern, the same in every run (a Weyl sequence whose steps
/// are powers of the root of x⁴ = x + 1).
#[must_use]
pub fn sample_points(region: &Aabb, count: u32) -> Vec<DVec3> {
    const STEPS: DVec3 =
        DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_2);
    let at = |i: u32| region.min + region.size() * (STEPS * f64::from(i + 1)).fract();
    (0..count).map(at).collect()
}

/// All three ways to a value, single and in batches of every length, give the same bits, and the
/// Hessian is symmetric.
///
/// # Panics
/// If not.
pub fn check_consistency(name: &str, field: &dyn TwiceDifferentiable, points: &[DVec3]) {
    let jets: Vec<FieldJet> = points.iter().map(|&p| field.jet(p)).collect();
    for (&p, jet) in points.iter().zip(&jets) {
        let (value, gradient) = field.value_gradient(p);
        assert!(same(field.value(p), jet.value), "{name}: value and jet differ at {p}");
        assert!(same(value, jet.value), "{name}: value_gradient and jet differ at {p}");
        assert!(same_vector(gradient, jet.gradient), "{name}: two gradients at {p}");
        let transposed = jet.hessian.transpose();
        for (column, row) in jet.hessian.to_cols_array().iter().zip(transposed.to_cols_array()) {
            assert!(same(*column, row), "{name}: the Hessian is not symmetric at {p}");
        }
    }
    for count in 0..=points.len() {
        check_batch(name, field, &points[..count], &jets[..count]);
    }
}

fn check_batch(
    name: &str,
    field: &dyn TwiceDifferentiable,
    points: &[DVec3],
    expected: &[FieldJet],
) {
    let count = points.len();
    let mut values = vec![f64::NAN; count];
    let mut gradients = vec![(f64::NAN, DVec3::NAN); count];
    let mut jets = vec![field.jet(DVec3::NAN); count];
    field.values(points, &mut values);
    field.value_gradients(points, &mut gradients);
    field.jets(points, &mut jets);
    for (i, jet) in expected.iter().enumerate() {
        assert!(same(values[i], jet.value), "{name}: values, point {i} of {count}");
        assert!(same(gradients[i].0, jet.value), "{name}: value_gradients, point {i} of {count}");
        assert!(
            same_vector(gradients[i].1, jet.gradient),
            "{name}: gradients, point {i} of {count}"
        );
        let hessians = jets[i].hessian.to_cols_array().into_iter().zip(jet.hessian.to_cols_array());
        assert!(
            same(jets[i].value, jet.value)
                && same_vector(jets[i].gradient, jet.gradient)
                && hessians.into_iter().all(|(a, b)| same(a, b)),
            "{name}: jets, point {i} of {count}"
        );
    }
}

/// Central differences with steps `step` and `step`/2 approach gradient and Hessian with order
/// two, or are exact up to round-off.
///
/// The field must be smooth within `step` of the points.
///
/// # Panics
/// If the observed order is below 1.8.
pub fn check_derivatives(name: &str, field: &dyn TwiceDifferentiable, points: &[DVec3], step: f64) {
    let (mut coarse, mut fine) = (DifferenceError::default(), DifferenceError::default());
    for &p in points {
        coarse.add(field, p, step);
        fine.add(field, p, 0.5 * step);
    }
    let check = |what: &str, coarse: f64, fine: f64, round_off: f64| {
        let order = (coarse / fine).log2();
        assert!(
            fine <= round_off || order >= 1.8,
            "{name}: {what} with order {order}: errors {coarse} and {fine}, round-off {round_off}"
        );
    };
    // a difference of two numbers of this size, each off by a few units, over the step
    let round_off = |size: f64| 32.0 * f64::EPSILON * size / step;
    check("gradient", coarse.gradient, fine.gradient, round_off(fine.value_size));
    check("Hessian", coarse.hessian, fine.hessian, round_off(fine.gradient_size));
}

/// The largest deviations of central differences from the derivatives.
#[derive(Debug, Default)]
struct DifferenceError {
    gradient: f64,
    hessian: f64,
    value_size: f64,
    gradient_size: f64,
}

impl DifferenceError {
    fn add(&mut self, field: &dyn TwiceDifferentiable, p: DVec3, step: f64) {
        let jet = field.jet(p);
        for axis in 0..3 {
            let offset = DVec3::AXES[axis] * step;
            let (ahead, behind) = (field.jet(p + offset), field.jet(p - offset));
            let slope = (ahead.value - behind.value) / (2.0 * step);
            let bend = (ahead.gradient - behind.gradient) / (2.0 * step);
            // unlike f64::max this does not lose NaN
            let raise = |to: &mut f64, by: f64| {
                if by > *to || by.is_nan() {
                    *to = by;
                }
            };
            raise(&mut self.gradient, (slope - jet.gradient[axis]).abs());
            raise(&mut self.hessian, (bend - jet.hessian.col(axis)).abs().max_element());
            raise(&mut self.value_size, ahead.value.abs());
            raise(&mut self.gradient_size, ahead.gradient.abs().max_element());
        }
    }
}

/// The enclosure over `region` contains the values at its corners and at `count` points inside.
///
/// # Panics
/// If not.
pub fn check_enclosure(name: &str, field: &dyn BoundedField, region: &Aabb, count: u32) {
    let enclosure = field.enclosure(region);
    assert!(enclosure.lo <= enclosure.hi, "{name}: {enclosure:?} over {region:?} is empty");
    for p in sample_points(region, count).into_iter().chain(region.corners()) {
        let value = field.value(p);
        assert!(
            enclosure.contains(value) || value.is_nan(),
            "{name}: {value} at {p} is outside {enclosure:?} over {region:?}"
        );
    }
}

/// Around each point the enclosure shrinks at least linearly with the box, from edge length `size`
/// to a sixteenth of it.
///
/// The field must be smooth there.
///
/// # Panics
/// If the observed order is below 0.8.
pub fn check_enclosure_shrinks(name: &str, field: &dyn BoundedField, points: &[DVec3], size: f64) {
    let width = |center: DVec3, size: f64| {
        let half = DVec3::splat(0.5 * size);
        field.enclosure(&Aabb { min: center - half, max: center + half }).width()
    };
    for &p in points {
        let (coarse, fine) = (width(p, size), width(p, size / 16.0));
        let order = (coarse / fine).log2() / 4.0;
        assert!(order >= 0.8, "{name}: order {order} at {p}, widths {coarse} and {fine}");
    }
}

/// The field is positive on the whole boundary of `region` and negative somewhere inside.
///
/// The boundary is proved by enclosures, not sampled.
///
/// # Panics
/// If not, or if 2²⁰ enclosures do not suffice.
pub fn check_encloses_surface(name: &str, field: &dyn BoundedField, region: &Aabb) {
    let inside = sample_points(region, 10_000).into_iter().any(|p| field.value(p) < 0.0);
    assert!(inside, "{name}: no negative value in {region:?}");
    let mut undecided: Vec<Aabb> = Vec::new();
    for axis in 0..3 {
        let (mut low, mut high) = (*region, *region);
        low.max[axis] = region.min[axis];
        high.min[axis] = region.max[axis];
        undecided.extend([low, high]);
    }
    let mut budget = 1 << 20;
    while let Some(face) = undecided.pop() {
        budget -= 1;
        assert!(budget > 0, "{name}: undecided near {face:?}");
        assert!(field.value(face.center()) > 0.0, "{name}: not positive at {}", face.center());
        if field.enclosure(&face).lo <= 0.0 {
            undecided.extend(halves(&face));
        }
    }
}

/// The two halves of a box across its longest edge.
fn halves(region: &Aabb) -> [Aabb; 2] {
    let axis = region.size().max_position();
    let (mut low, mut high) = (*region, *region);
    low.max[axis] = region.center()[axis];
    high.min[axis] = region.center()[axis];
    [low, high]
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

fn same_vector(a: DVec3, b: DVec3) -> bool {
    (0..3).all(|axis| same(a[axis], b[axis]))
}
