//! Everything of the dimension of a length scales with powers of two bit for bit.
#![allow(clippy::float_cmp, reason = "scaling by a power of two keeps every bit")]

mod common;

use bezier_core::glam::DVec3;
use bezier_core::{Barycentric, LocalEdge, ParametricPatch, Seam, SepticTriangle};
use common::{parameters, triangle};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn powers_of_two(
        small in triangle::<36>(),
        neighbour in triangle::<36>(),
        at in parameters(),
        up in any::<bool>(),
    ) {
        let scale = if up { 4096.0 } else { 1.0 / 4096.0 };
        let large = |patch: &SepticTriangle| SepticTriangle::new(patch.net().map(|p| p * scale));
        prop_assert_eq!(large(&small).eval(at), small.eval(at) * scale);
        prop_assert_eq!(large(&small).eval_de_casteljau(at), small.eval_de_casteljau(at) * scale);
        prop_assert_eq!(large(&small.over([at, Barycentric::new(0.2, 0.3), Barycentric::CENTROID])),
            large(&small).over([at, Barycentric::new(0.2, 0.3), Barycentric::CENTROID]));
        let [s, l] = [small.jet(at), large(&small).jet(at)];
        prop_assert_eq!([l.point, l.du, l.dv, l.duu, l.duv, l.dvv],
            [s.point, s.du, s.dv, s.duu, s.duv, s.dvv].map(|v: DVec3| v * scale));
        let (s, l) = (s.surface_jet(), l.surface_jet());
        prop_assert_eq!(s.map(|j| j.normal), l.map(|j| j.normal));
        prop_assert_eq!(s.map(|j| j.second_fundamental_form),
            l.map(|j| j.second_fundamental_form * scale));
        let (scaled, scaled_neighbour) = (large(&small), large(&neighbour));
        let edge = LocalEdge::ALL[1];
        let seam = Seam { left: &small, left_edge: edge, right: &neighbour, right_edge: edge };
        let large = Seam { left: &scaled, left_edge: edge, right: &scaled_neighbour, right_edge: edge };
        prop_assert_eq!(large.position_gap::<8>(), seam.position_gap::<8>() * scale);
        prop_assert_eq!(large.normal_angle(0.3), seam.normal_angle(0.3));
        prop_assert_eq!(large.coplanarity_residual::<7>(), seam.coplanarity_residual::<7>());
    }
}
