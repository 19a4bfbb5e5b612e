//! Interval arithmetic: tight where it can be, outward where it must be.

use std::f64::consts::{FRAC_PI_2, PI};

use implicit::{Interval, Number};
use proptest::prelude::*;

/// `result` contains `exact` and exceeds it by no more than `ulps` units at either end.
#[track_caller]
fn check(result: Interval, exact: (f64, f64), ulps: u32) {
    let (mut lo, mut hi) = exact;
    assert!(result.contains(lo) && result.contains(hi), "{result:?} lacks a part of {exact:?}");
    for _ in 0..ulps {
        (lo, hi) = (lo.next_down(), hi.next_up());
    }
    assert!(lo <= result.lo && result.hi <= hi, "{result:?} is wider than {exact:?}");
}

const fn interval(lo: f64, hi: f64) -> Interval {
    Interval { lo, hi }
}

#[test]
fn exact_sums_stay_exact() {
    check(interval(1.0, 2.0) + interval(-4.0, 0.5), (-3.0, 2.5), 0);
    check(interval(1.0, 2.0) - interval(-4.0, 0.5), (0.5, 6.0), 0);
    check(interval(1.0, 2.0) + 1e-20, (1.0, 2.0 + 1e-20), 1);
}

#[test]
fn inexact_results_are_rounded_outward() {
    let [tenth, third] = [0.1, 1.0 / 3.0].map(Interval::constant);
    for (result, below, above) in [
        (tenth + 0.2, 0.3, 0.3_f64.next_up()),
        (tenth * 3.0, 0.3, 0.3_f64.next_up()),
        (Interval::constant(1.0) / 3.0, third.lo, third.lo.next_up()),
        (tenth.square(), 0.01, 0.01_f64.next_up()),
        (Interval::constant(2.0).sqrt(), 2.0_f64.sqrt().next_down(), 2.0_f64.sqrt()),
    ] {
        assert!(result.contains(below) && result.contains(above), "{result:?}");
    }
}

#[test]
fn products_and_quotients() {
    check(interval(-1.0, 2.0) * interval(-3.0, 4.0), (-6.0, 8.0), 1);
    check(interval(0.0, 2.0) * interval(1.0, 4.0), (0.0, 8.0), 1);
    check(interval(1.0, 2.0) / interval(4.0, 8.0), (0.125, 0.5), 1);
    check(interval(-1.0, 2.0) / interval(-8.0, -4.0), (-0.5, 0.25), 1);
    assert_eq!(interval(1.0, 2.0) / interval(-1.0, 1.0), Interval::ENTIRE);
    assert_eq!(interval(1.0, 2.0) / interval(0.0, 1.0), Interval::ENTIRE);
}

#[test]
fn unbounded_intervals_never_give_nan() {
    let half_line = interval(0.0, f64::INFINITY);
    for result in [
        half_line - half_line,
        half_line * 0.0,
        Interval::ENTIRE * half_line,
        interval(1.0, f64::INFINITY) / interval(1.0, f64::INFINITY),
        Interval::ENTIRE.sin(),
        Interval::ENTIRE.tan(),
        Interval::ENTIRE.atan2(half_line),
        Interval::ENTIRE.exp(),
        Interval::ENTIRE.tanh(),
        Interval::ENTIRE.square(),
        half_line.sqrt(),
        half_line.ln(),
        Interval::constant(f64::NAN),
    ] {
        assert!(result.lo <= result.hi, "{result:?}");
    }
    check(half_line * 0.0, (0.0, 0.0), 0);
}

#[test]
fn powers_are_tight() {
    let u = interval(-1.0, 2.0);
    check(u.square(), (0.0, 4.0), 1);
    check(u.powi(4), (0.0, 16.0), 3);
    check(u.powi(3), (-1.0, 8.0), 3);
    check(u.powi(0), (1.0, 1.0), 0);
    check(u.powi(1), (-1.0, 2.0), 0);
    check(interval(2.0, 4.0).powi(-2), (0.0625, 0.25), 3);
    check(interval(-4.0, -2.0).powi(-1), (-0.5, -0.25), 1);
    assert_eq!(u.powi(-1), Interval::ENTIRE);
}

#[test]
fn domains_are_cut_off() {
    check(interval(-1.0, 4.0).sqrt(), (0.0, 2.0), 1);
    check(interval(-1.0, 4.0).powf(0.5), (0.0, 2.0), 4);
    check(interval(-1.0, 1.0).ln(), (f64::NEG_INFINITY, 0.0), 4);
    assert_eq!(interval(-2.0, -1.0).sqrt(), Interval::ENTIRE);
    assert_eq!(interval(-2.0, -1.0).ln(), Interval::ENTIRE);
    assert_eq!(interval(-2.0, -1.0).powf(0.3), Interval::ENTIRE);
}

#[test]
fn waves_find_their_extremes() {
    check(interval(0.0, PI).sin(), (0.0, 1.0), 4);
    check(interval(-0.1, 0.1).cos(), (0.1_f64.cos(), 1.0), 4);
    check(interval(3.0, 3.3).cos(), (-1.0, 3.3_f64.cos()), 4);
    check(interval(0.2, 0.3).sin(), (0.2_f64.sin(), 0.3_f64.sin()), 4);
    // 32 periods and a quarter
    check(interval(102.0, 103.0).sin(), (103.0_f64.sin(), 1.0), 4);
    check(interval(0.0, 7.0).sin(), (-1.0, 1.0), 0);
    check(interval(-1.0, 1.0).tan(), ((-1.0_f64).tan(), 1.0_f64.tan()), 4);
    assert_eq!(interval(1.5, 1.6).tan(), Interval::ENTIRE);
    assert_eq!(interval(FRAC_PI_2, FRAC_PI_2).tan(), Interval::ENTIRE);
}

#[test]
fn angles() {
    check(
        interval(1.0, 2.0).atan2(interval(-1.0, 1.0)),
        (1.0_f64.atan2(1.0), 1.0_f64.atan2(-1.0)),
        4,
    );
    check(interval(-1.0, 1.0).atan2(interval(1.0, 2.0)), (-PI / 4.0, PI / 4.0), 4);
    check(interval(-1.0, 1.0).atan2(interval(-2.0, -1.0)), (-PI, PI), 1);
    check(interval(-1.0, 1.0).atan2(interval(-1.0, 1.0)), (-PI, PI), 1);
}

#[test]
fn ties_and_signs() {
    check(interval(-3.0, 1.0).abs(), (0.0, 3.0), 0);
    check(interval(-3.0, -1.0).abs(), (1.0, 3.0), 0);
    check(interval(-3.0, 1.0).min(interval(-1.0, 0.0)), (-3.0, 0.0), 0);
    check(interval(-3.0, 1.0).max(interval(-1.0, 0.0)), (-1.0, 1.0), 0);
}

proptest! {
    #[test]
    fn every_function_contains_its_values(
        (a, b) in (-30.0..30.0_f64, -30.0..30.0_f64),
        (c, d) in (-30.0..30.0_f64, -30.0..30.0_f64),
        (s, t) in (0.0..=1.0_f64, 0.0..=1.0_f64),
    ) {
        let (u, v) = (Interval::new(a, b), Interval::new(c, d));
        let x = (u.lo + s * u.width()).clamp(u.lo, u.hi);
        let y = (v.lo + t * v.width()).clamp(v.lo, v.hi);
        let cases: [(&str, Interval, f64); 20] = [
            ("+", u + v, x + y),
            ("-", u - v, x - y),
            ("*", u * v, x * y),
            ("/", u / v, x / y),
            ("neg", -u, -x),
            ("square", u.square(), x * x),
            ("powi 3", u.powi(3), Number::powi(x, 3)),
            ("powi 7", u.powi(7), Number::powi(x, 7)),
            ("powi 12", u.powi(12), Number::powi(x, 12)),
            ("powi -3", u.powi(-3), Number::powi(x, -3)),
            ("powf", u.powf(1.7), x.powf(1.7)),
            ("sqrt", u.sqrt(), x.sqrt()),
            ("exp", u.exp(), x.exp()),
            ("ln", u.ln(), x.ln()),
            ("sin", u.sin(), x.sin()),
            ("cos", u.cos(), x.cos()),
            ("tan", u.tan(), x.tan()),
            ("tanh", u.tanh(), x.tanh()),
            ("atan2", u.atan2(v), x.atan2(y)),
            ("abs", u.abs(), x.abs()),
        ];
        for (name, result, value) in cases {
            prop_assert!(
                result.contains(value) || value.is_nan(),
                "{name} of {x} in {u:?} and {y} in {v:?}: {value} is not in {result:?}"
            );
        }
    }
}
