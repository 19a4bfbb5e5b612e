//! Building and evaluating surfaces of a million triangles, on one thread; figures of the README are with the
//! feature `simd`. Times are per iteration; the throughput is in triangles, or in points where points are
//! evaluated. Of some results the time to write them is measured, too.
#![allow(clippy::unwrap_used, reason = "benches fail like tests")]

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use nagata::bezier_core::Barycentric;
use nagata::glam::{DVec2, DVec3};
use nagata::{
    CornerNormals, G1Triangle, NagataSurface, NagataTriangle, Patch, PolygonMesh, Settings,
};

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
    group.bench_function("mesh: checks and table of edges", |b| {
        b.iter_batched(
            || positions.clone(),
            |positions| PolygonMesh::new(positions, &faces).unwrap(),
            BatchSize::PerIteration,
        );
    });
    for (name, settings) in [
        ("C0 surface on a mesh", Settings::position()),
        ("G1 surface on a mesh, robust", Settings::tangent_plane()),
        ("G1 surface on a mesh, published", Settings::published()),
    ] {
        group.bench_function(name, |b| {
            b.iter_batched(
                || (mesh.clone(), normals.clone()),
                |(mesh, normals)| NagataSurface::new(mesh, normals, settings).unwrap(),
                BatchSize::PerIteration,
            );
        });
    }
    group.bench_function("fresh memory for the curves written only", |b| {
        let curves = mesh.edge_count();
        b.iter_with_large_drop(|| vec![black_box(DVec3::ONE); curves]);
    });
    group.bench_function("C0 surface, in the memory of the last one", |b| {
        let mut surface = c0.clone();
        b.iter_batched(
            || normals.clone(),
            |normals| surface.update(&positions, normals).unwrap(),
            BatchSize::PerIteration,
        );
    });
    for (name, settings) in [
        ("C0 patches of a surface", Settings::position()),
        ("G1 patches of a surface, robust", Settings::tangent_plane()),
        ("G1 patches of a surface, published", Settings::published()),
    ] {
        let surface = NagataSurface::new(mesh.clone(), normals.clone(), settings).unwrap();
        group.bench_function(name, |b| {
            b.iter(|| surface.mesh().faces().for_each(|face| _ = black_box(surface.patch(face))));
        });
    }
}

/// Patches from the positions and normals of an indexed mesh, no table of edges; and, for comparison, the time
/// that writing results of this size takes.
fn unshared(c: &mut Criterion) {
    /// Patches that are kept while their points are computed.
    const TOGETHER: usize = 64;
    let (positions, normals, faces) = torus();
    let settings = Settings::position().edges;
    let given = |k: usize| {
        let [a, b, c] = faces[k];
        [[positions[a], positions[b], positions[c]], [normals[a], normals[b], normals[c]]]
    };
    let zero = NagataTriangle { corners: [DVec3::ZERO; 3], curvature: [DVec3::ZERO; 3] };
    let mut group = c.benchmark_group("C0 patches, nothing shared");
    group.sample_size(10).throughput(Throughput::Elements(TRIANGLES));
    let mut patches = vec![zero; faces.len()];
    group.bench_function("built", |b| {
        b.iter(|| {
            NagataTriangle::fill_from_normals(&mut patches, &settings, given);
            black_box(&patches);
        });
    });
    group.bench_function("patches written only", |b| b.iter(|| patches.fill(black_box(zero))));
    let mut together = vec![zero; TOGETHER];
    let mut sampled = |part: usize, points: &mut [DVec3]| {
        let patches = &mut together[..points.len() / 15];
        NagataTriangle::fill_from_normals(patches, &settings, |k| given(part * TOGETHER + k));
        NagataTriangle::sample_all(patches, 4, points);
    };
    let mut points = vec![DVec3::ZERO; 15 * TOGETHER];
    group.bench_function("built, and 15 points each", |b| {
        b.iter(|| {
            for (part, faces) in faces.chunks(TOGETHER).enumerate() {
                sampled(part, &mut points[..15 * faces.len()]);
                black_box(&points);
            }
        });
    });
    let mut all = vec![DVec3::ZERO; 15 * faces.len()];
    group.bench_function("built, and 15 points each to memory", |b| {
        b.iter(|| {
            let parts = all.chunks_mut(15 * TOGETHER).enumerate();
            parts.for_each(|(part, points)| sampled(part, points));
            black_box(&all);
        });
    });
    group.bench_function("15 points written only", |b| b.iter(|| all.fill(black_box(DVec3::ONE))));
}

fn evaluate(c: &mut Criterion) {
    /// Patches of which the points are in the cache together.
    const TOGETHER: usize = 8;
    let surface = |settings| {
        let (positions, normals, faces) = torus();
        let mesh = PolygonMesh::new(positions, &faces[..1000]).unwrap();
        let normals = CornerNormals::per_vertex(&mesh, &normals).unwrap();
        NagataSurface::new(mesh, normals, settings).unwrap()
    };
    let lattice: Vec<Barycentric> = Barycentric::lattice(DIVISIONS).collect();
    let c0: Vec<NagataTriangle> = patches(&surface(Settings::position()), |patch| match patch {
        Patch::Triangle(patch) => Some(patch),
        _ => None,
    });
    let mut points = vec![DVec3::ZERO; lattice.len() * TOGETHER];
    let mut group = c.benchmark_group("points");
    group.throughput(Throughput::Elements(lattice.len() as u64 * c0.len() as u64));
    group.bench_function("written only, 45 a patch in cache", |b| {
        b.iter(|| {
            for patches in c0.chunks(TOGETHER) {
                points[..lattice.len() * patches.len()].fill(patches[0].corners[0]);
                black_box(&points);
            }
        });
    });
    group.bench_function("C0, 45 a patch in cache", |b| {
        b.iter(|| {
            for patches in c0.chunks(TOGETHER) {
                let points = &mut points[..lattice.len() * patches.len()];
                NagataTriangle::sample_all(patches, DIVISIONS, points);
                black_box(points);
            }
        });
    });
    let mut all = vec![DVec3::ZERO; lattice.len() * c0.len()];
    group.bench_function("C0, 45 a patch to memory", |b| {
        b.iter(|| {
            NagataTriangle::sample_all(&c0, DIVISIONS, &mut all);
            black_box(&all);
        });
    });
    for (name, settings) in
        [("G1 published", Settings::published()), ("G1 robust", Settings::tangent_plane())]
    {
        let g1: Vec<G1Triangle> = patches(&surface(settings), |patch| match patch {
            Patch::TangentPlane(patch) => Some(patch),
            _ => None,
        });
        group.bench_function(format!("{name}, points one by one"), |b| {
            b.iter(|| {
                for patch in &g1 {
                    lattice.iter().for_each(|at| _ = black_box(patch.point(*at)));
                }
            });
        });
        group.bench_function(format!("{name}, normals one by one"), |b| {
            b.iter(|| {
                for patch in &g1 {
                    lattice.iter().for_each(|at| _ = black_box(patch.normal(*at)));
                }
            });
        });
    }
}

fn patches<P>(surface: &NagataSurface, kind: impl Fn(Patch) -> Option<P>) -> Vec<P> {
    surface.mesh().faces().map(|face| kind(surface.patch(face)).unwrap()).collect()
}

criterion_group!(benches, build, unshared, evaluate);
criterion_main!(benches);
