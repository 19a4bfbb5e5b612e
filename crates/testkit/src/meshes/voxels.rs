//! Solids of unit cubes.

use std::collections::BTreeMap;

use basemesh::TriMesh;
use glam::DVec3;

/// Prisms over the unit squares of a plan, of height one, each square of the boundary cut in two.
///
/// # Panics
///
/// If the squares meet in corners only.
#[must_use]
pub fn voxels(plan: &[[i32; 2]]) -> TriMesh {
    let filled = |x: i32, y: i32| plan.contains(&[x, y]);
    let mut ids: BTreeMap<[i32; 3], usize> = BTreeMap::new();
    let mut faces = Vec::new();
    let mut quad = |corners: [[i32; 3]; 4]| {
        let [a, b, c, d] = corners.map(|p| {
            let next = ids.len();
            *ids.entry(p).or_insert(next)
        });
        faces.extend([[a, b, c], [a, c, d]]);
    };
    for &[x, y] in plan {
        quad([[x, y, 1], [x + 1, y, 1], [x + 1, y + 1, 1], [x, y + 1, 1]]);
        quad([[x, y, 0], [x, y + 1, 0], [x + 1, y + 1, 0], [x + 1, y, 0]]);
        let sides = [
            ([x, y - 1], [x, y], [x + 1, y]),
            ([x + 1, y], [x + 1, y], [x + 1, y + 1]),
            ([x, y + 1], [x + 1, y + 1], [x, y + 1]),
            ([x - 1, y], [x, y + 1], [x, y]),
        ];
        for (beyond, [ax, ay], [bx, by]) in sides {
            if !filled(beyond[0], beyond[1]) {
                quad([[ax, ay, 0], [bx, by, 0], [bx, by, 1], [ax, ay, 1]]);
            }
        }
    }
    let mut positions = vec![DVec3::ZERO; ids.len()];
    for (p, id) in ids {
        positions[id] = DVec3::from_array(p.map(f64::from));
    }
    TriMesh::new(positions, &faces).expect("a manifold")
}

/// A block with two holes: genus 2.
#[must_use]
pub fn double_torus() -> TriMesh {
    let holes = [[1, 1], [3, 1]];
    let plan: Vec<_> = (0..5)
        .flat_map(|x| (0..3).map(move |y| [x, y]))
        .filter(|cell| !holes.contains(cell))
        .collect();
    voxels(&plan)
}

/// Three cubes in the shape of an L.
#[must_use]
pub fn l_block() -> TriMesh {
    voxels(&[[0, 0], [1, 0], [0, 1]])
}
