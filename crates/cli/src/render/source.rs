//! What is in a file, ready to be drawn.

use std::path::Path;

use anyhow::{anyhow, bail};
use smoothpatch::basemesh::FaceMap;
use smoothpatch::basemesh::glam::{DVec2, DVec3};
use smoothpatch::bezier_core::{BezierTriangle, SepticTriangle};
use smoothpatch::io::{
    CellData, CellValues, Grid, GridCell, VtuReadError, VtuSurface, read_grid_file, read_vtu_file,
};
use smoothpatch::pictures::{CurvedPatches, GridPatches, NetPatches};
use smoothpatch::render::{Domain, Hit, Patches, SurfacePoint};

/// A file with patches or cells.
pub(crate) struct Source {
    pub(crate) name: String,
    /// What is drawn, in words.
    pub(crate) contents: String,
    pub(crate) patches: Box<dyn CurvedPatches>,
    /// The largest deviation of each patch over the diagonal, if the file has it.
    pub(crate) deviation: Option<Vec<f64>>,
    pub(crate) has_curvature: bool,
    /// Diagonal of the bounding box of the corners.
    pub(crate) diagonal: f64,
}

impl Source {
    pub(crate) fn read(path: &Path) -> anyhow::Result<Self> {
        let name = path.display().to_string();
        match read_vtu_file::<36>(path) {
            Ok(surface) => Self::of_patches(name, surface),
            Err(error) => match error.problem {
                // VTK's numbers of flat and quadratic cells
                VtuReadError::CellType { found: 5 | 9 | 22 | 23, .. } => {
                    Self::of_cells(name, &read_grid_file(path)?)
                }
                VtuReadError::PointsPerCell { points, .. } => bail!(
                    "{name}: the cells have {points} points; `render` draws patches of degree 7, which \
                     have 36, and flat and quadratic cells"
                ),
                _ => Err(error.into()),
            },
        }
    }

    fn of_patches(name: String, surface: VtuSurface<36>) -> anyhow::Result<Self> {
        let VtuSurface { nets, cell_data, .. } = surface;
        let contents = format!("{} patches of degree 7, with their own normals", nets.len());
        Self::new(name, contents, Box::new(OwnedNets(nets)), &cell_data, true)
    }

    fn of_cells(name: String, grid: &Grid) -> anyhow::Result<Self> {
        let is_flat = |cell: &GridCell| matches!(cell, GridCell::Triangle(_) | GridCell::Quad(_));
        let flat = grid.cells.iter().filter(|cell| is_flat(cell)).count();
        let curved = grid.cells.len() - flat;
        let normals = if grid.normals.is_empty() {
            "with their own normals: the file has none"
        } else {
            "with the normals of the file"
        };
        let flat = (flat > 0).then(|| format!("{flat} flat cells {normals}"));
        let curved =
            (curved > 0).then(|| format!("{curved} quadratic cells with their own normals"));
        let contents = [flat, curved].into_iter().flatten().collect::<Vec<_>>().join(", ");
        let patches = GridPatches::new(grid);
        let has_curvature = patches.has_curvature();
        Self::new(name, contents, Box::new(patches), &grid.cell_data, has_curvature)
    }

    fn new(
        name: String,
        contents: String,
        patches: Box<dyn CurvedPatches>,
        cell_data: &[CellData],
        has_curvature: bool,
    ) -> anyhow::Result<Self> {
        let corners = (0..patches.count()).flat_map(|patch| {
            let places = patches.domain(patch).corners().iter();
            let patches = &*patches;
            places.map(move |&at| patches.point(patch, at))
        });
        let corners: Vec<DVec3> = corners.collect();
        let low = corners.iter().copied().reduce(DVec3::min);
        let high = corners.iter().copied().reduce(DVec3::max);
        let ends = low.zip(high).ok_or_else(|| anyhow!("{name}: there is nothing to draw"))?;
        let diagonal = ends.0.distance(ends.1);
        let deviation = cell_data.iter().find(|data| data.name == "deviation");
        let deviation = deviation.and_then(|data| match &data.values {
            CellValues::Float64(values) => Some(values.clone()),
            CellValues::Int64(_) => None,
        });
        Ok(Self { name, contents, patches, deviation, has_curvature, diagonal })
    }
}

/// Nets that outlive the reading of the file.
struct OwnedNets(FaceMap<SepticTriangle>);

impl OwnedNets {
    fn nets(&self) -> NetPatches<'_, 36> {
        NetPatches::<36>(&self.0)
    }
}

impl Patches for OwnedNets {
    fn count(&self) -> usize {
        self.nets().count()
    }

    fn domain(&self, patch: usize) -> Domain {
        self.nets().domain(patch)
    }

    fn point(&self, patch: usize, at: DVec2) -> DVec3 {
        self.nets().point(patch, at)
    }

    fn surface_point(&self, patch: usize, at: DVec2) -> SurfacePoint {
        self.nets().surface_point(patch, at)
    }
}

impl CurvedPatches for OwnedNets {
    fn mean_curvature(&self, hit: &Hit) -> Option<f64> {
        self.nets().mean_curvature(hit)
    }
}

/// The number of control points that `fit` writes.
const _: () = assert!(BezierTriangle::<DVec3, 36>::DEGREE == 7, "septic patches have 36 points");
