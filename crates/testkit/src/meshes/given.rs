//! Meshes for schemes over given meshes: rough ones, open ones, ones with normals.

use basemesh::{TriMesh, VertexMap};
use glam::DVec3;

use super::icosphere;
use crate::Numbers;

/// The same mesh with moved vertices.
///
/// # Panics
///
/// If a position is not finite.
#[must_use]
pub fn mapped(mesh: &TriMesh, f: impl Fn(DVec3) -> DVec3) -> TriMesh {
    let positions = mesh.positions().as_slice().iter().map(|&p| f(p)).collect();
    mesh.clone().with_positions(VertexMap::from_vec(positions)).expect("finite positions")
}

/// A sphere of 320 faces whose vertices moved in each coordinate, with the standard deviation of
/// `amount` mean edges.
///
/// # Panics
///
/// Never with a finite amount.
#[must_use]
pub fn noisy_sphere(amount: f64, seed: u64) -> TriMesh {
    let mesh = icosphere(2);
    let edges = mesh.topology().edges();
    let mean =
        edges.map(|e| mesh.edge_length(e)).sum::<f64>() / mesh.topology().edge_count() as f64;
    let mut numbers = Numbers::new(seed);
    let positions: Vec<_> = mesh
        .positions()
        .as_slice()
        .iter()
        .map(|&p| {
            // the sum of three uniform numbers has variance 1 and looks normal
            let mut normal = || numbers.signed() + numbers.signed() + numbers.signed();
            let noise = DVec3::new(normal(), normal(), normal());
            p + noise * (amount * mean)
        })
        .collect();
    mesh.with_positions(VertexMap::from_vec(positions)).expect("finite positions")
}

/// A one-sheeted hyperboloid `x² + y² - z²/2 = 1` between two planes, open.
///
/// # Panics
///
/// If there are fewer than three faces around, or none up.
#[must_use]
pub fn hyperboloid(around: usize, up: usize) -> TriMesh {
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    for j in 0..=up {
        for i in 0..around {
            let z = 2.0 * j as f64 / up as f64 - 1.0;
            let r = (1.0 + 0.5 * z * z).sqrt();
            let angle = std::f64::consts::TAU * (i as f64 + 0.5 * j as f64) / around as f64;
            positions.push(DVec3::new(r * angle.cos(), r * angle.sin(), z));
            let at = |i: usize, j: usize| (i % around) + j * around;
            if j < up {
                faces.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                faces.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
    TriMesh::new(positions, &faces).expect("a manifold")
}

/// Two triangles with normals: the configurations of \[XHB01, Figures 6, 7, 9, 10\].
///
/// # Panics
///
/// Never.
#[must_use]
pub fn two_triangles() -> Vec<(&'static str, TriMesh, VertexMap<DVec3>)> {
    let v = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let [n1, n2] = [v(-1.0, 0.0, 1.0), v(1.0, 0.0, 1.0)];
    let up = v(0.0, 0.0, 1.0);
    let cases = [
        ("fig 6", -1.0, [n1, n2, v(0.0, 1.0, 1.0), v(0.0, -1.0, 1.0)]),
        ("fig 7", -1.0, [n1, n2, v(0.0, 1.0, 1.5), v(0.0, 1.0, 1.5)]),
        ("fig 9", -1.0, [n2, n2, v(0.0, -1.0, 1.5), v(0.0, 1.0, 1.5)]),
        ("fig 10", 0.0, [up, up, v(0.0, -1.0, 1.5), up]),
    ];
    cases
        .into_iter()
        .map(|(name, z, normals)| {
            let points =
                vec![v(-2.0, 0.0, 0.0), v(2.0, 0.0, 0.0), v(0.0, 4.0, -1.0), v(0.0, -4.0, z)];
            let mesh = TriMesh::new(points, &[[0, 1, 2], [1, 0, 3]]).expect("two triangles");
            (name, mesh, VertexMap::from_vec(normals.to_vec()))
        })
        .collect()
}

/// A cushion with a flat square on either side, and its normals: the belt leans out on both sides.
///
/// # Panics
///
/// Never.
#[must_use]
pub fn cushion() -> (TriMesh, VertexMap<DVec3>) {
    // the rings of the flat sides, then the belt, counter-clockwise from above; the middles last
    const RING: [[f64; 2]; 8] =
        [[1., 0.], [1., 1.], [0., 1.], [-1., 1.], [-1., 0.], [-1., -1.], [0., -1.], [1., -1.]];
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for [x, y] in RING {
        let belt = DVec3::new(1.5 * x, 1.5 * y, 0.0);
        positions.extend([DVec3::new(x, y, 0.5), belt, DVec3::new(x, y, -0.5)]);
        normals.extend([DVec3::Z, belt.normalize(), DVec3::NEG_Z]);
    }
    positions.extend([DVec3::new(0.0, 0.0, 0.5), DVec3::new(0.0, 0.0, -0.5)]);
    normals.extend([DVec3::Z, DVec3::NEG_Z]);
    let mut faces = Vec::new();
    for i in 0..8 {
        let [a, b] = [3 * i, 3 * ((i + 1) % 8)];
        faces.extend([[24, a, b], [25, b + 2, a + 2]]);
        for (upper, lower) in [(0, 1), (1, 2)] {
            faces.push([a + upper, a + lower, b + upper]);
            faces.push([b + upper, a + lower, b + lower]);
        }
    }
    let mesh = TriMesh::new(positions, &faces).expect("a closed surface");
    (mesh, VertexMap::from_vec(normals))
}
