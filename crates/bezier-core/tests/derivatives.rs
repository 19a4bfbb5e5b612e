//! Derivatives against central differences: the observed order is two.

mod common;

use bezier_core::glam::DVec3;
use bezier_core::{
    Barycentric, BezierTriangle, CubicTriangle, ParametricPatch, QuarticTriangle, SepticTriangle,
};
use common::{curve, parameters, triangle};
use proptest::prelude::*;

/// Errors of first and second derivatives with steps `h` and `h / 2` have ratio about four.
fn check_order(
    what: &str,
    error: impl Fn(f64) -> f64,
    round_off: f64,
) -> Result<(), TestCaseError> {
    let (coarse, fine) = (error(2e-3), error(1e-3));
    let order = (coarse / fine).log2();
    prop_assert!(
        fine <= round_off || (1.9..=2.1).contains(&order),
        "{what}: order {order} of {coarse:e}, {fine:e}"
    );
    Ok(())
}

fn check_patch<const P: usize>(
    patch: &BezierTriangle<DVec3, P>,
    at: Barycentric,
) -> Result<(), TestCaseError> {
    let jet = patch.jet(at);
    let shifted = |du: f64, dv: f64| patch.jet(Barycentric::new(at.u + du, at.v + dv));
    // first derivatives from points, second ones from first ones: a difference of numbers below
    // 10⁴, each off by a few units, over the step
    let round_off = 1e4 * f64::EPSILON / 1e-3;
    check_order(
        "du",
        |h| ((shifted(h, 0.0).point - shifted(-h, 0.0).point) / (2.0 * h)).distance(jet.du),
        round_off,
    )?;
    check_order(
        "dv",
        |h| ((shifted(0.0, h).point - shifted(0.0, -h).point) / (2.0 * h)).distance(jet.dv),
        round_off,
    )?;
    check_order(
        "duu",
        |h| ((shifted(h, 0.0).du - shifted(-h, 0.0).du) / (2.0 * h)).distance(jet.duu),
        round_off,
    )?;
    check_order(
        "duv",
        |h| ((shifted(0.0, h).du - shifted(0.0, -h).du) / (2.0 * h)).distance(jet.duv),
        round_off,
    )?;
    check_order(
        "dvu",
        |h| ((shifted(h, 0.0).dv - shifted(-h, 0.0).dv) / (2.0 * h)).distance(jet.duv),
        round_off,
    )?;
    check_order(
        "dvv",
        |h| ((shifted(0.0, h).dv - shifted(0.0, -h).dv) / (2.0 * h)).distance(jet.dvv),
        round_off,
    )
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 100,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn patches(
        septic in triangle::<36>(),
        quartic in triangle::<15>(),
        cubic in triangle::<10>(),
        at in parameters(),
    ) {
        let (septic, quartic, cubic): (SepticTriangle, QuarticTriangle, CubicTriangle) =
            (septic, quartic, cubic);
        check_patch(&septic, at)?;
        check_patch(&quartic, at)?;
        check_patch(&cubic, at)?;
    }

    #[test]
    fn curves(curve in curve::<8>(), t in -0.2..1.2) {
        let jet = curve.jet(t);
        let round_off = 1e4 * f64::EPSILON / 1e-3;
        check_order("first", |h| {
            ((curve.eval(t + h) - curve.eval(t - h)) / (2.0 * h)).distance(jet.first)
        }, round_off)?;
        check_order("second", |h| {
            ((curve.jet(t + h).first - curve.jet(t - h).first) / (2.0 * h)).distance(jet.second)
        }, round_off)?;
    }
}
