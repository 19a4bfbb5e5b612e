//! What is to be fitted and how, if it is a mesh.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use clap::Args;
use serde::Serialize;
use smoothpatch::basemesh::{EdgeId, TriMesh, VertexId};
use smoothpatch::io::{MeshFile, MeshFormat, Repairs, read_mesh_file};
use smoothpatch::mesh_surface::{
    JetSummary, MeshBase, MeshDistances, SharpMesh, fit_mesh_field, jet_summary, mesh_distances,
};
use smoothpatch::meshfield::{JetError, JetSettings, MeshField, fit_jets, sharp_edges};
use smoothpatch::{G1Surface, Progress, Rim, Settings};

use super::FitArguments;
use super::scene_task::tolerance;
use crate::output_files::extension;
use crate::table::{Table, of_diagonal};
use crate::values;

/// What only meshes have.
#[derive(Args)]
#[group(skip)]
#[command(next_help_heading = "Meshes")]
pub(crate) struct MeshOptions {
    /// The triangles of the mesh become the patches, all its vertices stay where they are
    #[arg(long, conflicts_with_all = ["faces", "tolerance", "normal_tolerance", "base_mesh"])]
    keep_vertices: bool,

    /// Edges whose faces meet at more than this angle are creases: the patches meet there without gaps,
    /// but with a kink. Needs --keep-vertices, as open meshes do [default: 80]
    #[arg(long, value_name = "DEG", value_parser = values::crease_angle)]
    #[arg(allow_hyphen_values = true)]
    crease_angle: Option<f64>,

    /// Degree of the polynomials that are fitted around each vertex, 2 to 4; lower for noisy meshes
    /// [default: 4]
    #[arg(long, value_name = "D", value_parser = clap::value_parser!(u8).range(2..=4))]
    jet_degree: Option<u8>,
}

/// Angle between faces above which an edge is sharp, in degrees.
const CREASE_ANGLE: f64 = 80.0;

impl MeshOptions {
    /// The name of an option that was given.
    pub(super) fn first_given(&self) -> Option<&'static str> {
        [
            (self.keep_vertices, "--keep-vertices"),
            (self.crease_angle.is_some(), "--crease-angle"),
            (self.jet_degree.is_some(), "--jet-degree"),
        ]
        .into_iter()
        .find_map(|(given, name)| given.then_some(name))
    }

    fn jets(&self) -> JetSettings {
        let settings = JetSettings::default();
        JetSettings { degree: self.jet_degree.map_or(settings.degree, usize::from), ..settings }
    }
}

/// Whether a file is a mesh by its name.
pub(super) fn is_mesh(file: &Path) -> bool {
    MeshFormat::from_extension(&extension(file)).is_some()
}

/// What a mesh stands for.
pub(crate) enum MeshShape {
    /// A smooth closed surface.
    Smooth(Box<MeshField>),
    /// Smooth pieces with sharp edges and boundaries.
    Sharp(Box<SharpMesh>),
}

impl MeshShape {
    fn mesh(&self) -> &TriMesh {
        match self {
            Self::Smooth(field) => field.mesh(),
            Self::Sharp(sharp) => sharp.mesh(),
        }
    }
}

/// A mesh and the surface that it stands for.
pub(crate) struct MeshTask {
    pub(crate) file: PathBuf,
    pub(crate) shape: MeshShape,
    pub(crate) base: MeshBase,
    crease_angle: f64,
    faces: usize,
    repairs: Repairs,
    groups: usize,
}

impl MeshTask {
    pub(super) fn new(arguments: &FitArguments, file: &Path) -> anyhow::Result<Self> {
        let options = &arguments.mesh_options;
        refuse_scene_options(arguments, file)?;
        let MeshFile { mesh, repairs, groups, .. } = read_mesh_file(file)?;
        let triangles = mesh.topology().face_count();
        let (base, faces) = match (tolerance(arguments), arguments.faces, options.keep_vertices) {
            (Some(tolerance), ..) => (MeshBase::Tolerance(tolerance), 0),
            (None, Some(faces), _) => (MeshBase::Faces, faces),
            (None, None, true) => (MeshBase::Keep, triangles),
            (None, None, false) => bail!(
                "{}: how many patches? --faces N makes about N, --tolerance as few as an accuracy takes, \
                 --keep-vertices one for each of the {triangles} triangles",
                file.display()
            ),
        };
        let crease_angle = options.crease_angle.unwrap_or(CREASE_ANGLE);
        let shape = shape(file, mesh, &options.jets(), crease_angle.to_radians(), base)?;
        let groups = groups.len();
        Ok(Self { file: file.to_owned(), shape, base, crease_angle, faces, repairs, groups })
    }

    /// The number of patches asked for.
    pub(super) fn faces(&self) -> usize {
        self.faces
    }

    pub(super) fn fit(
        &self,
        settings: &Settings,
        progress: &mut dyn Progress,
    ) -> anyhow::Result<G1Surface> {
        let fitted = match &self.shape {
            MeshShape::Smooth(field) => fit_mesh_field(field, self.base, settings, progress),
            MeshShape::Sharp(sharp) => sharp.fit(settings, progress),
        };
        fitted.map_err(|error| anyhow!("{}: {error}", self.file.display()))
    }

    /// The number of patches, if one was asked for.
    pub(super) fn faces_asked(&self) -> Option<usize> {
        matches!(self.base, MeshBase::Faces).then_some(self.faces)
    }

    /// The name of the file without its ending.
    pub(super) fn name(&self) -> String {
        self.file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// What is known about the mesh, and how far it is from the patches.
    pub(crate) fn report(&self, surface: &G1Surface) -> MeshReport {
        let mesh = self.shape.mesh();
        let fields: Vec<&MeshField> = match &self.shape {
            MeshShape::Smooth(field) => vec![field],
            MeshShape::Sharp(sharp) => sharp.fields().collect(),
        };
        MeshReport {
            file: self.file.clone(),
            vertices: mesh.topology().vertex_count(),
            triangles: mesh.topology().face_count(),
            groups: self.groups,
            repairs: self.repairs,
            crease_angle_deg: self.crease_angle,
            jets: jet_summary(&fields),
            rim: surface.rim.as_ref().map(RimReport::new),
            distances: mesh_distances(mesh, &surface.patches.nets),
        }
    }
}

/// Everything about the mesh that was fitted.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct MeshReport {
    file: PathBuf,
    vertices: usize,
    triangles: usize,
    groups: usize,
    repairs: Repairs,
    crease_angle_deg: f64,
    jets: JetSummary,
    #[serde(skip_serializing_if = "Option::is_none")]
    rim: Option<RimReport>,
    distances: MeshDistances,
}

/// Where the surface is not smooth: the ends of edges, counted from 0.
#[derive(Clone, Debug, Serialize)]
struct RimReport {
    creases: Vec<[usize; 2]>,
    boundary: Vec<[usize; 2]>,
    smoothed: Vec<[usize; 2]>,
}

impl RimReport {
    fn new(rim: &Rim) -> Self {
        let ends = |edges: &[EdgeId]| -> Vec<[usize; 2]> {
            let vertices = |&e: &EdgeId| rim.whole.topology().edge_vertices(e).map(VertexId::index);
            edges.iter().map(vertices).collect()
        };
        Self {
            creases: ends(&rim.creases),
            boundary: ends(&rim.boundary),
            smoothed: ends(&rim.smoothed),
        }
    }
}

impl MeshReport {
    /// Lines of the table about the mesh itself.
    pub(crate) fn rows_of_input(&self, table: &mut Table) {
        let Self { vertices, triangles, repairs, jets, rim, .. } = self;
        table.row("mesh", format!("{vertices} vertices, {triangles} triangles"));
        if let Some(text) = repairs_text(repairs) {
            table.row("put in order", text);
        }
        let [first, second, third, fourth] = jets.by_degree;
        let degrees = [(first, 1), (second, 2), (third, 3), (fourth, 4)]
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, degree)| format!("{count} of degree {degree}"));
        table.row("jets", degrees.collect::<Vec<_>>().join(", "));
        if let Some(RimReport { creases, boundary, smoothed }) = rim {
            let counts = [(creases, "creases"), (boundary, "open"), (smoothed, "single, smoothed")];
            let text: Vec<String> = counts
                .into_iter()
                .filter(|(edges, _)| !edges.is_empty())
                .map(|(edges, what)| format!("{} {what}", edges.len()))
                .collect();
            table.row("not smooth", format!("edges: {}", text.join(", ")));
        }
        table.row("jet residual", format!("{:.2e} of the radius (RMS)", jets.rms_residual));
    }

    /// Lines of the table about the distances of the mesh from the patches.
    pub(crate) fn rows_of_distances(&self, table: &mut Table) {
        let MeshDistances { vertices, triangle_samples, .. } = &self.distances;
        table.row(
            "input vertices",
            format!("{}, RMS {:.2e}", of_diagonal(vertices.max), vertices.rms),
        );
        table.row(
            "input triangles",
            format!("{}, RMS {:.2e}", of_diagonal(triangle_samples.max), triangle_samples.rms),
        );
    }
}

/// What was done to the file; `None` if nothing.
fn repairs_text(repairs: &Repairs) -> Option<String> {
    let parts = [
        (repairs.polygons, "polygons cut"),
        (repairs.merged_vertices, "equal vertices merged"),
        (repairs.unused_vertices, "unused vertices dropped"),
        (repairs.collapsed_faces, "collapsed faces dropped"),
        (repairs.double_faces, "double faces dropped"),
        (repairs.turned_faces, "faces turned"),
    ];
    let parts: Vec<String> = parts
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// Options about functions have no meaning for meshes.
fn refuse_scene_options(arguments: &FitArguments, file: &Path) -> anyhow::Result<()> {
    let given = [
        (arguments.region.is_some(), "--region"),
        (arguments.base_mesh.is_some(), "--base-mesh"),
        (arguments.certify, "--certify"),
    ];
    match given.into_iter().find(|(given, _)| *given) {
        None => Ok(()),
        Some((_, "--certify")) => bail!(
            "{}: --certify encloses the values of a formula; about the surface of a mesh nothing can be \
             proven",
            file.display()
        ),
        Some((_, option)) => {
            bail!("{}: {option} is for surfaces of functions, not for meshes", file.display())
        }
    }
}

/// The smooth surface of a mesh, or its smooth pieces.
fn shape(
    file: &Path,
    mesh: TriMesh,
    jets: &JetSettings,
    crease_angle: f64,
    base: MeshBase,
) -> anyhow::Result<MeshShape> {
    let error = |error: JetError| anyhow!("{}: {error}", file.display());
    let sharp = sharp_edges(&mesh, crease_angle);
    if sharp.creases.is_empty() && sharp.boundary.is_empty() {
        let jets = fit_jets(&mesh, jets).map_err(error)?;
        return Ok(MeshShape::Smooth(Box::new(MeshField::new(mesh, jets).map_err(error)?)));
    }
    if base != MeshBase::Keep {
        bail!(
            "{}: {} edges are sharper than {:.0}° (the largest angle is {:.1}°) and {} have one face only; \
             a mesh with such edges keeps its triangles: use --keep-vertices, or raise --crease-angle if \
             the surface is meant to be smooth there",
            file.display(),
            sharp.creases.len(),
            crease_angle.to_degrees(),
            sharp.largest_angle.to_degrees(),
            sharp.boundary.len(),
        );
    }
    Ok(MeshShape::Sharp(Box::new(SharpMesh::new(mesh, &sharp, jets).map_err(error)?)))
}
