//! What is to be fitted and how, if it is the zero set of a function: options and scene file put together.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use smoothpatch::basemesh::{PolygonizeError, TriMesh};
use smoothpatch::implicit::{Aabb, ImplicitSurface};
use smoothpatch::io::read_obj_file;
use smoothpatch::scene::{base_mesh_of, field_of, region_of};
use smoothpatch::{
    Distance, FitError, G1Surface, Progress, Settings, Tolerance, find_region, fit, fit_base_mesh,
    fit_to_tolerance,
};

use super::FitArguments;
use crate::surface::ChosenScene;
use crate::values::region_text;

/// The zero set of a function.
pub(crate) struct SceneTask {
    pub(crate) chosen: ChosenScene,
    pub(crate) field: Box<dyn ImplicitSurface>,
    pub(crate) base: BaseMesh,
}

/// Where the base mesh comes from.
pub(crate) enum BaseMesh {
    /// Made by polygonizing and simplifying.
    Made { region: Aabb, faces: usize },
    /// Made and changed until an accuracy is reached.
    Adapted { region: Aabb, tolerance: Tolerance },
    /// Read from a file.
    Given { file: PathBuf, mesh: TriMesh },
}

impl SceneTask {
    pub(crate) fn new(arguments: &FitArguments) -> anyhow::Result<Self> {
        refuse_mesh_options(arguments)?;
        let chosen = arguments
            .surface
            .scene(arguments.input.as_deref())?
            .ok_or_else(|| anyhow!("no surface is given"))?;
        let field = field_of(&chosen.scene.surface)?;
        let base = if let Some(tolerance) = tolerance(arguments) {
            refuse_base_mesh(arguments, &chosen)?;
            BaseMesh::Adapted { region: region(arguments, &chosen, &*field)?, tolerance }
        } else if let Some((file, mesh)) = given_mesh(arguments, &chosen)? {
            BaseMesh::Given { file, mesh }
        } else {
            BaseMesh::Made {
                region: region(arguments, &chosen, &*field)?,
                faces: arguments.faces.unwrap_or(chosen.scene.faces),
            }
        };
        Ok(Self { chosen, field, base })
    }

    /// The whole pipeline.
    pub(crate) fn fit(
        &self,
        settings: &Settings,
        progress: &mut dyn Progress,
    ) -> anyhow::Result<G1Surface> {
        let fitted = match &self.base {
            BaseMesh::Made { region, .. } => fit(&*self.field, region, settings, progress),
            BaseMesh::Adapted { region, tolerance } => {
                fit_to_tolerance(&*self.field, region, tolerance, settings, progress)
            }
            BaseMesh::Given { mesh, .. } => {
                fit_base_mesh(&*self.field, mesh.clone(), settings, progress)
            }
        };
        fitted.map_err(|error| match error {
            FitError::Polygonize(error) => explain(&error),
            other => other.into(),
        })
    }

    /// Files that must not be overwritten with results.
    pub(crate) fn files_read(&self) -> Vec<&Path> {
        let mesh = match &self.base {
            BaseMesh::Given { file, .. } => Some(file.as_path()),
            BaseMesh::Made { .. } | BaseMesh::Adapted { .. } => None,
        };
        self.chosen.file.as_deref().into_iter().chain(mesh).collect()
    }
}

/// Options about meshes have no meaning for functions.
fn refuse_mesh_options(arguments: &FitArguments) -> anyhow::Result<()> {
    match arguments.mesh_options.first_given() {
        None => Ok(()),
        Some(option) => bail!(
            "{option} is for meshes (.obj, .stl, .ply, .off) to be fitted; here the surface is the zero \
             set of a function"
        ),
    }
}

impl BaseMesh {
    pub(crate) fn faces(&self) -> usize {
        match self {
            Self::Made { faces, .. } => *faces,
            Self::Adapted { .. } => 0,
            Self::Given { mesh, .. } => mesh.topology().face_count(),
        }
    }
}

/// Distance that is asked for with a normal tolerance alone, in diagonals.
const USUAL_DISTANCE: f64 = 1e-4;

/// The accuracy that is asked for, if any.
pub(super) fn tolerance(arguments: &FitArguments) -> Option<Tolerance> {
    let distance = match (arguments.tolerance, arguments.absolute) {
        (Some(length), true) => Distance::Absolute(length),
        (Some(part), false) => Distance::Relative(part),
        (None, _) => Distance::Relative(USUAL_DISTANCE),
    };
    let normal_deg = arguments.normal_tolerance;
    (arguments.tolerance.is_some() || normal_deg.is_some())
        .then_some(Tolerance { distance, normal_deg })
}

/// The parser refuses the option `--base-mesh`; this is about the scene's.
fn refuse_base_mesh(arguments: &FitArguments, chosen: &ChosenScene) -> anyhow::Result<()> {
    let Some(scene) = chosen.file.as_ref().filter(|_| chosen.scene.base_mesh.is_some()) else {
        return Ok(());
    };
    let option = match arguments.tolerance {
        Some(_) => "--tolerance",
        None => "--normal-tolerance",
    };
    bail!(
        "{}: the scene has a base mesh, whose faces become the patches as they are, but {option} \
         asks for an accuracy; leave one of them out",
        scene.display()
    )
}

/// The base mesh that the options or the scene name, unless a region is given to look in.
fn given_mesh(
    arguments: &FitArguments,
    chosen: &ChosenScene,
) -> anyhow::Result<Option<(PathBuf, TriMesh)>> {
    let given = match (&arguments.base_mesh, &chosen.file) {
        (Some(file), _) => Some((file.clone(), read_obj_file(file)?)),
        (None, Some(scene_file)) => {
            chosen.scene.base_mesh_beside(scene_file).zip(base_mesh_of(&chosen.scene, scene_file)?)
        }
        (None, None) => None,
    };
    let Some((file, mesh)) = given else { return Ok(None) };
    let faces = mesh.topology().face_count();
    if let Some(wanted) = arguments.faces.filter(|&wanted| wanted != faces) {
        bail!(
            "{}: the base mesh has {faces} faces, which become the patches, but --faces asks for \
             {wanted}; leave one of them out",
            file.display()
        );
    }
    if arguments.region.is_some() {
        bail!("{}: with a base mesh no region is searched; leave --region out", file.display());
    }
    Ok(Some((file, mesh)))
}

fn region(
    arguments: &FitArguments,
    chosen: &ChosenScene,
    field: &dyn ImplicitSurface,
) -> anyhow::Result<Aabb> {
    if let Some(region) = arguments.region {
        return Ok(region);
    }
    if let Some(region) = region_of(&chosen.scene)? {
        return Ok(region);
    }
    find_region(field).map_err(|error| {
        anyhow!(
            "no region is given, and the search around the origin found none (--region sets it): {}",
            explain(&error)
        )
    })
}

/// The message, with what to type if another region would help.
fn explain(error: &PolygonizeError) -> anyhow::Error {
    match error {
        PolygonizeError::LeavesRegion { suggested, .. } => {
            anyhow!("{error}\n  try --region {}", region_text(suggested))
        }
        _ => anyhow!("{error}"),
    }
}
