//! Blocks that were discarded although the surface enters them.
//!
//! A correct enclosure never discards such a block. If a field overstates its enclosures, its
//! surface is followed from block to block, so that the mesh is closed all the same.

use std::collections::BTreeMap;

use implicit::BoundedField;

use super::batch;
use super::block::{Block, sample};
use super::boundary::face_is_crossed;
use super::error::PolygonizeError;
use super::grid::Grid;
use super::morton;
use super::survey::Survey;

/// Adds every block that shares a crossed face with a block of the survey.
pub(super) fn follow_crossed_faces(
    field: &dyn BoundedField,
    grid: &Grid,
    survey: &mut Survey,
) -> Result<(), PolygonizeError> {
    let mut missing = missing_neighbours(grid, &survey.blocks, &survey.blocks);
    // each round adds at least one block of a finite grid
    while !missing.is_empty() {
        let mut added = Vec::with_capacity(missing.len());
        for sampled in batch::map(&missing, |&index| sample(field, grid, index)) {
            let sampled = sampled?;
            survey.values = survey.values.hull(sampled.values);
            added.extend(sampled.block);
        }
        survey.blocks.extend(added.iter().cloned());
        survey.blocks.sort_unstable_by_key(|block| block.code);
        if added.len() < missing.len() {
            // the shared nodes had both signs before and do not have them now
            return Err(PolygonizeError::Inconsistent { at: grid.block_node(missing[0], [0; 3]) });
        }
        missing = missing_neighbours(grid, &survey.blocks, &added);
    }
    Ok(())
}

/// The neighbours across crossed faces of the blocks `frontier` that are not among `blocks`.
fn missing_neighbours(grid: &Grid, blocks: &[Block], frontier: &[Block]) -> Vec<[u32; 3]> {
    let counts = grid.blocks();
    let mut missing = BTreeMap::new();
    for block in frontier {
        for (axis, upper) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
            let mut index = block.index;
            let at_boundary =
                if upper { index[axis] + 1 == counts[axis] } else { index[axis] == 0 };
            if at_boundary || !face_is_crossed(block, axis, upper) {
                continue;
            }
            index[axis] = if upper { index[axis] + 1 } else { index[axis] - 1 };
            let code = morton::code(index);
            if find(blocks, code).is_none() {
                missing.insert(code, index);
            }
        }
    }
    missing.into_values().collect()
}

/// Position of the block with this code.
pub(super) fn find(blocks: &[Block], code: u64) -> Option<usize> {
    blocks.binary_search_by_key(&code, |block| block.code).ok()
}
