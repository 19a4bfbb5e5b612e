//! The smoothness condition holds for curves and data that belong to no surface; and the check of
//! it can fail.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::{Twisted, twisted};
use g1_triangular::basemesh::HalfedgeId;
use g1_triangular::bezier_core::glam::DVec3;
use g1_triangular::bezier_core::{Corner, LocalEdge, Seam};
use g1_triangular::{Settings, SmoothPatches, g1_residual};

const METHODS: [(&str, Settings); 2] =
    [("published", Settings::PUBLISHED), ("refined", Settings::REFINED)];

fn local(h: HalfedgeId) -> LocalEdge {
    LocalEdge::starting_at(Corner::ALL[h.corner()])
}

fn largest_residual(it: &Twisted, patches: &SmoothPatches) -> f64 {
    let edges = it.mesh.topology().edges();
    edges.map(|e| patches.edge_residual(&it.mesh, &it.network, e).unwrap()).fold(0.0, f64::max)
}

/// Rows of both patches along the canonical direction of each edge.
fn rows(it: &Twisted, patches: &SmoothPatches, h: HalfedgeId) -> [[DVec3; 7]; 2] {
    let w = it.mesh.topology().twin(h).unwrap();
    let mut right = patches.nets[w.face()].first_inner_row::<7>(local(w));
    right.reverse();
    [patches.nets[h.face()].first_inner_row::<7>(local(h)), right]
}

#[test]
fn a_network_of_no_surface_is_joined_exactly() {
    for turn in [0.0, 0.1, 0.3] {
        let it = twisted(turn);
        for (name, settings) in METHODS {
            let patches = it.construct(&it.plan(settings));
            let residual = largest_residual(&it, &patches);
            assert!(residual <= 2e-14, "{name}, turned by {turn}: {residual:e}");
            // the same without weight functions, from the patches alone
            for edge in it.mesh.topology().edges() {
                let h = it.mesh.topology().canonical(edge);
                let w = it.mesh.topology().twin(h).unwrap();
                let seam = Seam {
                    left: &patches.nets[h.face()],
                    left_edge: local(h),
                    right: &patches.nets[w.face()],
                    right_edge: local(w),
                };
                assert!(seam.position_gap::<8>() <= 0.0, "{name}: {edge} has a gap");
                let residual = seam.coplanarity_residual::<7>();
                // a product of three derivatives, each seven times a difference of points
                assert!(residual <= 2e-14 * 343.0, "{name}, {edge}: coplanar up to {residual:e}");
            }
        }
    }
}

#[test]
fn one_moved_control_point_is_seen() {
    let it = twisted(0.2);
    let patches = it.construct(&it.plan(Settings::REFINED));
    for edge in it.mesh.topology().edges().step_by(7) {
        let weights = patches.weights[edge];
        let rows = rows(&it, &patches, it.mesh.topology().canonical(edge));
        let curve = it.network.curves()[edge];
        let chord = curve.points[0].distance(curve.points[4]);
        let size = |[left, right]: [[DVec3; 7]; 2], weights| {
            let rows = g1_residual(&curve, &left, &right, &weights);
            rows.iter().map(|row| row.length()).fold(0.0, f64::max)
        };
        assert!(size(rows, weights) <= 2e-14, "{edge}");
        let step = 1e-8;
        for side in 0..2 {
            for i in 0..7 {
                let mut moved = rows;
                moved[side][i] += DVec3::new(0.6, 0.0, -0.8) * (step * chord);
                // the weights of a row lie between 1/7 and 1, times λ or 1 - λ
                let seen = size(moved, weights) / step;
                assert!((0.02..=1.5).contains(&seen), "{edge}, side {side}, point {i}: {seen}");
            }
        }
        for i in 0..7 {
            let mut other = weights;
            match i {
                0 | 1 => other.lambda[i] += step,
                _ => other.mu[i - 2] += step,
            }
            assert!(size(rows, other) >= 1e-3 * step, "{edge}: weight {i} is not seen");
        }
    }
}

/// Around a vertex the product of `(1 - λ0) / λ0` is one: App. B of the paper.
#[test]
fn weights_close_around_every_vertex() {
    let it = twisted(0.2);
    let topology = it.mesh.topology();
    for (name, settings) in METHODS {
        let patches = it.construct(&it.plan(settings));
        let lambda0 = |h: HalfedgeId| {
            let edge = topology.edge(h);
            let lambda = patches.weights[edge].lambda;
            if topology.canonical(edge) == h { lambda[0] } else { 1.0 - lambda[1] }
        };
        for vertex in topology.vertices() {
            let product: f64 =
                topology.fan(vertex).map(|h| (1.0 - lambda0(h)) / lambda0(h)).product();
            assert!((product - 1.0).abs() <= 1e-13, "{name}, {vertex}: {product}");
            assert!(topology.fan(vertex).all(|h| (0.0..1.0).contains(&lambda0(h))), "{vertex}");
        }
    }
}

/// The alternating sum of all rows: `(λ1 - λ0) D6(r - p) = D4(μ) D4(q)`.
#[test]
fn the_identity_behind_the_edge_system() {
    let it = twisted(0.2);
    let difference = |values: &[DVec3]| {
        let mut level = values.to_vec();
        while level.len() > 1 {
            level = level.windows(2).map(|pair| pair[1] - pair[0]).collect();
        }
        level[0]
    };
    for (name, settings) in METHODS {
        let patches = it.construct(&it.plan(settings));
        for edge in it.mesh.topology().edges() {
            let [left, right] = rows(&it, &patches, it.mesh.topology().canonical(edge));
            let across: Vec<DVec3> = right.iter().zip(left).map(|(r, p)| *r - p).collect();
            let weights = patches.weights[edge];
            let [m0, m1, m2, m3, m4] = weights.mu;
            let d4_mu = m0 - 4.0 * m1 + 6.0 * m2 - 4.0 * m3 + m4;
            let slope = weights.lambda[1] - weights.lambda[0];
            let sides =
                [difference(&across) * slope, it.network.curves()[edge].top_difference() * d4_mu];
            let scale = it.mesh.edge_length(edge) * 64.0;
            assert!(sides[0].distance(sides[1]) <= 1e-13 * scale, "{name}, {edge}: {sides:?}");
        }
    }
}

/// Data at the corners are met: normal and second form come from the twists.
#[test]
fn corners_have_the_given_second_form() {
    use g1_triangular::bezier_core::{Barycentric, ParametricPatch};
    let it = twisted(0.2);
    for (name, settings) in METHODS {
        let patches = it.construct(&it.plan(settings));
        for (face, net) in patches.nets.iter() {
            for (corner, vertex) in Corner::ALL.into_iter().zip(it.mesh.topology().corners(face)) {
                let found = net.jet(Barycentric::at(corner)).surface_jet().unwrap();
                let given = it.jets[vertex];
                assert!(found.normal.distance(given.normal) <= 1e-13, "{name}, {face}");
                let difference = found.second_fundamental_form - given.second_fundamental_form;
                let largest =
                    difference.to_cols_array().map(f64::abs).into_iter().fold(0.0, f64::max);
                assert!(largest <= 1e-11, "{name}, {face}, {corner:?}: {largest:e}");
            }
        }
    }
}
