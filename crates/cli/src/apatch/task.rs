//! From options to a surface.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use smoothpatch::FieldSource;
use smoothpatch::apatch::rational::{RationalSurface, Settings, SurfaceError};
use smoothpatch::apatch_surface::{NormalSource, RationalError, rational_surface};
use smoothpatch::implicit::{ImplicitSurface, ProjectionSettings};

use super::options::RationalOptions;
use crate::nagata::task::{NormalsUsed, field, read};

/// A surface and where it comes from.
pub(crate) struct Task {
    pub(crate) mesh: PathBuf,
    pub(crate) settings: Settings,
    pub(crate) normals: NormalsUsed,
    /// The surface to compare with, and its name.
    pub(crate) reference: Option<(String, Box<dyn ImplicitSurface>)>,
    pub(crate) surface: RationalSurface,
}

impl Task {
    pub(crate) fn new(options: &RationalOptions, reference: Option<&Path>) -> anyhow::Result<Self> {
        let settings = options.settings()?;
        let polygons = read(&options.mesh, options.triangulate)?;
        let normals = NormalsUsed::of(options.normals.as_ref(), &polygons);
        let reference = reference.or(normals.scene()).map(field).transpose()?;
        let normals_field = normals.scene().map(field).transpose()?;
        let source = match (&normals, &normals_field) {
            (_, Some((_, field))) => NormalSource::Field(&**field),
            (NormalsUsed::File, None) => NormalSource::File,
            (_, None) => NormalSource::Estimate,
        };
        let surface = rational_surface(&polygons, source, &settings)
            .map_err(|error| explain(options, &error))?;
        Ok(Self { mesh: options.mesh.clone(), settings, normals, reference, surface })
    }

    /// The surface to compare with.
    pub(crate) fn target(&self) -> Option<FieldSource<'_>> {
        let (_, field) = self.reference.as_ref()?;
        let diagonal = self.surface.mesh().diagonal();
        Some(FieldSource::new(&**field, diagonal, ProjectionSettings::default()))
    }
}

/// The message with the file, and with the option that would help.
fn explain(options: &RationalOptions, error: &RationalError) -> anyhow::Error {
    let hint = match error {
        RationalError::NoNormals => " (--normals estimate, or --normals SCENE.ron)",
        RationalError::NoNormal { .. } | RationalError::SeveralNormals { .. } => {
            " (--normals estimate)"
        }
        RationalError::Quadrilateral { .. } => "; --triangulate cuts it in two",
        _ => "",
    };
    let tension = match error {
        RationalError::Surface(SurfaceError::MissingFace { .. } | SurfaceError::Setting { .. }) => {
            options.tension_file()
        }
        _ => None,
    };
    let file = tension.unwrap_or(&options.mesh);
    anyhow!("{}: {error}{hint}", file.display())
}
