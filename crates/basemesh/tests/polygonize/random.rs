//! Whatever the signs are, the mesh is a closed oriented manifold.

use proptest::prelude::*;

use crate::fields::{mesh_of, mixed, noise, sign_grid, sign_grid_region, unbounded};
use implicit::{Aabb, glam};

/// Building the mesh proves that it is manifold and oriented; what remains is that it is closed.
fn check_signs(size: u32, seed: u64, inside: impl Fn([u32; 3]) -> bool + Sync) {
    let field = sign_grid(size, seed, inside);
    let mesh = mesh_of(&field, &sign_grid_region(size), size as usize)
        .unwrap_or_else(|error| panic!("size {size}, seed {seed}: {error}"));
    let topology = mesh.topology();
    assert!(topology.is_closed(), "size {size}, seed {seed}: an edge has one triangle");
    assert_eq!(topology.euler_characteristic() % 2, 0, "closed surfaces have an even number");
}

#[test]
fn all_configurations_with_random_neighbours() {
    for configuration in 0..256_u64 {
        for repetition in 0..6 {
            let seed = configuration | repetition << 8;
            // the cell starts at different nodes of its block, also the last one
            let size = 4 + u32::try_from(repetition).unwrap();
            let first = size / 2 - 1;
            check_signs(size, seed, |index| {
                let corner = index.map(|i| i.wrapping_sub(first));
                if corner.iter().all(|&c| c < 2) {
                    configuration >> (corner[0] + 2 * corner[1] + 4 * corner[2]) & 1 == 1
                } else {
                    mixed(seed ^ u64::from(index[0] + 64 * (index[1] + 64 * index[2])) << 20) & 1
                        == 1
                }
            });
        }
    }
}

#[test]
fn chessboard() {
    for size in [2, 5, 9] {
        check_signs(size, 7, |[x, y, z]| (x + y + z) % 2 == 0);
    }
}

#[test]
fn zeros_at_nodes_count_as_outside() {
    // a sphere with the value exactly zero in a thick layer around it
    let field = unbounded(|p| (p.length() - 0.7).signum().min(0.0));
    let mesh = mesh_of(&field, &Aabb::from_half_size(1.0), 24).unwrap();
    assert!(mesh.topology().is_closed());
    assert_eq!(mesh.topology().euler_characteristic(), 2);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn noise_of_any_density(size in 3_u32..22, seed: u64, density in 0.02..0.98) {
        let at = |index: [u32; 3]| glam::DVec3::from_array(index.map(f64::from));
        // one inside node at least
        check_signs(size, seed, |index| index == [1; 3] || noise(seed, at(index)) < density);
    }
}
