//! Meshes and measures that several suites share.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]
#![allow(dead_code, unused_imports, unreachable_pub, reason = "each suite uses its part")]

use apatch::basemesh::{TriMesh, VertexMap};
use apatch::glam::DVec3;
use apatch::rational::{Normals, RationalSurface, Settings};
pub use testkit::Numbers;
pub use testkit::meshes::{double_torus, hyperboloid, l_block, mapped, noisy_sphere};

/// The configurations of \[XHB01, Figures 6, 7, 9, 10\].
pub fn figures() -> Vec<(&'static str, TriMesh, Normals)> {
    let all = testkit::meshes::two_triangles().into_iter();
    all.map(|(name, mesh, normals)| (name, mesh, Normals::Given(normals))).collect()
}

pub fn given(mesh: &TriMesh, normal: impl Fn(DVec3) -> DVec3) -> Normals {
    let normals = mesh.positions().as_slice().iter().map(|&p| normal(p)).collect();
    Normals::Given(VertexMap::from_vec(normals))
}

pub fn surface(mesh: &TriMesh, normals: Normals) -> RationalSurface {
    RationalSurface::new(mesh.clone(), normals, &Settings::default()).unwrap()
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
