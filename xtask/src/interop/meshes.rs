//! Samples of G1 splines over meshes from files.

use std::f64::consts::PI;

use anyhow::Result;
use serde_json::{Value, json};
use smoothpatch::basemesh::FieldTarget;
use smoothpatch::implicit::{ImplicitSurface, ProjectionSettings, Sphere, Torus};
use smoothpatch::io::{PatchSurface, StepOptions, read_mesh_file};
use smoothpatch::measure::deviation;
use smoothpatch::mesh_surface::{MeshBase, fit_mesh_field, mesh_field};
use smoothpatch::meshfield::JetSettings;
use smoothpatch::{G1Surface, Settings, Silent};

use super::samples::Samples;

/// Angle between faces up to which a mesh counts as smooth.
const CREASE_ANGLE: f64 = 80.0 * PI / 180.0;

pub(super) fn write(samples: &mut Samples) -> Result<()> {
    let sphere = fitted("sphere_1280.stl", MeshBase::Faces, 100)?;
    let mut facts = volume(&sphere, &Sphere::default(), 4.0 * PI / 3.0, 4.0 * PI);
    facts["operations"] = json!(true);
    facts["box"] = json!([[0.013, -2.0, -2.0], [2.0, 2.0, 2.0]]);
    step(samples, "mesh-sphere.step", &sphere, facts)?;

    let torus = fitted("torus_48x24.ply", MeshBase::Faces, 400)?;
    let exact = Torus { major_radius: 3.0, minor_radius: 1.0 };
    let facts = volume(&torus, &exact, 6.0 * PI * PI, 12.0 * PI * PI);
    step(samples, "mesh-torus.step", &torus, facts)?;

    let kept = fitted("sphere_1280.stl", MeshBase::Keep, 0)?;
    let facts = volume(&kept, &Sphere::default(), 4.0 * PI / 3.0, 4.0 * PI);
    step(samples, "mesh-sphere-kept.step", &kept, facts)
}

fn fitted(name: &str, base: MeshBase, faces: usize) -> Result<G1Surface> {
    let mesh = read_mesh_file(crate::root().join("fixtures/meshes").join(name))?.mesh;
    let field = mesh_field(mesh, &JetSettings::default(), CREASE_ANGLE)?;
    Ok(fit_mesh_field(&field, base, &Settings::with_faces(faces), &mut Silent)?)
}

/// Volume of the exact surface: that of the patches differs by no more than the area times the largest
/// distance.
fn volume(surface: &G1Surface, exact: &dyn ImplicitSurface, volume: f64, area: f64) -> Value {
    let diagonal = surface.mesh.diagonal();
    let target = FieldTarget::new(exact, diagonal, ProjectionSettings::default());
    let (measured, _) = deviation(&surface.patches.nets, &target, diagonal);
    let slack = 1.01 * area * measured.max * diagonal;
    json!({ "smooth": true, "volume": volume, "volume_tolerance": slack })
}

fn step(samples: &mut Samples, file: &str, surface: &G1Surface, facts: Value) -> Result<()> {
    let patches = PatchSurface::from_triangles(surface.mesh.topology(), &surface.patches.nets)?;
    samples.step(file, &patches, &StepOptions::default(), facts)
}
