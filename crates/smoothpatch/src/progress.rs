//! Who wants to know how far the work is.

use std::fmt;
use std::time::Instant;

/// The stages of the pipeline, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Stage {
    /// From the field to a dense triangle mesh.
    Polygonize,
    /// From the dense mesh to the base mesh.
    Simplify,
    /// Normals and curvatures at the vertices.
    Vertices,
    /// The boundary curves.
    Curves,
    /// Patches without gaps.
    Fill,
    /// Patches with common tangent planes.
    Join,
    /// Deviation and continuity.
    Measure,
}

impl Stage {
    /// All stages in order.
    pub const ALL: [Self; 7] = [
        Self::Polygonize,
        Self::Simplify,
        Self::Vertices,
        Self::Curves,
        Self::Fill,
        Self::Join,
        Self::Measure,
    ];

    /// One lower-case word or two, also the key in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Polygonize => "polygonize",
            Self::Simplify => "simplify",
            Self::Vertices => "vertices",
            Self::Curves => "curves",
            Self::Fill => "fill",
            Self::Join => "join",
            Self::Measure => "measure",
        }
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Told when a stage begins and ends.
pub trait Progress {
    /// A stage begins that will produce or treat about `elements` elements (0 if unknown).
    fn begin(&mut self, stage: Stage, elements: usize);
    /// The stage ended after this many seconds.
    fn end(&mut self, stage: Stage, seconds: f64);
}

/// Not interested.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn begin(&mut self, _: Stage, _: usize) {}
    fn end(&mut self, _: Stage, _: f64) {}
}

/// Seconds spent in each stage, summed over repetitions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageTimes(Vec<(Stage, f64)>);

impl StageTimes {
    /// Stages and seconds in the order in which they first ran.
    pub fn iter(&self) -> impl Iterator<Item = (Stage, f64)> {
        self.0.iter().copied()
    }

    /// Seconds of all stages together.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.0.iter().map(|(_, seconds)| seconds).sum()
    }

    pub(crate) fn add(&mut self, stage: Stage, seconds: f64) {
        match self.0.iter_mut().find(|(s, _)| *s == stage) {
            Some((_, sum)) => *sum += seconds,
            None => self.0.push((stage, seconds)),
        }
    }
}

/// Runs stages, keeps their times and tells the listener.
pub(crate) struct Clock<'a> {
    progress: &'a mut dyn Progress,
    pub(crate) times: StageTimes,
}

impl<'a> Clock<'a> {
    pub(crate) fn new(progress: &'a mut dyn Progress) -> Self {
        Self { progress, times: StageTimes::default() }
    }

    pub(crate) fn run<T>(&mut self, stage: Stage, elements: usize, work: impl FnOnce() -> T) -> T {
        self.progress.begin(stage, elements);
        let start = Instant::now();
        let result = work();
        let seconds = start.elapsed().as_secs_f64();
        self.times.add(stage, seconds);
        self.progress.end(stage, seconds);
        result
    }
}
