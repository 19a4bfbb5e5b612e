//! Identities that hold for every net, at every parameter.

mod common;

use bezier_core::glam::DVec3;
use bezier_core::{
    Barycentric, BezierCurve, BezierTriangle, Coefficient, Corner, LocalEdge, MultiIndex,
    ParametricPatch, QuarticCurve, QuarticTriangle, QuinticTriangle, SepticCurve, SepticTriangle,
    bernstein, binomial,
};
use common::{ROUND_OFF, curve, parameters, triangle};
use proptest::prelude::*;

fn mix(corners: [Barycentric; 3], at: Barycentric) -> Barycentric {
    let sum = |f: fn(&Barycentric) -> f64| {
        f(&corners[0]) * at.u + f(&corners[1]) * at.v + f(&corners[2]) * at.w
    };
    Barycentric { u: sum(|c| c.u), v: sum(|c| c.v), w: sum(|c| c.w) }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_basis_is_a_partition_of_unity(at in parameters(), t in -0.3..1.3) {
        let sum: f64 = bernstein::<8>(t).iter().sum();
        prop_assert!((sum - 1.0).abs() <= ROUND_OFF);
        let ones = BezierTriangle::<f64, 36>::new([1.0; 36]);
        prop_assert!((ones.eval(at) - 1.0).abs() <= ROUND_OFF);
    }

    #[test]
    fn three_roads_to_a_point(patch in triangle::<36>(), at in parameters()) {
        let [a, b, c] = patch.last_triangle(at);
        let (point, area) = patch.point_and_area_normal(at);
        let jet = patch.jet(at);
        let expected = patch.eval(at);
        for other in [
            patch.eval_de_casteljau(at),
            a * at.u + b * at.v + c * at.w,
            point,
            jet.point,
            patch.point(at),
            patch.blossom([at; 7]),
        ] {
            prop_assert!(other.distance(expected) <= ROUND_OFF, "{other} for {expected}");
        }
        prop_assert!(area.distance(jet.area_normal()) <= 49.0 * 4.0 * ROUND_OFF);
    }

    #[test]
    fn ends_and_edges_are_interpolated(patch in triangle::<36>(), t in 0.0..1.0) {
        for corner in Corner::ALL {
            let mut exponents = [0; 3];
            exponents[corner.index()] = 7;
            let [i, j, k] = exponents;
            prop_assert_eq!(patch.eval(Barycentric::at(corner)), patch[MultiIndex::new(i, j, k)]);
        }
        for edge in LocalEdge::ALL {
            let boundary: SepticCurve = patch.boundary(edge);
            let on_patch = patch.eval(Barycentric::on_edge(edge, t));
            prop_assert!(boundary.eval(t).distance(on_patch) <= ROUND_OFF);
        }
    }

    /// The derivative across an edge is seven times the difference of first inner row and boundary.
    #[test]
    fn the_first_inner_row_is_the_cross_derivative(patch in triangle::<36>(), t in 0.0..1.0) {
        for edge in LocalEdge::ALL {
            let at = Barycentric::on_edge(edge, t);
            let last = patch.last_triangle(at);
            let row = BezierCurve::<DVec3, 7>::new(patch.first_inner_row(edge));
            let start: [DVec3; 7] =
                std::array::from_fn(|i| patch[MultiIndex::along(edge, 7 - i, i, 0)]);
            let apex = last[edge.apex().index()];
            prop_assert!(row.eval(t).distance(apex) <= ROUND_OFF);
            let from_start = BezierCurve::new(start).eval(t);
            prop_assert!(from_start.distance(last[edge.start().index()]) <= ROUND_OFF);
        }
    }

    #[test]
    fn rows_are_written_where_they_are_read(
        mut patch in triangle::<36>(), border in curve::<8>(), i in 0..7_usize,
    ) {
        for edge in LocalEdge::ALL {
            patch.set_boundary(edge, &border);
            prop_assert_eq!(patch.boundary::<8>(edge), border);
            patch.set_first_inner(edge, i, DVec3::ONE);
            prop_assert_eq!(patch.first_inner_row::<7>(edge)[i], DVec3::ONE);
        }
    }

    #[test]
    fn elevation_keeps_the_patch(patch in triangle::<15>(), at in parameters()) {
        let quintic: QuinticTriangle = patch.elevate_to();
        let septic: SepticTriangle = patch.elevate_to();
        let in_steps: SepticTriangle = quintic.elevate_to();
        prop_assert!(septic.eval(at).distance(patch.eval(at)) <= ROUND_OFF);
        for (a, b) in septic.net().iter().zip(in_steps.net()) {
            prop_assert!(a.distance(*b) <= 64.0 * f64::EPSILON);
        }
        for edge in LocalEdge::ALL {
            let boundary = patch.boundary::<5>(edge).elevate_to::<8>();
            let elevated = septic.boundary::<8>(edge);
            for (a, b) in boundary.points.iter().zip(elevated.points) {
                prop_assert!(a.distance(b) <= 64.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn sub_triangles_are_the_patch_itself(
        patch in triangle::<36>(),
        inner in (0.05..0.45, 0.05..0.45),
        at in (0.0..0.5, 0.0..0.5),
    ) {
        let inner = Barycentric::new(inner.0, inner.1);
        let at = Barycentric::new(at.0, at.1);
        for (part, replaced) in patch.subdivide_at(inner).into_iter().zip(Corner::ALL) {
            let mut corners = Corner::ALL.map(Barycentric::at);
            corners[replaced.index()] = inner;
            let expected = patch.eval(mix(corners, at));
            prop_assert!(part.eval(at).distance(expected) <= ROUND_OFF);
        }
        let whole = patch.over(Corner::ALL.map(Barycentric::at));
        for (a, b) in whole.net().iter().zip(patch.net()) {
            prop_assert!(a.distance(*b) <= ROUND_OFF);
        }
    }

    #[test]
    fn halves_are_the_patches_over_them(patch in triangle::<36>()) {
        let [first, second, third] = Corner::ALL.map(Barycentric::at);
        let middle = Barycentric::new(0.0, 0.5);
        for (half, corners) in
            patch.halves().iter().zip([[middle, first, second], [middle, third, first]])
        {
            for (a, b) in half.net().iter().zip(patch.over(corners).net()) {
                prop_assert!(a.distance(*b) <= ROUND_OFF);
            }
        }
    }

    /// Symmetric, affine in each argument, and equal to the control points at the corners.
    #[test]
    fn blossom(
        patch in triangle::<15>(),
        [a, b, c, d, e] in prop::array::uniform5(parameters()),
        s in -1.0..2.0,
    ) {
        let value = patch.blossom([a, b, c, d]);
        for order in [[b, a, c, d], [d, c, b, a], [c, d, a, b]] {
            prop_assert!(patch.blossom(order).distance(value) <= 8.0 * ROUND_OFF);
        }
        let between = Barycentric {
            u: a.u * (1.0 - s) + e.u * s,
            v: a.v * (1.0 - s) + e.v * s,
            w: a.w * (1.0 - s) + e.w * s,
        };
        let expected = DVec3::between(value, patch.blossom([e, b, c, d]), s);
        prop_assert!(patch.blossom([between, b, c, d]).distance(expected) <= 32.0 * ROUND_OFF);
        for (m, point) in patch.iter() {
            let corner = |corner: Corner, times| std::iter::repeat_n(Barycentric::at(corner), times);
            let arguments = corner(Corner::First, m.i)
                .chain(corner(Corner::Second, m.j))
                .chain(corner(Corner::Third, m.k));
            prop_assert_eq!(patch.blossom(arguments), point);
        }
    }

    #[test]
    fn linear_precision(corners in triangle::<3>(), at in parameters()) {
        let patch: SepticTriangle = corners.elevate_to();
        let [a, b, c] = *corners.net();
        let expected = a * at.u + b * at.v + c * at.w;
        prop_assert!(patch.eval(at).distance(expected) <= ROUND_OFF);
        let jet = patch.jet(at);
        prop_assert!(jet.du.distance(a - c) <= 16.0 * ROUND_OFF);
        prop_assert!(jet.duu.length().max(jet.duv.length()) <= 256.0 * ROUND_OFF);
    }

    #[test]
    fn curves(curve in curve::<5>(), t in -0.3..1.3, split in 0.05..0.95) {
        let expected = curve.eval(t);
        let elevated: SepticCurve = curve.elevate_to();
        let [before, after] = curve.split(split);
        for (what, other) in [
            ("sum", curve.eval_sum(t)),
            ("jet", curve.jet(t).value),
            ("elevated", elevated.eval(t)),
            ("reversed", curve.reversed().eval(1.0 - t)),
            ("before", before.eval(t / split)),
            ("after", after.eval((t - split) / (1.0 - split))),
        ] {
            // a part is continued up to twenty times its length
            let allowed = if what == "before" || what == "after" { 1e6 } else { 1.0 } * ROUND_OFF;
            prop_assert!(other.distance(expected) <= allowed, "{what}: {other} for {expected}");
        }
        prop_assert_eq!(before.points[4], after.points[0]);
        prop_assert_eq!(curve.reversed().reversed(), curve);
        let degree_raised: QuarticCurve = curve.elevate_to();
        prop_assert_eq!(degree_raised, curve);
    }
}

/// Control points of a monomial: `C(i, p) C(j, q) C(k, r) / multinomial(p, q, r)` for `u^p v^q w^r`
/// elevated; checked at a few parameters.
#[test]
fn monomials_are_reproduced() {
    for (p, q, r) in [(2, 1, 1), (4, 0, 0), (0, 2, 2), (1, 3, 0)] {
        let multinomial = binomial(4, p) * binomial(4 - p, q);
        let quartic = QuarticTriangle::<f64>::from_fn(|m| {
            if (m.i, m.j, m.k) == (p, q, r) { 1.0 / multinomial } else { 0.0 }
        });
        let septic: SepticTriangle<f64> = quartic.elevate_to();
        for at in Barycentric::lattice(6) {
            let power = |x: f64, n: usize| (0..n).fold(1.0, |product, _| product * x);
            let expected = power(at.u, p) * power(at.v, q) * power(at.w, r);
            for value in [quartic.eval(at), septic.eval(at), septic.eval_de_casteljau(at)] {
                assert!((value - expected).abs() <= 16.0 * f64::EPSILON, "{value} for {expected}");
            }
        }
    }
}
