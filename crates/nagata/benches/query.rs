//! Queries on a surface of 100 000 triangles, on one thread; times are for one query.
#![allow(clippy::unwrap_used, reason = "benches fail like tests")]

use std::f64::consts::{PI, TAU};
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nagata::glam::{DVec2, DVec3};
use nagata::{CornerNormals, NagataSurface, PolygonMesh, Ray, Settings, SurfaceQueries};

const AROUND: usize = 500;
const ACROSS: usize = 100;
const QUERIES: usize = 4096;

/// A torus with radii 2 and 1.
fn torus(settings: Settings) -> NagataSurface {
    let turn = |k: usize, n: usize| DVec2::from_angle(TAU * k as f64 / n as f64);
    let point = |v: usize| {
        let (around, across) = (turn(v / ACROSS, AROUND), turn(v % ACROSS, ACROSS));
        (around * (2.0 + across.x)).extend(across.y)
    };
    let at = |i: usize, j: usize| i % AROUND * ACROSS + j % ACROSS;
    let faces: Vec<[usize; 3]> = (0..AROUND * ACROSS)
        .flat_map(|v| {
            let (i, j) = (v / ACROSS, v % ACROSS);
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let mesh = PolygonMesh::new((0..AROUND * ACROSS).map(point).collect(), &faces).unwrap();
    let normals = CornerNormals::from_fn(&mesh, |p| {
        Some((p - (p.truncate().normalize() * 2.0).extend(0.0)).normalize())
    });
    NagataSurface::new(mesh, normals, settings).unwrap()
}

/// Numbers from -1 to 1, the same in every run.
fn random() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }
}

/// Points in a box around the torus: 0.9 from it in the mean, twenty edges.
fn points() -> Vec<DVec3> {
    let mut next = random();
    (0..QUERIES).map(|_| DVec3::new(4.0 * next(), 4.0 * next(), 2.0 * next())).collect()
}

/// Points as contact has them: up to 0.05 from the torus, an edge, on both sides.
fn contact_points() -> Vec<DVec3> {
    let mut next = random();
    let mut point = || {
        let (around, tube) = (DVec2::from_angle(PI * next()), DVec2::from_angle(PI * next()));
        let radius = 1.0 + 0.05 * next();
        (around * (2.0 + radius * tube.x)).extend(radius * tube.y)
    };
    (0..QUERIES).map(|_| point()).collect()
}

fn queries(c: &mut Criterion) {
    let (points, contact) = (points(), contact_points());
    for (name, settings) in [("c0", Settings::position()), ("g1", Settings::tangent_plane())] {
        let surface = torus(settings);
        let mut group = c.benchmark_group(format!("query_{name}_100000_triangles"));
        group.sample_size(10);
        group.bench_function("prepare", |b| b.iter(|| SurfaceQueries::new(black_box(&surface))));
        let queries = SurfaceQueries::new(&surface);
        let mut k = 0;
        let mut next = || {
            k = (k + 1) % QUERIES;
            points[k]
        };
        group.bench_function("closest, far", |b| b.iter(|| queries.closest(black_box(next()))));
        let mut at = contact.iter().cycle();
        group.bench_function("closest, contact", |b| {
            b.iter(|| at.next().map(|p| queries.closest(black_box(*p))));
        });
        let ray = |p: DVec3| Ray { origin: p * 3.0, direction: -p };
        group.bench_function("first_hit", |b| b.iter(|| queries.first_hit(&ray(next()))));
        group.bench_function("hits", |b| b.iter(|| queries.hits(&ray(next()))));
        group.finish();
    }
}

criterion_group!(benches, queries);
criterion_main!(benches);
