//! Rational A-patches: quadrics, the paper's configurations, orders, flat parts, and rough meshes.

pub(super) mod promises;

use anyhow::Result;
use smoothpatch::apatch::PatchKind;
use smoothpatch::apatch::rational::{Normals, RationalSurface, Settings};
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{TriMesh, VertexMap};
use smoothpatch::io::read_obj_file;
use testkit::meshes::{
    cushion, double_torus, hyperboloid, icosphere, l_block, mapped, noisy_sphere, torus_grid,
    two_triangles,
};

use super::{Case, Measured};
use crate::check::Check;
use promises::promises;

const SCHEME: &str = "rational A";
/// Largest distance from a quadric whose gradients are given.
const EXACT: f64 = 1e-11;

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![
        Case::new("icosahedron", SCHEME, |_| {
            quadric(&icosphere(0), |p| 2.0 * p, |p| p.length() - 1.0)
        }),
        Case::new("ellipsoid", SCHEME, |_| {
            let axes = DVec3::new(1.0, 1.5, 0.7);
            let mesh = mapped(&icosphere(1), |p| p * axes);
            let value = move |p: DVec3| (p / axes).length_squared() - 1.0;
            quadric(&mesh, move |p| 2.0 * p / (axes * axes), value)
        }),
        Case::new("hyperboloid", SCHEME, |_| {
            let value = |p: DVec3| p.x * p.x + p.y * p.y - 0.5 * p.z * p.z - 1.0;
            quadric(&hyperboloid(10, 4), |p| DVec3::new(2.0 * p.x, 2.0 * p.y, -p.z), value)
        }),
        Case::new("torus 2, 0.8", SCHEME, |_| torus()),
        Case::new("quartic", SCHEME, |_| quartic()),
        Case::new("flat cushion", SCHEME, |_| flat_parts()),
        rough("double torus voxels", || Ok(double_torus())),
        rough("L block", || Ok(l_block())),
        rough("spot", || {
            Ok(read_obj_file(crate::root().join("fixtures/meshes/spot_triangulated.obj"))?)
        }),
    ];
    for (name, mesh, normals) in two_triangles() {
        cases.push(Case::new(name, SCHEME, move |_| {
            let normals = Normals::Given(normals.clone());
            let surface = RationalSurface::new(mesh.clone(), normals, &Settings::default())?;
            Ok(promises(&surface, 20))
        }));
    }
    for percent in [20, 30] {
        cases.push(rough(&format!("sphere, noise {percent} %"), move || {
            Ok(noisy_sphere(f64::from(percent) / 100.0, 1))
        }));
    }
    cases
}

fn given(mesh: &TriMesh, normal: impl Fn(DVec3) -> DVec3 + Sync) -> Normals {
    Normals::Given(mesh.positions().map(|_, &p| normal(p)))
}

/// Largest value of `f` over the points of a tessellation.
fn largest(surface: &RationalSurface, steps: usize, f: impl Fn(DVec3) -> f64) -> f64 {
    let points = surface.tessellate(steps, steps).positions;
    points.into_iter().map(|p| f(p).abs()).fold(0.0, f64::max)
}

fn quadric(
    mesh: &TriMesh,
    gradient: impl Fn(DVec3) -> DVec3 + Sync,
    value: impl Fn(DVec3) -> f64,
) -> Result<Measured> {
    let surface = RationalSurface::new(mesh.clone(), given(mesh, gradient), &Settings::default())?;
    let off = largest(&surface, 12, value);
    let mut measured = promises(&surface, 12);
    measured.deviation = Some(off / surface.mesh().diagonal());
    measured.checks.push(Check::at_most("distance from the quadric", off, EXACT));
    Ok(measured)
}

/// Errors from unit normals on meshes of which each has twice the resolution of the one before.
fn convergence(
    meshes: impl ExactSizeIterator<Item = TriMesh>,
    normal: impl Fn(DVec3) -> DVec3 + Sync,
    distance: impl Fn(DVec3) -> f64,
    order: f64,
) -> Result<Measured> {
    let mut errors = Vec::new();
    let mut last = None;
    for mesh in meshes {
        let normals = given(&mesh, &normal);
        let surface = RationalSurface::new(mesh, normals, &Settings::default())?;
        errors.push(largest(&surface, 6, &distance));
        last = Some(surface);
    }
    let surface = last.expect("invariant: several meshes");
    let mut measured = promises(&surface, 3);
    let [first, .., before, finest] = errors[..] else {
        unreachable!("invariant: three meshes at least")
    };
    measured.deviation = Some(finest / surface.mesh().diagonal());
    measured.order = Some((before / finest).log2());
    let mean = (first / finest).log2() / (errors.len() - 1) as f64;
    measured.checks.push(Check::at_least("order over all meshes", mean, order));
    Ok(measured)
}

fn torus() -> Result<Measured> {
    let meshes = (0..4).map(|level| torus_grid([2.0, 0.8], 8 << level, 6 << level));
    let ring = |p: DVec3| DVec3::new(p.x, p.y, 0.0);
    let normal = move |p: DVec3| (p - ring(p).normalize() * 2.0).normalize();
    convergence(meshes, normal, |p| (ring(p).length() - 2.0).hypot(p.z) - 0.8, 3.0)
}

/// `x⁴ + y⁴ + z⁴ = 1`; the order shows from 320 faces on.
fn quartic() -> Result<Measured> {
    let value = |p: DVec3| p.x.powi(4) + p.y.powi(4) + p.z.powi(4) - 1.0;
    let gradient = |p: DVec3| 4.0 * DVec3::new(p.x.powi(3), p.y.powi(3), p.z.powi(3));
    let onto = move |p: DVec3| p / (value(p) + 1.0).powf(0.25);
    let meshes = (2..6).map(|level| mapped(&icosphere(level), onto));
    let normal = move |p: DVec3| gradient(p).normalize();
    convergence(meshes, normal, |p| value(p) / gradient(p).length(), 2.9)
}

/// Faces whose normals are all perpendicular to them are part of the surface.
fn flat_parts() -> Result<Measured> {
    let (mesh, normals): (TriMesh, VertexMap<DVec3>) = cushion();
    let surface = RationalSurface::new(mesh, Normals::Given(normals), &Settings::default())?;
    let flat = surface.report().faces.zero;
    let mut measured = promises(&surface, 8);
    measured.checks.push(Check::exactly("flat faces", i64::try_from(flat)?, 16));
    let mesh = surface.tessellate(8, 8);
    let flat = mesh.triangles.iter().zip(&mesh.kinds).filter(|(_, k)| **k == PatchKind::FlatFace);
    let heights = flat.flat_map(|(t, _)| t.map(|i| mesh.positions[i].z.abs() - 0.5));
    let off = heights.map(f64::abs).fold(0.0, f64::max);
    measured.checks.push(Check::at_most("distance of flat parts from their planes", off, 0.0));
    Ok(measured)
}

/// A mesh without normals; all edge tetrahedra must be valid after repair.
fn rough(name: &str, mesh: impl Fn() -> Result<TriMesh> + 'static) -> Case {
    Case::new(name, SCHEME, move |_| {
        let surface = RationalSurface::new(mesh()?, Normals::Estimated, &Settings::default())?;
        Ok(promises(&surface, 6))
    })
}
