//! A block of 4 x 4 x 4 cells: signs, crossed grid edges and the points where they are crossed.

use glam::DVec3;
use implicit::{BoundedField, Interval};

use super::crossing;
use super::error::PolygonizeError;
use super::grid::Grid;
use super::morton;
use super::nodes::{NODE_COUNT, STRIDES, bit, corner_box, members};

/// A block that the surface passes through.
///
/// Of the edges of the grid it owns those that start at one of its nodes 0 to 3 along each axis, so
/// that every edge inside the grid has one owner. A crossed edge owned by one block is also used by
/// up to three others, all of which have both signs.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) index: [u32; 3],
    /// Position in the order of the blocks.
    pub(super) code: u64,
    /// Number of cells along each axis.
    pub(super) cells: [u32; 3],
    /// The nodes inside the surface.
    inside: u128,
    /// For each axis the nodes where a crossed edge along that axis starts; owned edges only.
    crossed: [u128; 3],
    /// The crossings in the order of axes and bits of `crossed`.
    pub(super) vertices: Vec<DVec3>,
}

/// The values of a block and, if both signs are there, its part of the surface.
#[derive(Debug)]
pub(super) struct Sampled {
    pub(super) values: Interval,
    pub(super) block: Option<Block>,
}

/// Evaluates the field at the nodes of a block and finds the crossings.
pub(super) fn sample(
    field: &dyn BoundedField,
    grid: &Grid,
    index: [u32; 3],
) -> Result<Sampled, PolygonizeError> {
    let cells = grid.block_cells(index);
    let mut points = [DVec3::ZERO; NODE_COUNT];
    let mut samples = [0.0; NODE_COUNT];
    let nodes = corner_box(cells.map(|count| count + 1));
    let count = nodes.count_ones() as usize;
    for (point, node) in points.iter_mut().zip(members(nodes)) {
        *point = grid.block_node(index, node);
    }
    field.values(&points[..count], &mut samples[..count]);
    if let Some(i) = samples[..count].iter().position(|value| !value.is_finite()) {
        return Err(PolygonizeError::NotFinite { at: points[i], value: samples[i] });
    }
    let values = samples[..count]
        .iter()
        .fold(EMPTY, |range, &v| Interval { lo: range.lo.min(v), hi: range.hi.max(v) });
    if values.lo >= 0.0 || values.hi < 0.0 {
        return Ok(Sampled { values, block: None });
    }
    let block = Block::new(field, grid, index, &scattered(nodes, &samples));
    Ok(Sampled { values, block: Some(block) })
}

/// The hull of no values.
pub(super) const EMPTY: Interval = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY };

/// The samples of a set of nodes, each at the position of the bit of its node; 0 elsewhere.
fn scattered(nodes: u128, samples: &[f64; NODE_COUNT]) -> [f64; NODE_COUNT] {
    let mut values = [0.0; NODE_COUNT];
    for (node, &sample) in members(nodes).zip(samples) {
        values[bit(node) as usize] = sample;
    }
    values
}

impl Block {
    /// The block with these values at its nodes; one more field value per crossed edge is needed.
    fn new(
        field: &dyn BoundedField,
        grid: &Grid,
        index: [u32; 3],
        values: &[f64; NODE_COUNT],
    ) -> Self {
        // zero, and so the nodes outside the grid, count as outside
        let inside =
            (0..).zip(values).fold(0, |set, (bit, &value)| set | u128::from(value < 0.0) << bit);
        let cells = grid.block_cells(index);
        let owned = corner_box(cells);
        let crossed = STRIDES.map(|stride| (inside ^ inside >> stride) & owned);
        let code = morton::code(index);
        let mut block = Self { index, code, cells, inside, crossed, vertices: Vec::new() };
        block.vertices = block.crossings(field, grid, values);
        block
    }

    fn crossings(
        &self,
        field: &dyn BoundedField,
        grid: &Grid,
        values: &[f64; NODE_COUNT],
    ) -> Vec<DVec3> {
        let edges = || (0..3).flat_map(|a| members(self.crossed[a]).map(move |start| (a, start)));
        let ends = |axis: usize, start| {
            let start = bit(start);
            [values[start as usize], values[(start + STRIDES[axis]) as usize]]
        };
        let place = |axis: usize, start, t: f64| {
            let mut point = grid.block_node(self.index, start);
            point[axis] += grid.step * t;
            point
        };
        let linear = |axis, start| {
            let [lower, upper] = ends(axis, start);
            crossing::linear(lower, upper)
        };
        let mut points: Vec<DVec3> =
            edges().map(|(axis, start)| place(axis, start, linear(axis, start))).collect();
        let mut middle = vec![0.0; points.len()];
        field.values(&points, &mut middle);
        for ((point, middle), (axis, start)) in points.iter_mut().zip(middle).zip(edges()) {
            let [lower, upper] = ends(axis, start);
            let t = crossing::refined(linear(axis, start), lower, upper, middle);
            *point = place(axis, start, t);
        }
        points
    }

    /// Whether a node of this block is inside.
    #[inline]
    pub(super) fn is_inside(&self, node: [u32; 3]) -> bool {
        self.inside >> bit(node) & 1 == 1
    }

    /// Whether both signs occur among these nodes of the block.
    pub(super) fn has_both_signs(&self, nodes: u128) -> bool {
        let inside = self.inside & nodes;
        inside != 0 && inside != nodes
    }

    /// The cells with both signs, each by its first node, with the inside corners as bits.
    pub(super) fn mixed_cells(&self) -> impl Iterator<Item = ([u32; 3], u8)> {
        let (mut all, mut any) = (self.inside, self.inside);
        for stride in STRIDES {
            all &= all >> stride;
            any |= any >> stride;
        }
        let inside = self.inside;
        members(any & !all & corner_box(self.cells)).map(move |cell| {
            let near = inside >> bit(cell);
            let pair = |shift: u32| (near >> shift & 0b11) as u8;
            let [_, y, z] = STRIDES;
            (cell, pair(0) | pair(y) << 2 | pair(z) << 4 | pair(y + z) << 6)
        })
    }

    /// Position of a crossing among the vertices of this block; `None` if the edge is not crossed.
    #[inline]
    pub(super) fn rank(&self, axis: usize, start: [u32; 3]) -> Option<usize> {
        let before = self.crossed[..axis].iter().map(|set| set.count_ones()).sum::<u32>();
        let this = 1 << bit(start);
        let rank = before + (self.crossed[axis] & (this - 1)).count_ones();
        (self.crossed[axis] & this != 0).then_some(rank as usize)
    }
}
