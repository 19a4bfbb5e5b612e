//! Finds the blocks that the surface passes through.

use implicit::{BoundedField, Interval};

use super::batch;
use super::block::{Block, EMPTY, sample};
use super::error::PolygonizeError;
use super::grid::Grid;

/// Blocks sampled together: enough work for many threads, little memory (about 1 MB of samples).
const BATCH: usize = 1024;

/// Largest number of vertices: a closed mesh has about two triangles per vertex.
const MAX_VERTICES: usize = MAX_FACES / 2;
/// Largest number of triangles whose half-edges have 32-bit ids.
const MAX_FACES: usize = u32::MAX as usize / 3;

/// What is known about the field on the grid.
#[derive(Debug)]
pub(super) struct Survey {
    /// The blocks with both signs, in the order of their codes.
    pub(super) blocks: Vec<Block>,
    /// Hull of all samples and of the enclosures of discarded boxes.
    pub(super) values: Interval,
}

/// Halves the grid down to blocks, discards boxes without surface and samples the blocks left.
pub(super) fn survey(field: &dyn BoundedField, grid: &Grid) -> Result<Survey, PolygonizeError> {
    let mut walk = Walk {
        field,
        grid,
        pending: Vec::with_capacity(BATCH),
        survey: Survey { blocks: Vec::new(), values: EMPTY },
        vertices: 0,
    };
    let most = grid.blocks().into_iter().max().unwrap_or(1);
    walk.visit(most.next_power_of_two().ilog2(), [0; 3])?;
    walk.sample_pending()?;
    Ok(walk.survey)
}

struct Walk<'a> {
    field: &'a dyn BoundedField,
    grid: &'a Grid,
    /// Blocks to be sampled.
    pending: Vec<[u32; 3]>,
    survey: Survey,
    /// Number of vertices in the blocks of the survey.
    vertices: usize,
}

impl Walk<'_> {
    /// Looks into a cluster of 2^`level` blocks along each axis, children in the order of codes.
    fn visit(&mut self, level: u32, index: [u32; 3]) -> Result<(), PolygonizeError> {
        let Some(region) = self.grid.cluster(level, index) else {
            return Ok(());
        };
        let enclosure = self.field.enclosure(&region);
        // zero counts as outside
        if enclosure.lo >= 0.0 || enclosure.hi < 0.0 {
            self.survey.values = self.survey.values.hull(enclosure);
            return Ok(());
        }
        if level > 0 {
            return (0..8).try_for_each(|child: u32| {
                let part = |axis: usize| 2 * index[axis] + (child >> axis & 1);
                self.visit(level - 1, std::array::from_fn(part))
            });
        }
        self.pending.push(index);
        if self.pending.len() == BATCH { self.sample_pending() } else { Ok(()) }
    }

    fn sample_pending(&mut self) -> Result<(), PolygonizeError> {
        for sampled in batch::map(&self.pending, |&index| sample(self.field, self.grid, index)) {
            let sampled = sampled?;
            self.survey.values = self.survey.values.hull(sampled.values);
            self.vertices += sampled.block.as_ref().map_or(0, |block| block.vertices.len());
            self.survey.blocks.extend(sampled.block);
        }
        self.pending.clear();
        if self.vertices > MAX_VERTICES {
            let faces = 2 * self.vertices;
            return Err(PolygonizeError::TooLarge { faces, max: MAX_FACES });
        }
        Ok(())
    }
}
