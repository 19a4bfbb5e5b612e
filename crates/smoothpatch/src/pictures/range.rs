//! Which numbers the colours of a picture stand for.

use basemesh::glam::DVec2;
use render::{ColourMap, Domain, Hit, Patches, Scale, Value};

/// Decades of a scale for deviations, at most.
const DECADES: i32 = 4;
/// The part of the numbers at each end that colours need not tell apart.
const TAIL: f64 = 0.01;

/// The numbers at inner points of all patches, in ascending order; not finite ones are left out.
#[must_use]
pub fn values(patches: &dyn Patches, value: Value<'_>) -> Vec<f64> {
    let mut values: Vec<f64> = (0..patches.count())
        .flat_map(|patch| inner_points(patches.domain(patch)).map(move |at| (patch, at)))
        .filter_map(|(patch, at)| {
            let point = patches.surface_point(patch, at);
            let normal = point.normal.normalize_or_zero();
            value(&Hit { patch, at, point: point.point, normal })
        })
        .filter(|value| value.is_finite())
        .collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Ten points of a triangle, sixteen of a square.
fn inner_points(domain: Domain) -> impl Iterator<Item = DVec2> {
    let last = move |row: u32| if domain == Domain::Triangle { 4 - row } else { 4 };
    let place = |step: u32| (f64::from(step) + 0.35) / 4.1;
    (0..4).flat_map(move |j| (0..last(j)).map(move |i| DVec2::new(place(i), place(j))))
}

/// A scale around zero that tells all numbers apart but for one in a hundred at each end; `None` without
/// numbers.
#[must_use]
pub fn symmetric_scale(ascending: &[f64]) -> Option<Scale> {
    let (low, high) = (quantile(ascending, TAIL)?, quantile(ascending, 1.0 - TAIL)?);
    let end = low.abs().max(high.abs());
    Some(Scale { low: -end, high: end, logarithmic: false, map: ColourMap::Diverging })
}

/// A scale in powers of ten up to the largest number, with four of them at most; `None` if no number is
/// above zero.
#[must_use]
pub fn deviation_scale(ascending: &[f64]) -> Option<Scale> {
    let exponent = |value: f64, round: fn(f64) -> f64| {
        #[allow(clippy::cast_possible_truncation, reason = "exponents of numbers are small")]
        (value > 0.0).then(|| round(value.log10()) as i32)
    };
    let high = exponent(*ascending.last()?, f64::ceil)?;
    let typical = exponent(quantile(ascending, 0.05)?, f64::floor).unwrap_or(high - DECADES);
    let low = typical.clamp(high - DECADES, high - 1);
    let [low, high] = [low, high].map(|exponent| 10.0_f64.powi(exponent));
    Some(Scale { low, high, logarithmic: true, map: ColourMap::Sequential })
}

fn quantile(ascending: &[f64], part: f64) -> Option<f64> {
    let last = ascending.len().checked_sub(1)?;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    ascending.get((part * last as f64).round() as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_points_are_inside() {
        for (domain, count) in [(Domain::Triangle, 10), (Domain::Square, 16)] {
            let points: Vec<DVec2> = inner_points(domain).collect();
            assert_eq!(points.len(), count, "{domain:?}");
            let inside = |p: &DVec2| {
                p.min_element() > 0.0
                    && if domain == Domain::Triangle {
                        p.x + p.y < 1.0
                    } else {
                        p.max_element() < 1.0
                    }
            };
            assert!(points.iter().all(inside), "{points:?}");
        }
    }

    #[test]
    fn scales_hold_what_is_usual() {
        let scale = deviation_scale(&[0.0, 2e-9, 3e-8, 4e-7]).expect("a scale");
        assert!((scale.low * 1e10 - 1.0).abs() < 1e-9, "four decades: {scale:?}");
        assert!((scale.high * 1e6 - 1.0).abs() < 1e-9, "above the largest: {scale:?}");
        let narrow = deviation_scale(&[2e-7, 4e-7]).expect("a scale");
        assert!((narrow.low * 1e7 - 1.0).abs() < 1e-9, "one decade: {narrow:?}");
        assert_eq!(deviation_scale(&[0.0]), None, "nothing to see");
        let symmetric = symmetric_scale(&[-3.0, 1.0]).expect("a scale");
        assert_eq!((symmetric.low, symmetric.high), (-3.0, 3.0));
    }
}
