//! A surface that leaves the region: where, and which region would hold it.

use glam::DVec3;
use implicit::{Aabb, BoundedField};

use super::block::Block;
use super::grid::Grid;
use super::nodes::{STRIDES, corner_box, members};
use super::survey::{Survey, survey};

/// Finest grid on which larger regions are tried.
const TRIAL_CELLS: usize = 48;
/// Number of larger regions tried; the growth doubles each time.
const TRIALS: i32 = 6;
/// First growth of a side that the surface crosses, in units of the longest side.
const FIRST_GROWTH: f64 = 0.25;
/// Space left around a surface that is closed, in cells of the trial.
const MARGIN_CELLS: f64 = 2.0;

/// Which sides of the grid are crossed: for each axis the lower and the upper one.
pub(super) type Sides = [[bool; 2]; 3];

/// The surface crosses the boundary of the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exit {
    /// The first place.
    pub(super) at: DVec3,
    pub(super) sides: Sides,
}

/// Whether both signs occur on one face of a block.
pub(super) fn face_is_crossed(block: &Block, axis: usize, upper: bool) -> bool {
    block.has_both_signs(face_nodes(block, axis, upper))
}

fn face_nodes(block: &Block, axis: usize, upper: bool) -> u128 {
    let mut counts = block.cells.map(|cells| cells + 1);
    counts[axis] = 1;
    let level = if upper { block.cells[axis] } else { 0 };
    corner_box(counts) << (STRIDES[axis] * level)
}

/// Where the surface crosses the boundary of the grid, if it does.
pub(super) fn find_exit(grid: &Grid, blocks: &[Block]) -> Option<Exit> {
    let counts = grid.blocks();
    let mut exit: Option<Exit> = None;
    for block in blocks {
        for (axis, upper) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
            let last = if upper { counts[axis] - 1 } else { 0 };
            if block.index[axis] != last || !face_is_crossed(block, axis, upper) {
                continue;
            }
            let at = crossed_place(grid, block, axis, upper);
            let exit = exit.get_or_insert(Exit { at, sides: [[false; 2]; 3] });
            exit.sides[axis][usize::from(upper)] = true;
        }
    }
    exit
}

/// The middle between an inside and an outside node that are neighbours on a crossed face.
fn crossed_place(grid: &Grid, block: &Block, axis: usize, upper: bool) -> DVec3 {
    let neighbours =
        |a: [u32; 3], b: [u32; 3]| (0..3).map(|k| a[k].abs_diff(b[k])).sum::<u32>() == 1;
    let nodes: Vec<[u32; 3]> = members(face_nodes(block, axis, upper)).collect();
    let place = |node| grid.block_node(block.index, node);
    nodes
        .iter()
        .filter(|&&node| block.is_inside(node))
        .find_map(|&a| {
            let b = nodes.iter().find(|&&b| neighbours(a, b) && !block.is_inside(b))?;
            Some(place(a).midpoint(place(*b)))
        })
        .unwrap_or_else(|| place(nodes[0]))
}

/// A larger region and whether the surface was seen to be closed in it.
///
/// The crossed sides are moved outwards until the surface on a coarse grid is closed; the result is
/// then the region and the box of that surface, with a margin. If that does not happen, the guess is
/// the region with the crossed sides moved once.
pub(super) fn suggest_region(
    field: &dyn BoundedField,
    region: &Aabb,
    cells: usize,
    sides: Sides,
) -> (Aabb, bool) {
    let guess = grown(region, FIRST_GROWTH, sides);
    let (mut trial, mut sides) = (*region, sides);
    for round in 0..TRIALS {
        trial = grown(&trial, FIRST_GROWTH * f64::from(round).exp2(), sides);
        let Some((grid, survey)) = look(field, &trial, cells.min(TRIAL_CELLS)) else {
            return (guess, false);
        };
        let vertices = survey.blocks.iter().flat_map(|block| block.vertices.iter().copied());
        match (find_exit(&grid, &survey.blocks), Aabb::around(vertices)) {
            (Some(exit), _) => sides = exit.sides,
            (None, Some(tight)) => {
                let margin = DVec3::splat(MARGIN_CELLS * grid.step);
                let tight = Aabb { min: tight.min - margin, max: tight.max + margin };
                let suggested = region.union(&tight);
                return if suggested == *region { (guess, false) } else { (suggested, true) };
            }
            // too coarse to see the surface
            (None, None) => return (guess, false),
        }
    }
    (guess, false)
}

fn look(field: &dyn BoundedField, region: &Aabb, cells: usize) -> Option<(Grid, Survey)> {
    let grid = Grid::new(region, cells).ok()?;
    let survey = survey(field, &grid).ok()?;
    Some((grid, survey))
}

/// The region with some sides moved outwards by a multiple of its longest side.
fn grown(region: &Aabb, factor: f64, sides: Sides) -> Aabb {
    let growth = factor * region.size().max_element();
    let by =
        |side: usize| DVec3::from_array(sides.map(|pair| if pair[side] { growth } else { 0.0 }));
    Aabb { min: region.min - by(0), max: region.max + by(1) }
}
