//! Samples of G1 splines.

use std::f64::consts::PI;

use anyhow::Result;
use serde_json::{Value, json};
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{FaceMap, Topology};
use smoothpatch::bezier_core::{Barycentric, SepticTriangle};
use smoothpatch::io::{
    CellData, CellKind, CellValues, CurvedMesh, PatchSurface, Scene, StepFaces, StepOptions,
    StepSchema, VtuOptions, read_piece_file, tessellate_patches_within, write_pvtu, write_vtu,
};
use smoothpatch::measure::Deviation;
use smoothpatch::{FieldSource, G1Surface, Settings, Silent, find_region, fit, report, scene};

use super::samples::Samples;

/// A surface, and how far it is from the one that it stands for.
struct Fitted {
    surface: G1Surface,
    deviation: Deviation,
}

fn fitted(scene: &str) -> Result<Fitted> {
    let scene = Scene::parse(scene)?;
    let field = scene::field_of(&scene.surface)?;
    let region = scene::region_of(&scene)?.map_or_else(|| find_region(&*field), Ok)?;
    let settings = Settings::with_faces(scene.faces);
    let surface = fit(&*field, &region, &settings, &mut Silent)?;
    let source = FieldSource::new(&*field, surface.mesh.diagonal(), settings.projection);
    let (report, _) = report(&surface, &source, &mut Silent);
    Ok(Fitted { surface, deviation: report.deviation })
}

impl Fitted {
    fn parts(&self) -> (&Topology, &FaceMap<SepticTriangle>) {
        (self.surface.mesh.topology(), &self.surface.patches.nets)
    }

    fn step_surface(&self) -> Result<PatchSurface> {
        let (topology, nets) = self.parts();
        Ok(PatchSurface::from_triangles(topology, nets)?)
    }

    /// Volume and area of the exact surface: the volume inside the patches differs by no more than
    /// the area times the deviation.
    fn volume(&self, volume: f64, area: f64) -> Value {
        let slack = 1.01 * area * self.deviation.max * self.deviation.diagonal;
        json!({ "smooth": true, "volume": volume, "volume_tolerance": slack })
    }
}

pub(super) fn write(samples: &mut Samples) -> Result<()> {
    let sphere = fitted(r#"(version: 1, name: "sphere", surface: Shape("sphere"), faces: 60)"#)?;
    let torus = fitted(r#"(version: 1, name: "torus", surface: Shape("torus"), faces: 200)"#)?;
    steps(samples, &sphere, &torus)?;
    hollow_and_double(samples)?;
    vtu(samples, "torus", &torus)?;
    pieces(samples, &torus)?;
    let (topology, nets) = torus.parts();
    for order in [1, 3, 7, 10] {
        let mesh = CurvedMesh::from_patches(topology, nets, order);
        // flat triangles of a coarse torus are far from it, from order 3 on elements are near
        let mut facts = json!({ "regular": true });
        if order >= 7 {
            facts["area"] = json!(4.0 * PI * PI * 5.0);
            facts["area_tolerance"] = json!(1e-4);
        }
        samples.msh("torus", &mesh, &facts)?;
    }
    let flat = tessellate_patches_within(topology, nets, 1e-3 * torus.surface.mesh.diagonal())?;
    let slack = 1.1 * 2.0 * 1e-3 * torus.surface.mesh.diagonal();
    let facts = json!({ "volume": 2.0 * PI * PI * 5.0, "volume_tolerance": slack });
    samples.triangles("torus", &flat.tessellation, &facts)
}

fn steps(samples: &mut Samples, sphere: &Fitted, torus: &Fitted) -> Result<()> {
    let surface = sphere.step_surface()?;
    let mut facts = sphere.volume(4.0 * PI / 3.0, 4.0 * PI);
    facts["operations"] = json!(true);
    facts["box"] = json!([[0.013, -2.0, -2.0], [2.0, 2.0, 2.0]]);
    facts["tetrahedra"] = json!(true);
    facts["mesh_size"] = json!(0.06);
    samples.step("sphere.step", &surface, &StepOptions::default(), facts.clone())?;
    facts["tetrahedra"] = json!(false);
    let degenerate = StepOptions { faces: StepFaces::Degenerate, ..StepOptions::default() };
    samples.step("sphere-degenerate.step", &surface, &degenerate, facts.clone())?;
    facts["operations"] = json!(false);
    let older = StepOptions {
        schema: StepSchema::Ap214,
        name: "ball's größe".into(),
        ..StepOptions::default()
    };
    samples.step("sphere-ap214.step", &surface, &older, facts)?;
    let facts = torus.volume(2.0 * PI * PI * 5.0, 4.0 * PI * PI * 5.0);
    samples.step("torus.step", &torus.step_surface()?, &StepOptions::default(), facts)
}

fn hollow_and_double(samples: &mut Samples) -> Result<()> {
    let hollow = fitted(
        r#"#![enable(implicit_some)]
        (version: 1, name: "hollow", faces: 120, region: (min: (-3, -3, -3), max: (3, 3, 3)),
         surface: Formula(text: "(x^2 + y^2 + z^2 - 1) * (x^2 + y^2 + z^2 - 4)"))"#,
    )?;
    let mut facts = hollow.volume(4.0 * PI / 3.0 * 7.0, 4.0 * PI * 5.0);
    facts["shells"] = json!(2);
    samples.step("hollow.step", &hollow.step_surface()?, &StepOptions::default(), facts)?;
    let double =
        fitted(r#"(version: 1, name: "double", surface: Shape("double-torus"), faces: 200)"#)?;
    let facts = json!({ "smooth": true });
    samples.step("double-torus.step", &double.step_surface()?, &StepOptions::default(), facts)
}

/// Some parameters of some cells: cell, second and third barycentric coordinate, and the point.
fn points(nets: &FaceMap<SepticTriangle>) -> Vec<[f64; 6]> {
    let every = nets.len().div_ceil(25);
    let places = [[0.2, 0.3], [0.1, 0.7], [0.5, 0.5], [1.0 / 3.0, 1.0 / 3.0]];
    let of_cell = |(face, patch): (usize, &SepticTriangle)| {
        places.map(|[v, w]| {
            let at = Barycentric::from_array([1.0 - v - w, v, w]);
            let DVec3 { x, y, z } = patch.eval_de_casteljau(at);
            [face as f64, v, w, x, y, z]
        })
    };
    nets.as_slice().iter().enumerate().step_by(every).flat_map(of_cell).collect()
}

fn vtu(samples: &mut Samples, name: &str, fitted: &Fitted) -> Result<()> {
    let (topology, nets) = fitted.parts();
    for (cells, suffix, tolerance) in
        [(CellKind::Bezier, "bezier", 1e-14), (CellKind::Lagrange, "lagrange", 1e-13)]
    {
        let facts = json!({
            "cells": nets.len(),
            "cell_types": [cells.vtk_type()],
            "points": points(nets),
            "point_tolerance": tolerance,
            "size": fitted.surface.mesh.diagonal(),
        });
        let options = VtuOptions { cells, ..VtuOptions::default() };
        samples.add("vtu", &format!("{name}-{suffix}.vtu"), facts, |out| {
            Ok(write_vtu(out, topology, nets, &options)?)
        })?;
    }
    Ok(())
}

/// The surface in two pieces, and the file that joins them.
fn pieces(samples: &mut Samples, fitted: &Fitted) -> Result<()> {
    let (topology, nets) = fitted.parts();
    let half = nets.len() / 2;
    let mut joined = Vec::new();
    for (name, faces) in [("left.vtu", 0..half), ("right.vtu", half..nets.len())] {
        let (topology, nets) = part(topology, nets, faces)?;
        let numbers = CellValues::Int64(vec![1; nets.len()]);
        let cell_data = vec![CellData { name: "piece".into(), values: numbers }];
        let options = VtuOptions { cell_data, ..VtuOptions::default() };
        let facts = json!({});
        samples.add("piece", name, facts, |out| Ok(write_vtu(out, &topology, &nets, &options)?))?;
        joined.push((name.to_owned(), read_piece_file(samples.folder().join(name))?));
    }
    let facts = json!({ "cells": nets.len(), "cell_data": ["piece"] });
    samples.add("pvtu", "joined.pvtu", facts, |out| Ok(write_pvtu(out, &joined)?))
}

/// Some faces of a surface with the vertices that they use.
fn part(
    topology: &Topology,
    nets: &FaceMap<SepticTriangle>,
    faces: std::ops::Range<usize>,
) -> Result<(Topology, FaceMap<SepticTriangle>)> {
    let mut new_ids = vec![usize::MAX; topology.vertex_count()];
    let mut count = 0;
    let corners: Vec<[usize; 3]> = topology
        .faces()
        .skip(faces.start)
        .take(faces.len())
        .map(|face| {
            topology.corners(face).map(|vertex| {
                let id = &mut new_ids[vertex.index()];
                if *id == usize::MAX {
                    *id = count;
                    count += 1;
                }
                *id
            })
        })
        .collect();
    let patches = nets.as_slice()[faces].to_vec();
    Ok((Topology::from_faces(count, &corners)?, FaceMap::from_vec(patches)))
}
