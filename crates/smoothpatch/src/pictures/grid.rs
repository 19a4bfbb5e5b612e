//! Cells of a file as patches to draw.

use std::collections::BTreeMap;

use basemesh::glam::{DVec2, DVec3};
use io::{CellValues, Grid, GridCell};
use render::{Domain, Hit, Patches, SurfacePoint};

use super::CurvedPatches;
use super::polynomial::{Polynomial, domain};

/// Names of cell data that say to which patch a cell belongs.
const PATCH_IDS: [&str; 4] = ["patch_kind", "face", "triangle", "edge"];
/// Name of the point data that give flat cells a curvature.
const MEAN_CURVATURE: &str = "mean_curvature";

/// The cells of a file.
///
/// Flat cells are drawn with the normals at their points, which stand for those of the surface that was
/// sampled; where a point has none, with their own. Quadratic cells are drawn with their own. A side is
/// an edge of a patch where the cell data `patch_kind`, `face`, `triangle` or `edge` differ, and at open
/// borders.
#[derive(Clone, Debug)]
pub struct GridPatches {
    cells: Vec<Cell>,
    /// Of each side of each cell.
    edges: Vec<[bool; 4]>,
    has_curvature: bool,
}

#[derive(Clone, Debug)]
struct Cell {
    domain: Domain,
    position: Polynomial,
    /// Missing for cells with their own normals.
    normal: Option<Polynomial>,
    curvature: Curvature,
}

#[derive(Clone, Debug)]
enum Curvature {
    /// That of the polynomial.
    Own,
    /// Interpolated numbers, in the first coordinate.
    Given(Polynomial),
    Unknown,
}

impl GridPatches {
    /// The cells of a grid.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        let given = grid.point_data.iter().find(|data| data.name == MEAN_CURVATURE);
        let given = given.map(|data| reals(&data.values));
        let cells: Vec<Cell> =
            grid.cells.iter().map(|cell| patch(grid, cell, given.as_deref())).collect();
        let has_curvature = cells.iter().all(|cell| !matches!(cell.curvature, Curvature::Unknown));
        Self { cells, edges: edges(grid), has_curvature }
    }

    /// Whether all cells have a curvature: quadratic ones do, flat ones if the file has the point data
    /// `mean_curvature`.
    #[must_use]
    pub fn has_curvature(&self) -> bool {
        self.has_curvature
    }
}

fn patch(grid: &Grid, cell: &GridCell, given: Option<&[f64]>) -> Cell {
    let points = cell.points();
    let positions: Vec<DVec3> = points.iter().map(|&point| grid.points[point]).collect();
    let position = Polynomial::of_cell(cell, &positions);
    let is_flat = matches!(cell, GridCell::Triangle(_) | GridCell::Quad(_));
    let normal = (is_flat && !grid.normals.is_empty()).then(|| {
        let corners = domain(cell).corners();
        let own = |corner: usize| {
            let jet = position.jet(corners[corner]);
            jet.area_normal().normalize_or_zero()
        };
        let normals = points.iter().enumerate().map(|(corner, &point)| match grid.normals[point] {
            DVec3::ZERO => own(corner),
            normal => normal,
        });
        Polynomial::of_cell(cell, &normals.collect::<Vec<_>>())
    });
    let curvature = match given {
        _ if !is_flat => Curvature::Own,
        Some(values) => {
            let values: Vec<DVec3> = points.iter().map(|&point| DVec3::X * values[point]).collect();
            Curvature::Given(Polynomial::of_cell(cell, &values))
        }
        None => Curvature::Unknown,
    };
    Cell { domain: domain(cell), position, normal, curvature }
}

fn reals(values: &CellValues) -> Vec<f64> {
    match values {
        CellValues::Float64(values) => values.clone(),
        CellValues::Int64(values) => values.iter().map(|&value| value as f64).collect(),
    }
}

/// Which sides of each cell are edges of patches.
fn edges(grid: &Grid) -> Vec<[bool; 4]> {
    let ids: Vec<&[i64]> = grid
        .cell_data
        .iter()
        .filter(|data| PATCH_IDS.contains(&data.name.as_str()))
        .filter_map(|data| match &data.values {
            CellValues::Int64(values) => Some(values.as_slice()),
            CellValues::Float64(_) => None,
        })
        .collect();
    // without ids each cell is a patch
    let same = |a: usize, b: usize| !ids.is_empty() && ids.iter().all(|ids| ids[a] == ids[b]);
    let mut cells_at: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for (at, cell) in grid.cells.iter().enumerate() {
        for side in sides(cell) {
            cells_at.entry(side).or_default().push(at);
        }
    }
    let is_edge = |side: [usize; 2]| {
        let cells = &cells_at[&side];
        cells.len() != 2 || !same(cells[0], cells[1])
    };
    let of_cell = |cell: &GridCell| {
        let mut edges = [false; 4];
        edges.iter_mut().zip(sides(cell)).for_each(|(slot, side)| *slot = is_edge(side));
        edges
    };
    grid.cells.iter().map(of_cell).collect()
}

/// Sorted pairs of points.
fn sides(cell: &GridCell) -> impl Iterator<Item = [usize; 2]> {
    let corners = &cell.points()[..domain(cell).corners().len()];
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)])
}

impl Patches for GridPatches {
    fn count(&self) -> usize {
        self.cells.len()
    }

    fn domain(&self, patch: usize) -> Domain {
        self.cells[patch].domain
    }

    fn point(&self, patch: usize, at: DVec2) -> DVec3 {
        self.cells[patch].position.at(at)
    }

    fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint {
        let cell = &self.cells[patch];
        let jet = cell.position.jet(at);
        let normal = cell.normal.map_or(jet.area_normal(), |normal| normal.at(at));
        SurfacePoint { point: jet.point, normal, du: jet.du, dv: jet.dv }
    }

    fn has_edge(&self, patch: usize, side: usize) -> bool {
        self.edges[patch][side]
    }
}

impl CurvedPatches for GridPatches {
    fn mean_curvature(&self, hit: &Hit) -> Option<f64> {
        let cell = &self.cells[hit.patch];
        match cell.curvature {
            Curvature::Own => {
                let [least, largest] =
                    cell.position.jet(hit.at).surface_jet()?.principal_curvatures();
                Some(0.5 * (least + largest))
            }
            Curvature::Given(values) => Some(values.at(hit.at).x),
            Curvature::Unknown => None,
        }
    }
}
