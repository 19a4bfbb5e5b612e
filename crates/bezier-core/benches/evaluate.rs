//! Evaluation of patches of degree 7: one point at a time in every form, rows along an edge, and
//! the batches in which patches are measured.

use std::hint::black_box;

use bezier_core::glam::DVec3;
use bezier_core::{
    Barycentric, LocalEdge, MultiIndex, ParameterGrid, ParametricPatch, PointMap, QuarticCurve,
    QuarticTriangle, Seam, SepticTriangle,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn patch(height: f64) -> SepticTriangle {
    let corners = [DVec3::X, DVec3::Y, DVec3::Z];
    SepticTriangle::from_fn(|m: MultiIndex| {
        let weights = [m.i, m.j, m.k].map(|exponent| exponent as f64 / 7.0);
        let flat = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        flat * (1.0 + height * (m.rank() as f64).sin())
    })
}

fn single(c: &mut Criterion) {
    let patch = patch(0.05);
    let at = Barycentric::new(0.31, 0.24);
    let mut group = c.benchmark_group("septic");
    group.bench_function("point", |b| b.iter(|| black_box(&patch).eval(black_box(at))));
    group.bench_function("point/de_casteljau", |b| {
        b.iter(|| black_box(&patch).eval_de_casteljau(black_box(at)));
    });
    group.bench_function("point_and_area_normal", |b| {
        b.iter(|| black_box(&patch).point_and_area_normal(black_box(at)));
    });
    group.bench_function("jet", |b| b.iter(|| black_box(&patch).jet(black_box(at))));
    group.bench_function("surface_jet", |b| {
        b.iter(|| black_box(&patch).jet(black_box(at)).surface_jet());
    });
    group.finish();
}

fn batches(c: &mut Criterion) {
    let patch = patch(0.05);
    let mut group = c.benchmark_group("septic/batch");
    for divisions in [12, 16, 44] {
        let parameters: Vec<Barycentric> = Barycentric::lattice(divisions).collect();
        group.throughput(Throughput::Elements(parameters.len() as u64));
        group.bench_function(format!("point/{}", parameters.len()), |b| {
            b.iter(|| {
                parameters
                    .iter()
                    .map(|&at| black_box(&patch).eval(at))
                    .fold(DVec3::ZERO, |s, p| s + p)
            });
        });
        group.bench_function(format!("point_and_area_normal/{}", parameters.len()), |b| {
            b.iter(|| {
                let both = parameters.iter().map(|&at| black_box(&patch).point_and_area_normal(at));
                both.fold(DVec3::ZERO, |sum, (p, n)| sum + p + n)
            });
        });
    }
    group.finish();
}

/// Many patches at the same parameters, as when they are measured or tessellated, and one patch at
/// parameters of its own.
fn grids(c: &mut Criterion) {
    let patches: Vec<SepticTriangle> = (0..64).map(|i| patch(0.01 * f64::from(i))).collect();
    let mut group = c.benchmark_group("septic/grid");
    for divisions in [12, 16] {
        let grid = ParameterGrid::<36>::lattice(divisions);
        let count = grid.parameters().len();
        let mut points = vec![DVec3::ZERO; count];
        let mut normals = points.clone();
        group.throughput(Throughput::Elements((patches.len() * count) as u64));
        group.bench_function(format!("points/{count}"), |b| {
            b.iter(|| {
                for patch in &patches {
                    grid.points(black_box(patch), black_box(&mut points));
                }
            });
        });
        group.bench_function(format!("points_and_unit_normals/{count}"), |b| {
            b.iter(|| {
                for patch in &patches {
                    grid.points_and_area_normals(black_box(patch), &mut points, &mut normals);
                    normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
                    black_box((&points, &normals));
                }
            });
        });
        group.bench_function(format!("own parameters/{count}"), |b| {
            b.iter(|| {
                for patch in &patches {
                    let at = black_box(grid.parameters());
                    black_box(patch).points_and_area_normals(at, &mut points, &mut normals);
                    normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
                    black_box((&points, &normals));
                }
            });
        });
    }
    group.finish();
}

/// The linear map of the least-squares fit of the inner points of a patch to samples.
fn shared_fit(c: &mut Criterion) {
    let samples: Vec<DVec3> = (0..66).map(|i| DVec3::splat(f64::from(i)).sin()).collect();
    let weight = |out: usize, sample: usize| ((out * 66 + sample) as f64).cos();
    let from_samples = PointMap::new(15, 66, weight);
    let from_boundary = PointMap::new(15, 36, weight);
    c.bench_function("shared_fit/15 of 66", |b| {
        b.iter(|| {
            let fitted: [DVec3; 15] = from_samples.to_array(black_box(&samples));
            let given: [DVec3; 15] = from_boundary.to_array(black_box(&samples[..36]));
            (fitted, given)
        });
    });
}

fn rows(c: &mut Criterion) {
    let (left, right) = (patch(0.05), patch(0.04));
    let edge = LocalEdge::ALL[1];
    c.bench_function("rows/boundary", |b| b.iter(|| black_box(&left).boundary::<8>(edge)));
    c.bench_function("rows/first_inner", |b| {
        b.iter(|| black_box(&left).first_inner_row::<7>(edge));
    });
    let seam = Seam { left: &left, left_edge: edge, right: &right, right_edge: edge };
    c.bench_function("seam/max_normal_angle/22", |b| {
        b.iter(|| black_box(seam).max_normal_angle(22));
    });
    c.bench_function("seam/coplanarity_residual", |b| {
        b.iter(|| black_box(seam).coplanarity_residual::<7>());
    });
}

fn elevation(c: &mut Criterion) {
    let quartic =
        QuarticTriangle::from_fn(|m| DVec3::new(m.i as f64, m.j as f64, (m.k * m.i) as f64));
    let curve: QuarticCurve = quartic.boundary(LocalEdge::ALL[0]);
    c.bench_function("elevate/triangle/4-7", |b| {
        b.iter(|| black_box(&quartic).elevate_to::<36>());
    });
    c.bench_function("elevate/curve/4-7", |b| b.iter(|| black_box(&curve).elevate_to::<8>()));
}

criterion_group!(benches, single, batches, grids, shared_fit, rows, elevation);
criterion_main!(benches);
