//! Building and evaluating surfaces of a million triangles, on one thread. Times are per iteration;
//! the throughput is in triangles, or in points where points are evaluated.
#![allow(clippy::unwrap_used, reason = "benches fail like tests")]

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use nagata::bezier_core::Barycentric;
use nagata::glam::{DVec2, DVec3};
use nagata::{CornerNormals, NagataSurface, Patch, PolygonMesh, Settings};

const AROUND: usize = 1000;
const ACROSS: usize = 500;
const TRIANGLES: u64 = 2 * (AROUND * ACROSS) as u64;
/// 45 points a patch.
const DIVISIONS: usize = 8;

/// A torus with radii 2 and 1.
fn torus() -> (Vec<DVec3>, Vec<DVec3>, Vec<[usize; 3]>) {
    let turn = |k: usize, n: usize| DVec2::from_angle(TAU * k as f64 / n as f64);
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for v in 0..AROUND * ACROSS {
        let (around, across) = (turn(v / ACROSS, AROUND), turn(v % ACROSS, ACROSS));
        positions.push((around * (2.0 + across.x)).extend(across.y));
        normals.push((around * across.x).extend(across.y));
    }
    let at = |i: usize, j: usize| i % AROUND * ACROSS + j % ACROSS;
    let faces = (0..AROUND * ACROSS)
        .flat_map(|v| {
            let (i, j) = (v / ACROSS, v % ACROSS);
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    (positions, normals, faces)
}

fn build(c: &mut Criterion) {
    let (positions, normals, faces) = torus();
    let mesh = PolygonMesh::new(positions.clone(), &faces).unwrap();
    let normals = CornerNormals::per_vertex(&mesh, &normals).unwrap();
    let c0 = NagataSurface::new(mesh.clone(), normals.clone(), Settings::position()).unwrap();
    let bytes = c0.bytes() as f64 / TRIANGLES as f64;
    let mut group = c.benchmark_group(format!("build ({bytes:.1} bytes a C0 triangle)"));
    group.sample_size(10).throughput(Throughput::Elements(TRIANGLES));
    group.bench_function("mesh and edges", |b| {
        b.iter_batched(
            || positions.clone(),
            |positions| PolygonMesh::new(positions, &faces).unwrap(),
            BatchSize::PerIteration,
        );
    });
    for (name, settings) in [
        ("C0", Settings::position()),
        ("G1 edges, robust", Settings::tangent_plane()),
        ("G1 edges, published", Settings::published()),
    ] {
        group.bench_function(name, |b| {
            b.iter_batched(
                || (mesh.clone(), normals.clone()),
                |(mesh, normals)| NagataSurface::new(mesh, normals, settings).unwrap(),
                BatchSize::PerIteration,
            );
        });
    }
    for (name, settings) in [
        ("C0 patches", Settings::position()),
        ("G1 patches, robust", Settings::tangent_plane()),
        ("G1 patches, published", Settings::published()),
    ] {
        let surface = NagataSurface::new(mesh.clone(), normals.clone(), settings).unwrap();
        group.bench_function(name, |b| {
            b.iter(|| surface.mesh().faces().for_each(|face| _ = black_box(surface.patch(face))));
        });
    }
}

fn evaluate(c: &mut Criterion) {
    let (positions, normals, faces) = torus();
    let mesh = PolygonMesh::new(positions, &faces).unwrap();
    let normals = CornerNormals::per_vertex(&mesh, &normals).unwrap();
    let lattice: Vec<Barycentric> = Barycentric::lattice(DIVISIONS).collect();
    let mut points = vec![DVec3::ZERO; lattice.len()];
    let mut group = c.benchmark_group("points");
    let count = lattice.len() as u64 * 1000;
    group.throughput(Throughput::Elements(count));
    let patches = |settings| -> Vec<Patch> {
        let surface = NagataSurface::new(mesh.clone(), normals.clone(), settings).unwrap();
        surface.mesh().faces().take(1000).map(|face| surface.patch(face)).collect()
    };
    let c0 = patches(Settings::position());
    group.bench_function("C0, batch of 45 in cache", |b| {
        b.iter(|| {
            for patch in &c0 {
                let Patch::Triangle(patch) = patch else { unreachable!("asked for C0") };
                patch.sample(DIVISIONS, &mut points);
                black_box(&points);
            }
        });
    });
    let mut all = vec![DVec3::ZERO; lattice.len() * c0.len()];
    group.bench_function("C0, batches of 45 to memory", |b| {
        b.iter(|| {
            for (patch, points) in c0.iter().zip(all.chunks_exact_mut(lattice.len())) {
                let Patch::Triangle(patch) = patch else { unreachable!("asked for C0") };
                patch.sample(DIVISIONS, points);
            }
            black_box(&all);
        });
    });
    for (name, settings) in
        [("G1 published", Settings::published()), ("G1 robust", Settings::tangent_plane())]
    {
        let g1 = patches(settings);
        group.bench_function(format!("{name}, points one by one"), |b| {
            b.iter(|| {
                for patch in &g1 {
                    let Patch::TangentPlane(patch) = patch else { unreachable!("asked for G1") };
                    lattice.iter().for_each(|at| _ = black_box(patch.point(*at)));
                }
            });
        });
        group.bench_function(format!("{name}, normals one by one"), |b| {
            b.iter(|| {
                for patch in &g1 {
                    let Patch::TangentPlane(patch) = patch else { unreachable!("asked for G1") };
                    lattice.iter().for_each(|at| _ = black_box(patch.normal(*at)));
                }
            });
        });
    }
}

criterion_group!(benches, build, evaluate);
criterion_main!(benches);
