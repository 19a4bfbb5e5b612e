//! What does not change when the input is moved, renumbered, turned inside out or scaled.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::GridMesh as _;

use std::f64::consts::TAU;

use common::{Random, build, residual, samples};
use nagata::bezier_core::Barycentric;
use nagata::glam::{DQuat, DVec3};
use nagata::{CornerNormals, NagataSurface, Patch, PolygonMesh, Settings};
use proptest::prelude::*;

/// A smooth surface over an irregular mesh, one normal for each vertex.
struct Case {
    grid: common::Grid,
    normals: Vec<DVec3>,
}

/// The graph of a random cubic polynomial.
fn case(seed: u64) -> Case {
    let mut random = Random(seed | 1);
    let c: [f64; 7] = std::array::from_fn(|_| random.next(-0.3, 0.3));
    let height = move |x: f64, y: f64| {
        c[0] * x * x
            + c[1] * x * y
            + c[2] * y * y
            + (c[3] * x * x * x + c[4] * x * x * y + c[5] * x * y * y + c[6] * y * y * y) * 0.5
    };
    let slope = move |p: &DVec3| {
        let (x, y) = (p.x, p.y);
        let dx = 2.0 * c[0] * x
            + c[1] * y
            + (3.0 * c[3] * x * x + 2.0 * c[4] * x * y + c[5] * y * y) * 0.5;
        let dy = c[1] * x
            + 2.0 * c[2] * y
            + (c[4] * x * x + 2.0 * c[5] * x * y + 3.0 * c[6] * y * y) * 0.5;
        DVec3::new(-dx, -dy, 1.0).normalize()
    };
    let grid = common::graph(5, height, seed | 1);
    let normals = grid.positions.iter().map(slope).collect();
    Case { grid, normals }
}

impl Case {
    fn surface(&self, settings: Settings) -> NagataSurface {
        let mesh = PolygonMesh::new(self.grid.positions.clone(), &self.grid.faces).unwrap();
        let normals = CornerNormals::per_vertex(&mesh, &self.normals).unwrap();
        build(&mesh, &normals, settings)
    }
}

fn points(surface: &NagataSurface) -> Vec<(DVec3, Option<DVec3>)> {
    surface.mesh().faces().flat_map(|face| samples(&surface.patch(face), 4)).collect()
}

fn all_settings() -> [Settings; 3] {
    [Settings::position(), Settings::published(), Settings::tangent_plane()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn rigid_motions_move_the_surface(seed in any::<u64>(), angle in 0.0..TAU, shift in -5.0..5.0) {
        let case = case(seed);
        let mut random = Random(seed | 1);
        let turn = DQuat::from_axis_angle(random.unit(), angle);
        let shift = random.unit() * shift;
        let moved = Case {
            grid: common::Grid {
                positions: case.grid.positions.iter().map(|p| turn * *p + shift).collect(),
                faces: case.grid.faces.clone(),
            },
            normals: case.normals.iter().map(|n| turn * *n).collect(),
        };
        for settings in [Settings::position(), Settings::tangent_plane()] {
            let (before, after) = (points(&case.surface(settings)), points(&moved.surface(settings)));
            for ((p, n), (q, m)) in before.into_iter().zip(after) {
                let (point, normal): (DVec3, DVec3) = (turn * p + shift, turn * n.unwrap());
                prop_assert!(point.distance(q) <= 1e-12, "{point} {q}");
                prop_assert!(normal.distance(m.unwrap()) <= 1e-11, "{normal} {m:?}");
            }
        }
    }

    #[test]
    fn vertex_numbers_do_not_matter(seed in any::<u64>()) {
        let case = case(seed);
        // a random order of the vertices
        let mut random = Random(seed | 1);
        let mut order: Vec<(u64, usize)> = (0..case.grid.positions.len())
            .map(|v| (random.next(0.0, 1.0).to_bits(), v))
            .collect();
        order.sort_unstable();
        let mut new_id = vec![0; order.len()];
        order.iter().enumerate().for_each(|(new, (_, old))| new_id[*old] = new);
        let renumbered = Case {
            grid: common::Grid {
                positions: order.iter().map(|(_, old)| case.grid.positions[*old]).collect(),
                faces: case.grid.faces.iter()
                    .map(|face| face.iter().map(|v| new_id[*v]).collect())
                    .collect(),
            },
            normals: order.iter().map(|(_, old)| case.normals[*old]).collect(),
        };
        for settings in all_settings() {
            // the same bits: faces and their corners are in the same order
            prop_assert_eq!(points(&case.surface(settings)), points(&renumbered.surface(settings)));
        }
    }

    #[test]
    fn the_side_of_the_normals_does_not_matter(seed in any::<u64>()) {
        let case = case(seed);
        let flipped = Case {
            grid: common::Grid {
                positions: case.grid.positions.clone(),
                faces: case.grid.faces.clone(),
            },
            normals: case.normals.iter().map(|n| -*n).collect(),
        };
        for settings in all_settings() {
            let (a, b) = (case.surface(settings), flipped.surface(settings));
            prop_assert_eq!(points(&a), points(&b));
            prop_assert_eq!(a.report(), b.report());
        }
    }

    #[test]
    fn powers_of_two_scale_exactly(seed in any::<u64>()) {
        let case = case(seed);
        let factor = 4096.0;
        let scaled = Case {
            grid: common::Grid {
                positions: case.grid.positions.iter().map(|p| *p * factor).collect(),
                faces: case.grid.faces.clone(),
            },
            normals: case.normals.clone(),
        };
        for settings in all_settings() {
            let (small, large) = (case.surface(settings), scaled.surface(settings));
            for ((p, n), (q, m)) in points(&small).into_iter().zip(points(&large)) {
                prop_assert_eq!(p * factor, q);
                prop_assert_eq!(n, m);
            }
            let area = [small.area(1e-6), large.area(1e-6)];
            prop_assert_eq!(area[0].value * factor * factor, area[1].value);
        }
    }

    #[test]
    fn random_smooth_meshes_have_no_kinks(seed in any::<u64>()) {
        let surface = case(seed).surface(Settings::tangent_plane());
        let report = surface.report();
        prop_assert_eq!(report.tangent_plane + report.boundary, report.edges, "{:?}", report);
        let (worst, _) = residual(&surface, 8);
        prop_assert!(worst <= 1e-11, "{worst:e}");
        let sound = surface.mesh().faces().all(|f| !surface.patch_report(f).folded);
        prop_assert!(sound, "{:?}", report);
    }

    #[test]
    fn edges_meet_their_normals_or_say_not(seed in any::<u64>()) {
        let mut random = Random(seed | 1);
        let mesh = common::sphere(1).mesh();
        let normals: Vec<DVec3> = mesh.vertices().map(|_| random.unit()).collect();
        let normals = CornerNormals::per_vertex(&mesh, &normals).unwrap();
        for settings in all_settings() {
            let surface = build(&mesh, &normals, settings);
            for edge in mesh.edges() {
                let status = surface.edge_status(edge);
                let met = surface.edge_misfit(edge) <= 1e-11;
                prop_assert!(met || status.lowered.is_some() && !status.cubic, "{status:?}");
            }
            for face in mesh.faces() {
                if let Patch::TangentPlane(patch) = surface.patch(face) {
                    let at = Barycentric::new(0.3, 0.4);
                    prop_assert!(patch.point(at).is_finite(), "{patch:?}");
                }
            }
        }
    }
}
