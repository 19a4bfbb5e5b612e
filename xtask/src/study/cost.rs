//! Seconds per face of the whole pipeline, on one thread.

use std::collections::BTreeMap;
use std::time::Instant;

use anyhow::{Context, Result};
use serde::Serialize;
use smoothpatch::implicit::NamedShape;
use smoothpatch::{Method, Settings, Silent, fit};

/// Faces asked for, and how often the fit is repeated; the shortest time counts.
const SIZES: [(usize, usize); 3] = [(1_000, 5), (10_000, 3), (100_000, 1)];
const SHAPE: &str = "torus";

/// What a fit costs.
#[derive(Debug, Serialize)]
pub(super) struct Cost {
    pub(super) method: Method,
    pub(super) faces: usize,
    pub(super) seconds: f64,
    pub(super) microseconds_per_face: f64,
    /// The same by stage, in time that passed.
    pub(super) stages: BTreeMap<String, f64>,
}

pub(super) fn measure() -> Result<Vec<Cost>> {
    // a thread of its own, so that its clock counts nothing else
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    one_thread.install(|| {
        let methods = [Method::Published, Method::Refined];
        let cases = methods.into_iter().flat_map(|method| SIZES.map(|size| (method, size)));
        cases.map(|(method, (faces, repeats))| cost(method, faces, repeats)).collect()
    })
}

fn cost(method: Method, faces: usize, repeats: usize) -> Result<Cost> {
    let shape = NamedShape::find(SHAPE).context("a shape of the catalogue")?;
    let field = shape.field();
    let settings = Settings::with_faces(faces).with_method(method);
    let mut runs = Vec::new();
    for _ in 0..repeats {
        let start = Clock::start();
        let surface = fit(&*field, &shape.region, &settings, &mut Silent)?;
        let seconds = start.seconds();
        let faces = surface.mesh.topology().face_count();
        let per_face = |seconds| 1e6 * seconds / faces as f64;
        let stages = surface.times.iter().map(|(stage, s)| (stage.to_string(), per_face(s)));
        let stages = stages.collect();
        let microseconds_per_face = per_face(seconds);
        runs.push(Cost { method, faces, seconds, microseconds_per_face, stages });
    }
    let shortest = runs.into_iter().min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    shortest.context("at least one run")
}

/// Time that this thread ran, where the system tells, so that other work does not count; else the
/// time that passed.
enum Clock {
    Running(f64),
    Wall(Instant),
}

impl Clock {
    fn start() -> Self {
        thread_seconds().map_or_else(|| Self::Wall(Instant::now()), Self::Running)
    }

    fn seconds(&self) -> f64 {
        match self {
            Self::Running(start) => thread_seconds().unwrap_or(f64::NAN) - start,
            Self::Wall(start) => start.elapsed().as_secs_f64(),
        }
    }
}

/// Linux: the first number is nanoseconds on a processor.
fn thread_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}
