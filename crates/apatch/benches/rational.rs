//! Weights, surface points and rays: time for each of 10⁵ faces, and growth.

use std::hint::black_box;

use apatch::basemesh::{TriMesh, VertexMap};
use apatch::glam::DVec3;
use apatch::rational::{
    Normals, RationalSurface, RepairSettings, Settings, SheetSettings, SurfacePoint,
};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// A torus with mixed convexity and its unit normals.
fn torus(faces: usize) -> (TriMesh, VertexMap<DVec3>) {
    let across = (faces as f64 / 4.0).sqrt().round();
    let (around, across) = (2.0 * across, across);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred")]
    let mesh = testkit::meshes::torus_grid([2.0, 0.8], around as usize, across as usize);
    let normal = |p: DVec3| (p - DVec3::new(p.x, p.y, 0.0).normalize() * 2.0).normalize();
    let normals = mesh.positions().as_slice().iter().map(|&p| normal(p)).collect();
    (mesh, VertexMap::from_vec(normals))
}

/// Everything once per face, without the grids of the single-sheet bounds: a grid of one step.
fn without_bounds() -> Settings {
    let sheet = SheetSettings { grid: 1, refine: false, ..SheetSettings::default() };
    Settings { sheet, repair: RepairSettings::NONE, ..Settings::default() }
}

fn with_bounds() -> Settings {
    let sheet = SheetSettings { grid: 24, refine: false, ..SheetSettings::default() };
    Settings { sheet, repair: RepairSettings::NONE, ..Settings::default() }
}

fn weights(c: &mut Criterion) {
    for (name, settings) in [("weights", without_bounds()), ("weights_and_bounds", with_bounds())] {
        let mut group = c.benchmark_group(name);
        group.sample_size(10);
        for faces in [1_000, 10_000, 100_000] {
            let (mesh, normals) = torus(faces);
            let count = mesh.topology().face_count();
            group.throughput(Throughput::Elements(count as u64));
            group.bench_function(BenchmarkId::from_parameter(count), |b| {
                b.iter_with_large_drop(|| {
                    let normals = Normals::Given(normals.clone());
                    RationalSurface::new(mesh.clone(), normals, &settings)
                });
            });
        }
        group.finish();
    }
}

fn points(c: &mut Criterion) {
    let (mesh, normals) = torus(100_000);
    let surface = RationalSurface::new(mesh, Normals::Given(normals), &without_bounds())
        .expect("a torus has normals");
    let mut group = c.benchmark_group("points");
    group.sample_size(10);
    // ten points of each face, one after the other
    let at = |i: usize| {
        let (u, v) = (0.05 + 0.08 * i as f64, 0.9 - 0.08 * i as f64);
        [u, 0.9 * v * (1.0 - u), 1.0 - u - 0.9 * v * (1.0 - u)]
    };
    let lattice: Vec<[f64; 3]> = (0..10).map(at).collect();
    let topology = surface.mesh().topology();
    group.throughput(Throughput::Elements(10 * topology.face_count() as u64));
    let sum = |points: &[Option<SurfacePoint>]| {
        let points = points.iter().flatten();
        points.fold(DVec3::ZERO, |sum, p| sum + p.point + p.normal())
    };
    group.bench_function("faces", |b| {
        let mut points = Vec::new();
        b.iter(|| {
            let of_face = |f| {
                points.clear();
                surface.face(f).points(&lattice, &mut points);
                sum(&points)
            };
            topology.faces().map(of_face).sum::<DVec3>()
        });
    });
    group.bench_function("faces one by one", |b| {
        b.iter(|| {
            let points = topology.faces().flat_map(|f| lattice.iter().map(move |&x| (f, x)));
            let sum = points.filter_map(|(f, x)| surface.face_point(f, x));
            sum.fold(DVec3::ZERO, |sum, p| sum + p.point + p.normal())
        });
    });
    group.throughput(Throughput::Elements(10 * topology.edge_count() as u64));
    let square: Vec<[f64; 2]> = lattice.iter().map(|x| [x[0], x[1]]).collect();
    group.bench_function("edges", |b| {
        let mut points = Vec::new();
        b.iter(|| {
            let of_edge = |e| {
                points.clear();
                surface.edge(e).points(&square, &mut points);
                sum(&points)
            };
            topology.edges().map(of_edge).sum::<DVec3>()
        });
    });
    group.bench_function("edges one by one", |b| {
        b.iter(|| {
            let points =
                topology.edges().flat_map(|e| lattice.iter().map(move |&x| (e, [x[0], x[1]])));
            let sum = points.filter_map(|(e, x)| surface.edge_point(e, x));
            sum.fold(DVec3::ZERO, |sum, p| sum + p.point + p.normal())
        });
    });
    group.finish();
}

fn rays(c: &mut Criterion) {
    let (mesh, normals) = torus(10_000);
    let surface = RationalSurface::new(mesh, Normals::Given(normals), &without_bounds())
        .expect("a torus has normals");
    let hull = surface.hull();
    c.bench_function("ray", |b| {
        let mut angle = 0.0_f64;
        b.iter(|| {
            angle += 0.1;
            let origin =
                DVec3::new(4.0 * angle.cos(), 4.0 * angle.sin(), 0.3 * (7.0 * angle).sin());
            let direction = DVec3::new(-angle.cos(), -angle.sin(), 0.0);
            hull.cast(black_box(&apatch::Ray { origin, direction }))
        });
    });
}

criterion_group!(benches, weights, points, rays);
criterion_main!(benches);
