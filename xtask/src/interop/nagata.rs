//! Samples of curved meshes: C0 and G1, with creases, open and closed.

use std::f64::consts::TAU;

use anyhow::Result;
use serde_json::json;
use smoothpatch::basemesh::FaceId;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::io::{
    Encoding, LargeFaces, Polygon, Polygons, Scene, StepOptions, read_polygons_file, write_grid,
};
use smoothpatch::nagata::{Continuity, NagataSurface, Patch, Settings};
use smoothpatch::nagata_surface::{
    NormalSource, chord_tessellation, curved_grid, curved_mesh, from_polygons, patch_surface,
};
use smoothpatch::scene;

use super::samples::Samples;

pub(super) fn write(samples: &mut Samples) -> Result<()> {
    let torus = torus(24, 12);
    let field =
        scene::field_of(&Scene::read(crate::root().join("fixtures/scenes/torus.ron"))?.surface)?;
    let normals = NormalSource::Field(&*field);
    let quads = from_polygons(&torus, normals, Settings::position())?;
    surface(samples, "nagata-torus", &quads, true)?;
    // triangles and quadrilaterals with common edges
    let mixed = from_polygons(&half_triangulated(&torus), normals, Settings::position())?;
    surface(samples, "nagata-mixed", &mixed, true)?;
    let smooth = from_polygons(&torus.triangulated(), normals, Settings::tangent_plane())?;
    surface(samples, "nagata-g1", &smooth, true)?;

    let spot = mesh("spot_triangulated.obj")?;
    let estimate = NormalSource::Estimate { crease_angle: 45_f64.to_radians() };
    let creased = from_polygons(&few_faces(&spot, 400), estimate, Settings::position())?;
    let facts = json!({ "smooth": false });
    samples.step("nagata-open.step", &patch_surface(&creased)?, &StepOptions::default(), facts)
}

fn mesh(name: &str) -> Result<Polygons> {
    let path = crate::root().join("fixtures/meshes").join(name);
    Ok(read_polygons_file(path, LargeFaces::Refuse)?)
}

/// Quadrilaterals with corners on the torus of `fixtures/scenes/torus.ron`.
fn torus(around: usize, across: usize) -> Polygons {
    let angle = |step: usize, of: usize| TAU * step as f64 / of as f64;
    let at = |i: usize, j: usize| {
        let (p, q) = (angle(i, around), angle(j, across));
        DVec3::new((5.0 + q.cos()) * p.cos(), (5.0 + q.cos()) * p.sin(), q.sin())
    };
    let id = |i: usize, j: usize| i % around * across + j % across;
    let grid = || (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    let corners = |(i, j)| [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
    Polygons {
        positions: grid().map(|(i, j)| at(i, j)).collect(),
        normals: Vec::new(),
        faces: grid().map(|place| Polygon::quad(corners(place))).collect(),
        corner_normals: vec![Polygon::quad([None; 4]); around * across],
    }
}

fn surface(
    samples: &mut Samples,
    name: &str,
    surface: &NagataSurface,
    is_regular: bool,
) -> Result<()> {
    let diagonal = surface.mesh().diagonal();
    let curved = curved_grid(surface, 4);
    let types: Vec<u8> =
        curved.grid.cells.iter().map(smoothpatch::io::GridCell::vtk_type).collect();
    let facts = json!({
        "cells": curved.grid.cells.len(),
        "cell_types": types,
        "points": points(surface),
        "point_tolerance": 1e-14,
        "size": diagonal,
    });
    samples.add("vtu", &format!("{name}.vtu"), facts, |out| {
        Ok(write_grid(out, &curved.grid, Encoding::Appended)?)
    })?;
    for order in [2, 4] {
        samples.msh(name, &curved_mesh(surface, order).0, &json!({ "regular": is_regular }))?;
    }
    let flat = chord_tessellation(surface, 2e-3 * diagonal)?;
    samples.triangles(name, &flat.tessellation, &json!({}))?;
    if surface.settings().continuity == Continuity::Position {
        let mut facts = json!({ "smooth": false, "operations": name == "nagata-mixed" });
        facts["box"] = json!([[0.1, -9.0, -9.0], [9.0, 9.0, 9.0]]);
        let file = format!("{name}.step");
        samples.step(&file, &patch_surface(surface)?, &StepOptions::default(), facts)?;
    }
    Ok(())
}

/// Points of the patches that are one cell each.
fn points(surface: &NagataSurface) -> Vec<[f64; 6]> {
    let mesh = surface.mesh();
    let count = mesh.face_count();
    let some = (0..count).step_by(count.div_ceil(25));
    let mut points = Vec::new();
    for face in some {
        for [r, s] in [[0.2, 0.3], [0.1, 0.7], [0.5, 0.5]] {
            let DVec3 { x, y, z } = match surface.patch(FaceId::new(face)) {
                Patch::Triangle(patch) => {
                    use smoothpatch::bezier_core::Barycentric;
                    patch.point(Barycentric::from_array([1.0 - r - s, r, s]))
                }
                Patch::Quad(patch) => patch.point([r, s]),
                Patch::TangentPlane(_) => continue,
            };
            points.push([face as f64, r, s, x, y, z]);
        }
    }
    points
}

/// Every other face cut in two.
fn half_triangulated(mesh: &Polygons) -> Polygons {
    let triangulated = mesh.triangulated();
    let (mut faces, mut corner_normals) = (Vec::new(), Vec::new());
    for face in 0..mesh.faces.len() {
        // each quadrilateral becomes two triangles, in face order
        let (from, range) = if face % 2 == 0 {
            (mesh, face..face + 1)
        } else {
            (&triangulated, 2 * face..2 * face + 2)
        };
        faces.extend_from_slice(&from.faces[range.clone()]);
        corner_normals.extend_from_slice(&from.corner_normals[range]);
    }
    Polygons { faces, corner_normals, ..mesh.clone() }
}

/// The first faces of a mesh with the vertices that they use.
fn few_faces(mesh: &Polygons, count: usize) -> Polygons {
    let mut new_ids = vec![usize::MAX; mesh.positions.len()];
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    for face in &mesh.faces[..count] {
        let corners: Vec<usize> = face
            .corners()
            .iter()
            .map(|&vertex| {
                if new_ids[vertex] == usize::MAX {
                    new_ids[vertex] = positions.len();
                    positions.push(mesh.positions[vertex]);
                }
                new_ids[vertex]
            })
            .collect();
        faces.extend(Polygon::new(&corners));
    }
    let corner_normals = mesh.corner_normals[..count].to_vec();
    Polygons { positions, normals: mesh.normals.clone(), faces, corner_normals }
}
