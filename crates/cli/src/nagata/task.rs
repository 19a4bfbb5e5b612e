//! From options to a surface.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use smoothpatch::FieldSource;
use smoothpatch::implicit::{ImplicitSurface, ProjectionSettings};
use smoothpatch::io::{LargeFaces, ObjReadError, Polygon, Polygons, Scene, read_polygons_file};
use smoothpatch::nagata::{NagataSurface, Settings, SurfaceError};
use smoothpatch::nagata_surface::{NagataError, NormalSource, from_polygons};
use smoothpatch::scene::field_of;

use super::options::{NormalsName, SurfaceOptions};

/// A surface and where it comes from.
pub(crate) struct Task {
    pub(crate) mesh: PathBuf,
    pub(crate) settings: Settings,
    pub(crate) normals: NormalsUsed,
    /// Degrees, if normals are estimated.
    pub(crate) crease_angle: Option<f64>,
    /// The surface to compare with, and its name.
    pub(crate) reference: Option<(String, Box<dyn ImplicitSurface>)>,
    pub(crate) surface: NagataSurface,
}

/// The normals that were used.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NormalsUsed {
    File,
    Estimate,
    Scene(PathBuf),
}

impl Task {
    pub(crate) fn new(options: &SurfaceOptions, reference: Option<&Path>) -> anyhow::Result<Self> {
        let settings = options.settings()?;
        let polygons = read(options)?;
        let normals = normals_used(options, &polygons);
        let normals_scene = match &normals {
            NormalsUsed::Scene(path) => Some(path.as_path()),
            NormalsUsed::File | NormalsUsed::Estimate => None,
        };
        let reference = reference.or(normals_scene).map(field).transpose()?;
        let normals_field = normals_scene.map(field).transpose()?;
        let source = match (&normals, &normals_field) {
            (_, Some((_, field))) => NormalSource::Field(&**field),
            (NormalsUsed::File, None) => NormalSource::File,
            (_, None) => NormalSource::Estimate { crease_angle: options.crease_angle.to_radians() },
        };
        let surface = from_polygons(&polygons, source, settings)
            .map_err(|error| explain(&options.mesh, &error))?;
        Ok(Self {
            mesh: options.mesh.clone(),
            settings,
            crease_angle: (normals == NormalsUsed::Estimate).then_some(options.crease_angle),
            normals,
            reference,
            surface,
        })
    }

    /// The surface to compare with.
    pub(crate) fn target(&self) -> Option<FieldSource<'_>> {
        let (_, field) = self.reference.as_ref()?;
        let diagonal = self.surface.mesh().diagonal();
        Some(FieldSource::new(&**field, diagonal, ProjectionSettings::default()))
    }
}

/// The mesh as the options want it.
fn read(options: &SurfaceOptions) -> anyhow::Result<Polygons> {
    let large_faces = if options.triangulate { LargeFaces::Split } else { LargeFaces::Refuse };
    let polygons = read_polygons_file(&options.mesh, large_faces).map_err(|error| {
        let hint = match error.problem {
            ObjReadError::NotAPolygon { corners: 5.., .. } => "; --triangulate does it",
            _ => "",
        };
        anyhow!("{error}{hint}")
    })?;
    Ok(if options.triangulate { polygons.triangulated() } else { polygons })
}

fn normals_used(options: &SurfaceOptions, polygons: &Polygons) -> NormalsUsed {
    let mut corners = polygons.corner_normals.iter().flat_map(Polygon::corners);
    match &options.normals {
        Some(NormalsName::File) => NormalsUsed::File,
        Some(NormalsName::Estimate) => NormalsUsed::Estimate,
        Some(NormalsName::Scene(path)) => NormalsUsed::Scene(path.clone()),
        None if corners.any(Option::is_some) => NormalsUsed::File,
        None => NormalsUsed::Estimate,
    }
}

/// The name and the field of a scene.
fn field(path: &Path) -> anyhow::Result<(String, Box<dyn ImplicitSurface>)> {
    let scene = Scene::read(path)?;
    let field = field_of(&scene.surface)?;
    Ok((scene.name, field))
}

/// The message with the file, and with the option that would help.
fn explain(mesh: &Path, error: &NagataError) -> anyhow::Error {
    let hint = match error {
        NagataError::NoNormals => " (--normals estimate, or --normals SCENE.ron)",
        NagataError::Surface(SurfaceError::Quadrilateral { .. }) => {
            "; --triangulate cuts them in two"
        }
        _ => "",
    };
    anyhow!("{}: {error}{hint}", mesh.display())
}
