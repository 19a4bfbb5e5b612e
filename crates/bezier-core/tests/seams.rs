//! The mismatch of two patches: zero for the two halves of one patch, proportional to a known
//! disturbance otherwise.

mod common;

use bezier_core::glam::DVec3;
use bezier_core::{Barycentric, Corner, LocalEdge, MultiIndex, Seam, SepticTriangle};
use common::points;
use proptest::prelude::*;

fn nearly_flat(offsets: &[DVec3; 36]) -> SepticTriangle {
    let corners = [DVec3::X, DVec3::new(-0.5, 0.8, 0.0), DVec3::new(-0.5, -0.8, 0.0)];
    SepticTriangle::from_fn(|m| {
        let flat =
            (corners[0] * m.i as f64 + corners[1] * m.j as f64 + corners[2] * m.k as f64) / 7.0;
        flat + offsets[m.rank()] * 0.02
    })
}

/// A patch with its corners numbered from another one on.
fn turned(patch: &SepticTriangle, first: Corner) -> SepticTriangle {
    SepticTriangle::from_fn(|m| {
        let mut exponents = [m.i, m.j, m.k];
        exponents.rotate_right(first.index());
        let [i, j, k] = exponents;
        patch[MultiIndex::new(i, j, k)]
    })
}

/// The two parts of a patch on both sides of the line from the first corner to the middle of the
/// opposite edge; their common edge is the third of the left part and the first of the right part.
fn halves(patch: &SepticTriangle) -> [SepticTriangle; 2] {
    let [a, b, c] = Corner::ALL.map(Barycentric::at);
    let middle = Barycentric { u: 0.0, v: 0.5, w: 0.5 };
    [patch.over([a, b, middle]), patch.over([a, middle, c])]
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 60,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn halves_of_one_patch(offsets in points::<36>(), first in 0..3_usize, second in 0..3_usize) {
        let [left, right] = halves(&nearly_flat(&offsets));
        let (first, second) = (Corner::ALL[first], Corner::ALL[second]);
        // the edges in the turned numbering: corner k of a turned patch is corner k + first
        let local = |corner: usize, first: Corner| {
            LocalEdge::starting_at(Corner::ALL[(corner + 3 - first.index()) % 3])
        };
        let (left_turned, right_turned) = (turned(&left, first), turned(&right, second));
        let seam = Seam {
            left: &left_turned,
            left_edge: local(2, first),
            right: &right_turned,
            right_edge: local(0, second),
        };
        prop_assert!(seam.position_gap::<8>() <= 32.0 * f64::EPSILON);
        let angle = seam.max_normal_angle(22).expect("nearly flat");
        prop_assert!(angle <= 1e-13, "{angle:e}");
        let residual = seam.coplanarity_residual::<7>();
        prop_assert!(residual <= 1e-12, "{residual:e}");
    }

    /// A point of the row moved by `step` across the surface turns the normal by as much as the
    /// derivative across the edge is long.
    #[test]
    fn a_moved_row_is_seen(offsets in points::<36>(), i in 1..6_usize, exponent in 2..8_i32) {
        let step = 10.0_f64.powi(-exponent);
        let [mut left, right] = halves(&nearly_flat(&offsets));
        let edge = LocalEdge::starting_at(Corner::Third);
        let moved = left.first_inner_row::<7>(edge)[i] + DVec3::Z * step;
        left.set_first_inner(edge, i, moved);
        let seam = Seam {
            left: &left,
            left_edge: edge,
            right: &right,
            right_edge: LocalEdge::starting_at(Corner::First),
        };
        let angle = seam.max_normal_angle(22).unwrap();
        prop_assert!((0.1..=5.0).contains(&(angle / step)), "{angle:e} for a step of {step:e}");
        let residual = seam.coplanarity_residual::<7>();
        prop_assert!(residual >= 0.01 * step, "{residual:e} for a step of {step:e}");
        prop_assert!(seam.position_gap::<8>() <= 32.0 * f64::EPSILON);
    }

    #[test]
    fn a_gap_is_a_distance(offsets in points::<36>(), i in 0..8_usize, gap in 1e-6..1.0_f64) {
        let [left, mut right] = halves(&nearly_flat(&offsets));
        let edge = LocalEdge::starting_at(Corner::First);
        let mut border = right.boundary::<8>(edge);
        border.points[i] += DVec3::Y * gap;
        right.set_boundary(edge, &border);
        let seam = Seam { left: &left, left_edge: LocalEdge::starting_at(Corner::Third), right: &right, right_edge: edge };
        prop_assert!((seam.position_gap::<8>() - gap).abs() <= 32.0 * f64::EPSILON);
    }
}
