//! Smooth solids: cost a face of the hull, of both schemes and of meshes.

#![allow(clippy::print_stdout, reason = "one run of the largest solid is printed")]

use std::hint::black_box;
use std::time::Instant;

use apatch::glam::DVec3;
use apatch::polyhedral::{PolyhedralSurface, Polyhedron, Scheme, Settings};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// A convex solid whose faces have five or six corners, about `faces` of them: the dual of points
/// spread over a sphere.
fn solid(faces: usize) -> Polyhedron {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let point = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / faces as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * cos, r * sin, z)
    };
    let points: Vec<DVec3> = (0..faces).map(point).collect();
    Polyhedron::convex_hull(&points).and_then(|hull| hull.dual()).expect("a convex solid")
}

fn settings(scheme: Scheme) -> Settings {
    Settings { scheme, ..Settings::default() }
}

fn elements(faces: usize) -> Throughput {
    Throughput::Elements(faces as u64)
}

fn c1(c: &mut Criterion) {
    let mut group = c.benchmark_group("c1_cubic");
    for faces in [20, 60, 180, 500] {
        let solid = solid(faces);
        group.throughput(elements(faces));
        group.bench_with_input(BenchmarkId::new("whole", faces), &solid, |b, solid| {
            b.iter(|| PolyhedralSurface::new(black_box(solid), &settings(Scheme::C1Cubic)));
        });
        let surface =
            PolyhedralSurface::new(&solid, &settings(Scheme::C1Cubic)).expect("a surface");
        group.bench_with_input(BenchmarkId::new("weights", faces), &surface, |b, surface| {
            b.iter(|| black_box(surface).hull().cubic_weights(&Settings::default().shape));
        });
        group.bench_with_input(BenchmarkId::new("mesh 6x6", faces), &surface, |b, surface| {
            b.iter(|| black_box(surface).tessellate(6, 6));
        });
    }
    group.finish();
}

fn bench_whole(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    name: &str,
    solid: &Polyhedron,
) {
    group.throughput(elements(solid.facets().len()));
    group.bench_function(name, |b| {
        b.iter(|| PolyhedralSurface::new(black_box(solid), &settings(Scheme::C2Quintic)));
    });
}

fn c2(c: &mut Criterion) {
    let mut group = c.benchmark_group("c2_quintic");
    group.sample_size(10);
    for faces in [20, 60] {
        bench_whole(&mut group, &format!("whole/{faces}"), &solid(faces));
    }
    // the next ones need conditions on signs
    for name in ["icosahedron", "l-prism", "frame"] {
        let solid = Polyhedron::named(name).expect("a solid");
        bench_whole(&mut group, name, &solid);
    }
    let points = testkit::solids::sphere_points(2, 12);
    bench_whole(
        &mut group,
        "random triangles",
        &Polyhedron::convex_hull(&points).expect("a solid"),
    );
    group.finish();
}

/// Large solids take too long for ten samples: one run each.
fn c2_once(_: &mut Criterion) {
    for faces in [180, 500] {
        let solid = solid(faces);
        let start = Instant::now();
        let surface = PolyhedralSurface::new(&solid, &settings(Scheme::C2Quintic));
        let each = start.elapsed().as_secs_f64() / faces as f64;
        let bad = surface.expect("a surface").report().bad_rays[0];
        println!("c2_quintic/once/{faces}: {:.0} ms a face, {bad} bad rays", 1e3 * each);
    }
}

criterion_group!(benches, c1, c2, c2_once);
criterion_main!(benches);
