//! From options to a surface.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use smoothpatch::FieldSource;
use smoothpatch::implicit::{ImplicitSurface, ProjectionSettings};
use smoothpatch::io::{LargeFaces, ObjReadError, Polygon, Polygons, Scene, read_polygons_file};
use smoothpatch::nagata::{NagataSurface, Settings, SurfaceError};
use smoothpatch::nagata_surface::{
    NagataError, NormalSource, from_polygons, from_polygons_with_tips,
};
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
    /// Number of tips whose normals were changed, if asked for.
    pub(crate) tips: Option<usize>,
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
        let polygons = read(&options.mesh, options.triangulate)?;
        let normals = NormalsUsed::of(options.normals.as_ref(), &polygons);
        let normals_scene = normals.scene();
        let reference = reference.or(normals_scene).map(field).transpose()?;
        let normals_field = normals_scene.map(field).transpose()?;
        let source = match (&normals, &normals_field) {
            (_, Some((_, field))) => NormalSource::Field(&**field),
            (NormalsUsed::File, None) => NormalSource::File,
            (_, None) => NormalSource::Estimate { crease_angle: options.crease_angle.to_radians() },
        };
        let made = match options.tips() {
            None => from_polygons(&polygons, source, settings).map(|surface| (surface, None)),
            Some(tips) => from_polygons_with_tips(&polygons, source, tips, settings)
                .map(|(surface, count)| (surface, Some(count))),
        };
        let (surface, tips) = made.map_err(|error| explain(&options.mesh, &error))?;
        Ok(Self {
            mesh: options.mesh.clone(),
            settings,
            crease_angle: (normals == NormalsUsed::Estimate).then_some(options.crease_angle),
            normals,
            reference,
            tips,
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

/// The mesh of a file, cut into triangles if that is wanted.
pub(crate) fn read(mesh: &Path, triangulate: bool) -> anyhow::Result<Polygons> {
    let large_faces = if triangulate { LargeFaces::Split } else { LargeFaces::Refuse };
    let polygons = read_polygons_file(mesh, large_faces).map_err(|error| {
        let hint = match error.problem {
            ObjReadError::NotAPolygon { corners: 5.., .. } => "; --triangulate does it",
            _ => "",
        };
        anyhow!("{error}{hint}")
    })?;
    Ok(if triangulate { polygons.triangulated() } else { polygons })
}

impl NormalsUsed {
    /// What an option asks for; without one, those of the file if it has any.
    pub(crate) fn of(option: Option<&NormalsName>, polygons: &Polygons) -> Self {
        let mut corners = polygons.corner_normals.iter().flat_map(Polygon::corners);
        match option {
            Some(NormalsName::File) => Self::File,
            Some(NormalsName::Estimate) => Self::Estimate,
            Some(NormalsName::Scene(path)) => Self::Scene(path.clone()),
            None if corners.any(Option::is_some) => Self::File,
            None => Self::Estimate,
        }
    }

    /// The scene that they come from.
    pub(crate) fn scene(&self) -> Option<&Path> {
        match self {
            Self::Scene(path) => Some(path),
            Self::File | Self::Estimate => None,
        }
    }
}

/// The name and the field of a scene.
pub(crate) fn field(path: &Path) -> anyhow::Result<(String, Box<dyn ImplicitSurface>)> {
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
