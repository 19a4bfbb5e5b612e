//! What a file is found to contain.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde::Serialize;
use smoothpatch::FieldSource;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{FaceId, TopologyError, TriMesh};
use smoothpatch::bezier_core::{Barycentric, Corner, SepticTriangle};
use smoothpatch::implicit::{Aabb, ImplicitSurface, ProjectionSettings};
use smoothpatch::io::{VtuReadError, VtuSurface, read_vtu_file};
use smoothpatch::measure::{Continuity, Deviation, continuity_beside, deviation, folded_patches};
use smoothpatch::mesh_surface::{MeshDistances, mesh_distances};

use super::bounds::{Bounds, Verdict};
use crate::table::{Table, degrees, grid, length, of_diagonal, yes_no};

/// A septic triangle has 36 control points.
type Patches = VtuSurface<36>;

/// What a file turned out to be.
pub(crate) enum Reading {
    Patches(Patches),
    /// Patches that cannot be measured, and why.
    NoManifold(String),
}

/// Reads a file. Patches that meet in the wrong way are a finding, everything else that is wrong
/// is an error.
pub(crate) fn read(file: &Path) -> anyhow::Result<Reading> {
    match read_vtu_file(file) {
        Ok(patches) => Ok(Reading::Patches(patches)),
        Err(error) => match error.problem {
            VtuReadError::SharedPoint(_)
            | VtuReadError::Topology(
                TopologyError::NonManifoldEdge { .. }
                | TopologyError::NonManifoldVertex { .. }
                | TopologyError::InconsistentOrientation { .. },
            ) => Ok(Reading::NoManifold(error.problem.to_string())),
            _ => Err(error.into()),
        },
    }
}

/// What was measured.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Measured {
    #[serde(flatten)]
    pub(crate) continuity: Continuity,
    pub(crate) vertices: usize,
    /// Edges with one patch only.
    pub(crate) open_edges: usize,
    /// Patches whose normal turns by more than 90° from their own mean normal or from the surface.
    pub(crate) folded: BTreeSet<usize>,
    /// Distance and angle to the surface, if one was named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) deviation: Option<Deviation>,
    /// Distances from a mesh and to it, if one was named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) mesh: Option<MeshDistances>,
}

/// What patches are compared with.
#[derive(Clone, Copy, Default)]
pub(crate) struct Reference<'a> {
    pub(crate) field: Option<&'a dyn ImplicitSurface>,
    pub(crate) mesh: Option<&'a TriMesh>,
    /// Edges whose patches meet at more than this are creases. Unit: radians.
    pub(crate) crease_angle: Option<f64>,
}

/// Measures patches, against a surface or a mesh if there is one.
pub(crate) fn measure(patches: &Patches, reference: Reference<'_>) -> Measured {
    let Reference { field, mesh, crease_angle } = reference;
    let VtuSurface { topology, nets, .. } = patches;
    let vertices = nets.as_slice().iter().flat_map(corners);
    let diagonal = Aabb::around(vertices).map_or(0.0, |extent| extent.diagonal());
    let deviation = field.map(|field| {
        let source = FieldSource::new(field, diagonal, ProjectionSettings::default());
        deviation(nets, &source, diagonal).0
    });
    let mut folded: BTreeSet<usize> = folded_patches(nets).into_iter().map(FaceId::index).collect();
    folded.extend(deviation.iter().flat_map(|deviation| &deviation.folded));
    Measured {
        continuity: continuity_beside(topology, nets, &|_, angle| {
            crease_angle.is_some_and(|limit| angle > limit)
        }),
        vertices: topology.vertex_count(),
        open_edges: topology.edges().filter(|&edge| topology.is_boundary_edge(edge)).count(),
        folded,
        deviation,
        mesh: mesh.map(|mesh| mesh_distances(mesh, nets)),
    }
}

fn corners(net: &SepticTriangle) -> [DVec3; 3] {
    Corner::ALL.map(|corner| net.eval(Barycentric::at(corner)))
}

/// What was measured, and the bounds with it.
#[derive(Serialize)]
pub(crate) struct Findings {
    file: PathBuf,
    manifold: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    problem: Option<String>,
    #[serde(flatten)]
    measured: Option<Measured>,
    bounds: Vec<Verdict>,
    passed: bool,
}

impl Findings {
    pub(crate) fn new(file: &Path, measured: Result<Measured, String>, bounds: &Bounds) -> Self {
        let (measured, problem) = match measured {
            Ok(measured) => (Some(measured), None),
            Err(problem) => (None, Some(problem)),
        };
        let bounds = measured.as_ref().map_or(Vec::new(), |measured| bounds.verdicts(measured));
        let passed = measured.is_some() && bounds.iter().all(|verdict| verdict.holds);
        let manifold = measured.is_some();
        Self { file: file.to_owned(), manifold, problem, measured, bounds, passed }
    }

    pub(crate) fn passed(&self) -> bool {
        self.passed
    }

    /// One line for everything that is not good enough.
    pub(crate) fn complaints(&self) -> Vec<String> {
        let problem = self.problem.iter().map(|problem| format!("not a manifold: {problem}"));
        let exceeded = self.bounds.iter().filter(|verdict| !verdict.holds).map(Verdict::to_string);
        problem.chain(exceeded).map(|text| format!("{}: {text}", self.file.display())).collect()
    }

    pub(crate) fn table(&self) -> String {
        let mut table = Table::default();
        table.row("manifold", yes_no(self.manifold));
        if let Some(measured) = &self.measured {
            fill(&mut table, measured);
        }
        if !self.bounds.is_empty() {
            table.gap();
        }
        for verdict in &self.bounds {
            table.row(if verdict.holds { "ok" } else { "NOT OK" }, verdict);
        }
        format!("{}\n{table}", self.file.display())
    }
}

fn fill(table: &mut Table, measured: &Measured) {
    let joined = &measured.continuity;
    table.row("faces", joined.faces);
    table.row("vertices", measured.vertices);
    table.row("closed", yes_no(joined.closed));
    if measured.open_edges > 0 {
        table.row("open edges", measured.open_edges);
    }
    table.row("components", joined.components);
    table.row("Euler characteristic", joined.euler_characteristic);
    table.row("G0 gap", length(joined.position_gap));
    table.row("G1 angle", degrees(joined.g1_angle_deg));
    if joined.sharp_edges > 0 {
        let angle = degrees(joined.sharp_angle_deg);
        table.row("C0 edges", format!("{}, up to {angle}", joined.sharp_edges));
    }
    table.row("folded patches", measured.folded.len());
    if let Some(mesh) = &measured.mesh {
        table.row("mesh vertices", of_diagonal(mesh.vertices.max));
        table.row("mesh triangles", of_diagonal(mesh.triangle_samples.max));
        table.row("patches from mesh", of_diagonal(mesh.patch_samples.max));
    }
    if let Some(deviation) = &measured.deviation {
        table.row("max deviation", of_diagonal(deviation.max));
        table.row("RMS deviation", of_diagonal(deviation.rms));
        table.row("max normal error", degrees(deviation.max_normal_deg));
        table.row("finest grid", grid(deviation.grid));
        if deviation.failed_samples > 0 {
            table.row("samples without foot", deviation.failed_samples);
        }
    }
}
