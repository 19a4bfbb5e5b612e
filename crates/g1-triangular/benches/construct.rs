//! Filling and joining a torus, in both methods, with a thousand and a hundred thousand faces: the
//! time per face should not depend on their number. Feet are found in closed form, so that the
//! construction is measured and not the projection.

use criterion::{BatchSize, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use g1_triangular::basemesh::{EdgeMap, Foot, SurfaceTarget, TriMesh, VertexMap};
use g1_triangular::bezier_core::SurfaceJet;
use g1_triangular::bezier_core::glam::DVec3;
use g1_triangular::{CurveNetwork, Plan, Settings, fill, join};
use hermite_sqp::{CurveSample, EdgeProblem, solve};
use implicit::{Torus, surface_point};
use testkit::meshes::torus_grid;

const RADII: [f64; 2] = [2.0, 1.0];

struct ClosestOnTorus;

impl SurfaceTarget for ClosestOnTorus {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let centre = DVec3::new(near.x, near.y, 0.0).try_normalize()? * RADII[0];
        let normal = (near - centre).try_normalize()?;
        Some(Foot { point: centre + normal * RADII[1], normal })
    }
}

struct Input {
    mesh: TriMesh,
    jets: VertexMap<SurfaceJet>,
    network: CurveNetwork,
}

fn input(around: usize, across: usize) -> Input {
    let field = Torus { major_radius: RADII[0], minor_radius: RADII[1] };
    let mesh = torus_grid(RADII, around, across);
    let jets = mesh.positions().map(|_, &point| {
        let at = surface_point(&field, point).expect("a torus has no singular point");
        SurfaceJet { point, normal: at.normal, second_fundamental_form: at.second_fundamental_form }
    });
    let curves = EdgeMap::from_fn(mesh.topology().edge_count(), |edge| {
        let [a, b] = mesh.topology().edge_vertices(edge).map(|v| jets[v]);
        let samples: Vec<CurveSample> = (1..10)
            .map(|j| f64::from(j) / 10.0)
            .map(|t| {
                let foot = ClosestOnTorus.foot(a.point.lerp(b.point, t));
                CurveSample { t, point: foot.expect("chords avoid the centre").point }
            })
            .collect();
        let problem = EdgeProblem::new(&a, &b, &samples).expect("vertices are distinct");
        solve(&problem, &hermite_sqp::Settings::default()).curve
    });
    Input { network: CurveNetwork::new(curves), mesh, jets }
}

fn construct(c: &mut Criterion) {
    for (around, across) in [(32, 16), (316, 158)] {
        let Input { mesh, jets, network } = input(around, across);
        let faces = mesh.topology().face_count();
        for (method, settings) in
            [("published", Settings::PUBLISHED), ("refined", Settings::REFINED)]
        {
            let plan = Plan::uniform(mesh.topology(), settings);
            let target = &ClosestOnTorus;
            let mut group = c.benchmark_group(format!("{method}/{faces}"));
            group.sample_size(10).sampling_mode(SamplingMode::Flat);
            group.throughput(Throughput::Elements(faces as u64));
            group.bench_function("fill", |b| b.iter(|| fill(&mesh, &network, target, &plan)));
            let filled = fill(&mesh, &network, target, &plan).nets;
            group.bench_function("join", |b| {
                b.iter_batched(
                    || filled.clone(),
                    |nets| join(&mesh, &jets, &network, nets, target, &plan),
                    BatchSize::PerIteration,
                );
            });
            group.finish();
        }
    }
}

criterion_group!(benches, construct);
criterion_main!(benches);
