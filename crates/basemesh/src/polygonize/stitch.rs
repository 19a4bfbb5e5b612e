//! From blocks to a mesh: numbers the crossings and fills the cells.

use super::block::Block;
use super::cases::CASES;
use super::contour::{edge_axis, lower_end};
use super::error::PolygonizeError;
use super::follow::find;
use super::grid::Grid;
use super::morton;
use super::nodes::CELLS;
use crate::mesh::TriMesh;

/// The mesh of a surface that is closed inside the grid.
///
/// Vertices and triangles are numbered block by block.
pub(super) fn stitch(grid: &Grid, mut blocks: Vec<Block>) -> Result<TriMesh, PolygonizeError> {
    let total = blocks.iter().map(|block| block.vertices.len()).sum();
    let mut positions = Vec::with_capacity(total);
    let mut first = Vec::with_capacity(blocks.len());
    for block in &mut blocks {
        first.push(positions.len());
        positions.append(&mut std::mem::take(&mut block.vertices));
    }
    let mut stitcher =
        Stitcher { grid, blocks: &blocks, first: &first, faces: Vec::with_capacity(2 * total) };
    for block in 0..blocks.len() {
        stitcher.fill_block(block)?;
    }
    let faces = stitcher.faces;
    drop(blocks);
    Ok(TriMesh::new(positions, &faces)?)
}

struct Stitcher<'a> {
    grid: &'a Grid,
    blocks: &'a [Block],
    /// The number of the first vertex of each block.
    first: &'a [usize],
    faces: Vec<[usize; 3]>,
}

impl Stitcher<'_> {
    fn fill_block(&mut self, number: usize) -> Result<(), PolygonizeError> {
        let block = &self.blocks[number];
        let owners = self.owners(number);
        for (cell, configuration) in block.mixed_cells() {
            self.fill_cell(block, &owners, cell, configuration)?;
        }
        Ok(())
    }

    /// The block itself and its neighbours towards larger indices, which own the edges on the upper
    /// faces; bit a of the index tells that the neighbour is one further along axis a.
    fn owners(&self, number: usize) -> [Option<usize>; 8] {
        let index = self.blocks[number].index;
        [0, 1, 2, 3, 4, 5, 6, 7].map(|shift: u32| match shift {
            0 => Some(number),
            // no edge of a block starts at its last node
            7 => None,
            _ => find(
                self.blocks,
                morton::code(std::array::from_fn(|axis| index[axis] + (shift >> axis & 1))),
            ),
        })
    }

    fn fill_cell(
        &mut self,
        block: &Block,
        owners: &[Option<usize>; 8],
        cell: [u32; 3],
        configuration: u8,
    ) -> Result<(), PolygonizeError> {
        let case = &CASES[usize::from(configuration)];
        let mut points = [0; 12];
        for &edge in &case.edges {
            let start =
                std::array::from_fn(|axis| cell[axis] + u32::from(lower_end(edge) >> axis & 1));
            points[usize::from(edge)] =
                self.vertex(owners, edge_axis(edge), start).ok_or_else(|| {
                    PolygonizeError::Inconsistent { at: self.grid.block_node(block.index, start) }
                })?;
        }
        self.faces.extend(case.triangles.iter().map(|t| t.map(|point| points[usize::from(point)])));
        Ok(())
    }

    /// The vertex on the edge along `axis` from node `start`, which may lie on an upper face.
    #[inline]
    fn vertex(&self, owners: &[Option<usize>; 8], axis: usize, start: [u32; 3]) -> Option<usize> {
        let shift = (0..3).map(|a| usize::from(start[a] == CELLS) << a).sum::<usize>();
        let owner = owners[shift]?;
        let rank = self.blocks[owner].rank(axis, start.map(|i| i % CELLS))?;
        Some(self.first[owner] + rank)
    }
}
