//! Meshes and measures that several suites share.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]
#![allow(dead_code, unreachable_pub, reason = "each suite uses its part")]

use std::collections::BTreeMap;

use apatch::basemesh::{TriMesh, VertexMap};
use apatch::glam::DVec3;
use apatch::rational::{Normals, RationalSurface, Settings};

/// A generator of numbers that is the same everywhere.
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// From 0 to 1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// From -1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// Positive weights that add up to one.
    pub fn weights<const N: usize>(&mut self) -> [f64; N] {
        let raw: [f64; N] = std::array::from_fn(|_| 1e-3 - self.unit().max(1e-12).ln());
        let sum: f64 = raw.iter().sum();
        raw.map(|w| w / sum)
    }
}

pub fn given(mesh: &TriMesh, normal: impl Fn(DVec3) -> DVec3) -> Normals {
    let normals = mesh.positions().as_slice().iter().map(|&p| normal(p)).collect();
    Normals::Given(VertexMap::from_vec(normals))
}

pub fn surface(mesh: &TriMesh, normals: Normals) -> RationalSurface {
    RationalSurface::new(mesh.clone(), normals, &Settings::default()).unwrap()
}

/// The same mesh with moved vertices.
pub fn mapped(mesh: &TriMesh, f: impl Fn(DVec3) -> DVec3) -> TriMesh {
    let positions = mesh.positions().as_slice().iter().map(|&p| f(p)).collect();
    mesh.clone().with_positions(VertexMap::from_vec(positions)).unwrap()
}

/// Prisms over the unit squares of a plan, of height one, each square of the boundary cut in two.
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
    TriMesh::new(positions, &faces).unwrap()
}

/// A block with two holes: genus 2.
pub fn double_torus() -> TriMesh {
    let holes = [[1, 1], [3, 1]];
    let plan: Vec<_> = (0..5)
        .flat_map(|x| (0..3).map(move |y| [x, y]))
        .filter(|cell| !holes.contains(cell))
        .collect();
    voxels(&plan)
}

pub fn l_block() -> TriMesh {
    voxels(&[[0, 0], [1, 0], [0, 1]])
}

/// A sphere of 320 faces whose vertices moved in each coordinate, with the standard deviation of
/// `amount` mean edges.
pub fn noisy_sphere(amount: f64, seed: u64) -> TriMesh {
    let mesh = testkit::meshes::icosphere(2);
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
    mesh.with_positions(VertexMap::from_vec(positions)).unwrap()
}

/// A one-sheeted hyperboloid `x² + y² - z²/2 = 1` between two planes, open.
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
    TriMesh::new(positions, &faces).unwrap()
}

/// The configurations of \[XHB01, Figures 6, 7, 9, 10\].
pub fn figures() -> Vec<(&'static str, TriMesh, Normals)> {
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
            let mesh = TriMesh::new(points, &[[0, 1, 2], [1, 0, 3]]).unwrap();
            (name, mesh, Normals::Given(VertexMap::from_vec(normals.to_vec())))
        })
        .collect()
}

/// All sorts of surfaces, with their names.
pub fn zoo() -> Vec<(String, RationalSurface)> {
    let mut zoo: Vec<(String, RationalSurface)> = figures()
        .into_iter()
        .map(|(name, mesh, normals)| (name.to_owned(), surface(&mesh, normals)))
        .collect();
    let mut add = |name: &str, mesh: TriMesh, normals: Normals| {
        zoo.push((name.to_owned(), surface(&mesh, normals)));
    };
    let sphere = testkit::meshes::icosphere(0);
    add("icosahedron", sphere.clone(), given(&sphere, |p| 2.0 * p));
    let hyper = hyperboloid(10, 4);
    add("hyperboloid", hyper.clone(), given(&hyper, v2));
    let torus = testkit::meshes::torus_grid([2.0, 0.8], 16, 12);
    add("torus", torus.clone(), given(&torus, torus_normal));
    add("double torus", double_torus(), Normals::Estimated);
    add("L block", l_block(), Normals::Estimated);
    add("noisy sphere", noisy_sphere(0.2, 1), Normals::Estimated);
    zoo
}

/// Gradient of `x² + y² - z²/2 - 1`.
pub fn v2(p: DVec3) -> DVec3 {
    DVec3::new(2.0 * p.x, 2.0 * p.y, -p.z)
}

/// Unit normal of the torus with radii 2 and 0.8.
pub fn torus_normal(p: DVec3) -> DVec3 {
    let centre = DVec3::new(p.x, p.y, 0.0).normalize() * 2.0;
    (p - centre).normalize()
}

/// Largest value of `f` over points of a surface, and the number of points without one.
pub fn worst(
    surface: &RationalSurface,
    n: usize,
    m: usize,
    f: impl Fn(DVec3) -> f64,
) -> (f64, usize) {
    let mesh = surface.tessellate(n, m);
    (mesh.positions.iter().map(|&p| f(p).abs()).fold(0.0, f64::max), mesh.missing)
}
