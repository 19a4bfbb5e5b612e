//! The files of a fitted surface.

use std::path::Path;

use smoothpatch::G1Surface;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{FaceId, FaceMap, Topology};
use smoothpatch::bezier_core::SepticTriangle;
use smoothpatch::io::{
    CellData, CellKind, CellValues, ChordTessellation, CurvedMesh, FacePoint, PatchSurface,
    VtuOptions, tessellate, tessellate_patches_within, tessellation_gap, write_vtu,
};
use smoothpatch::measure::FaceDeviation;

use super::FitArguments;
use crate::format_options::FormatOptions;
use crate::formats;
use crate::output_files::{Format, Holds, OutputFiles, TriangleFormat, Written, write_file};

type Nets = FaceMap<SepticTriangle>;

/// What is written and where.
pub(crate) struct Outputs<'a> {
    files: OutputFiles,
    formats: &'a FormatOptions,
    cells: CellKind,
    quiet: bool,
    divisions: usize,
}

impl<'a> Outputs<'a> {
    /// What the options ask for; only names are looked at.
    pub(crate) fn new(arguments: &'a FitArguments) -> anyhow::Result<Self> {
        let files =
            OutputFiles::new(Holds::Patches, &arguments.outputs, arguments.report.as_deref())?
                .with_before_join(arguments.before_join.as_deref())?;
        let (cells, divisions) = (arguments.cells.into(), arguments.divisions);
        let formats = &arguments.formats;
        Ok(Self { files, formats, cells, quiet: arguments.quiet, divisions })
    }

    /// Checks that every file can be written.
    pub(crate) fn check_places(&self) -> anyhow::Result<()> {
        self.files.check_places()
    }

    /// Checks that every file is written once and is no input.
    pub(crate) fn check_distinct(&self, inputs: Vec<&Path>) -> anyhow::Result<()> {
        self.files.check_distinct(inputs)
    }

    /// Writes the surface in all formats asked for.
    pub(crate) fn write(
        &self,
        surface: &G1Surface,
        faces: &FaceMap<FaceDeviation>,
    ) -> anyhow::Result<Vec<Written>> {
        let (topology, nets) = (surface.whole().topology(), &surface.patches.nets);
        let vtu = VtuOptions {
            cells: self.cells,
            cell_data: cell_data(faces, surface.mesh.diagonal()),
            ..VtuOptions::default()
        };
        let mut written = Vec::new();
        for (format, path) in &self.files.surfaces {
            written.push(match format {
                Format::Vtu => write_file(path, |out| Ok(write_vtu(out, topology, nets, &vtu)?))?,
                Format::Step => {
                    let patches = PatchSurface::from_triangles(topology, nets)?;
                    formats::step(path, &patches, self.formats, self.quiet)?
                }
                Format::Msh => self.msh(path, topology, nets)?,
                Format::Triangles(format) => self.triangles(path, *format, surface)?,
            });
        }
        Ok(written)
    }
}

impl Outputs<'_> {
    /// Writes the patches before they were joined, if they are asked for; `nets` makes them.
    pub(crate) fn write_before_join(
        &self,
        topology: &Topology,
        nets: impl FnOnce() -> Nets,
    ) -> anyhow::Result<Option<Written>> {
        let Some(path) = &self.files.before_join else { return Ok(None) };
        let (nets, vtu) = (nets(), VtuOptions { cells: self.cells, ..VtuOptions::default() });
        write_file(path, |out| Ok(write_vtu(out, topology, &nets, &vtu)?)).map(Some)
    }

    fn msh(&self, path: &Path, topology: &Topology, nets: &Nets) -> anyhow::Result<Written> {
        let order = self.formats.order.unwrap_or(SepticTriangle::<DVec3>::DEGREE);
        let mesh = CurvedMesh::from_patches(topology, nets, order);
        let gap = (order < SepticTriangle::<DVec3>::DEGREE).then(|| {
            mesh.gap(|face, at| match at {
                FacePoint::Triangle(at) => nets[FaceId::new(face)].eval(at),
                FacePoint::Quad(_) => unreachable!("invariant: all patches are triangles"),
            })
        });
        formats::msh(path, &mesh, gap, self.formats)
    }

    fn triangles(
        &self,
        path: &Path,
        format: TriangleFormat,
        surface: &G1Surface,
    ) -> anyhow::Result<Written> {
        let (topology, nets) = (surface.whole().topology(), &surface.patches.nets);
        if let Some(tolerance) = self.formats.chord_tolerance {
            let length = tolerance * surface.mesh.diagonal();
            let ChordTessellation { tessellation, gap, .. } =
                tessellate_patches_within(topology, nets, length)?;
            return formats::triangles(path, format, &tessellation, gap);
        }
        let flat = tessellate(topology, nets, self.divisions);
        let gap = tessellation_gap(nets, self.divisions, &flat);
        formats::triangles(path, format, &flat.into(), gap)
    }
}

fn cell_data(faces: &FaceMap<FaceDeviation>, diagonal: f64) -> Vec<CellData> {
    let floats = |value: &dyn Fn(&FaceDeviation) -> f64| {
        CellValues::Float64(faces.as_slice().iter().map(value).collect())
    };
    let folded = faces.as_slice().iter().map(|face| i64::from(face.folded)).collect();
    [
        ("deviation", floats(&|face| face.max / diagonal)),
        ("normal_error_deg", floats(&|face| face.max_normal.to_degrees())),
        ("folded", CellValues::Int64(folded)),
    ]
    .map(|(name, values)| CellData { name: name.to_owned(), values })
    .into()
}
