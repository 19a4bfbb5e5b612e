//! Where the cells are.

use glam::DVec3;
use implicit::Aabb;

use super::error::PolygonizeError;
use super::nodes::CELLS as BLOCK;

/// Most cells along one axis.
const MAX_CELLS: f64 = (1 << 20) as f64;

/// A cell is at least this large in units of the largest coordinate, so that a position on a grid
/// edge has 18 bits to spare beyond the smallest distance from a node.
const MIN_RELATIVE_STEP: f64 = 1.0 / (1_u64 << 34) as f64;

/// Share of the padding that lies on the lower side, per axis.
///
/// The padding is 1 to 2 cells. With the share s, the middle of the region lies between 2s - 1/2
/// and s of a cell away from a plane of half cells, so these values keep grid planes away from
/// planes of symmetry through the middle. They differ so that x = y = z is no diagonal of nodes.
const LOWER_SHARE: [f64; 3] = [0.381_966, 0.353_553, 0.427_051];

/// Cubic cells that cover the region: node (i, j, k) lies at `origin + step * (i, j, k)`.
///
/// The step is the longest side of the region divided by the number of cells asked for. Along an
/// axis where the region is e long there are ⌈e / step⌉ + 1 cells, whose surplus is divided between
/// both ends according to [`LOWER_SHARE`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    origin: DVec3,
    pub(super) step: f64,
    /// Number of cells along each axis.
    pub(super) cells: [u32; 3],
}

impl Grid {
    /// The grid with `cells` cells on the longest side of the region.
    pub(super) fn new(region: &Aabb, cells: usize) -> Result<Self, PolygonizeError> {
        let size = region.size();
        let longest = size.max_element();
        let valid = region.min.cmple(region.max).all() && size.is_finite() && longest > 0.0;
        if !valid {
            return Err(PolygonizeError::InvalidRegion { region: *region });
        }
        let reach = region.min.abs().max(region.max.abs()).max_element();
        let max = whole((longest / (reach * MIN_RELATIVE_STEP)).min(MAX_CELLS)) as usize;
        if cells == 0 || cells > max {
            return Err(PolygonizeError::InvalidCells { cells, max });
        }
        let step = longest / cells as f64;
        let counts = (size / step).ceil() + DVec3::ONE;
        let padding = counts * step - size;
        let origin = region.min - padding * DVec3::from_array(LOWER_SHARE);
        let cells = counts.to_array().map(whole);
        Ok(Self { origin, step, cells })
    }

    /// Position of a node.
    #[inline]
    pub(super) fn node(&self, index: [u32; 3]) -> DVec3 {
        self.origin + self.step * DVec3::from_array(index.map(f64::from))
    }

    /// Position of a node of a block.
    #[inline]
    pub(super) fn block_node(&self, block: [u32; 3], node: [u32; 3]) -> DVec3 {
        self.node(std::array::from_fn(|axis| BLOCK * block[axis] + node[axis]))
    }

    /// Number of blocks along each axis.
    pub(super) fn blocks(&self) -> [u32; 3] {
        self.cells.map(|cells| cells.div_ceil(BLOCK))
    }

    /// Number of cells of a block along each axis; the last blocks can be smaller.
    pub(super) fn block_cells(&self, block: [u32; 3]) -> [u32; 3] {
        std::array::from_fn(|axis| BLOCK.min(self.cells[axis] - BLOCK * block[axis]))
    }

    /// The box of 2^`level` blocks along each axis with this index, without the part outside the
    /// grid; `None` if nothing is left.
    ///
    /// Its corners are grid nodes, computed as [`node`](Self::node) does.
    pub(super) fn cluster(&self, level: u32, index: [u32; 3]) -> Option<Aabb> {
        let side = BLOCK << level;
        let lower = index.map(|i| i * side);
        if (0..3).any(|axis| lower[axis] >= self.cells[axis]) {
            return None;
        }
        let upper = std::array::from_fn(|axis| (lower[axis] + side).min(self.cells[axis]));
        Some(Aabb { min: self.node(lower), max: self.node(upper) })
    }
}

/// The integer part.
#[expect(clippy::cast_possible_truncation, reason = "numbers of cells are below 2^21")]
fn whole(number: f64) -> u32 {
    number as u32
}
