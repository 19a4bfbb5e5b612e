//! From meshes with normals to rational A-patches, their figures and their files.

#![cfg(feature = "io")]
#![allow(clippy::unwrap_used, reason = "test helpers")]

use std::collections::BTreeMap;

use smoothpatch::FieldSource;
use smoothpatch::apatch::PatchKind;
use smoothpatch::apatch::rational::{Normals, RationalSurface, Settings, ShapeControl, Side};
use smoothpatch::apatch_surface::{
    NormalSource, RationalError, flat_gap, grid, joints, rational_surface, report, triangles,
};
use smoothpatch::basemesh::{FaceId, TriMesh};
use smoothpatch::implicit::{ImplicitSurface, ProjectionSettings, Torus};
use smoothpatch::io::{CellValues, Polygon, Polygons};
use testkit::meshes::{l_block, noisy_sphere, torus_grid};

const TORUS: Torus = Torus { major_radius: 2.0, minor_radius: 0.8 };

fn polygons(mesh: &TriMesh) -> Polygons {
    let faces = mesh.face_indices();
    Polygons {
        positions: mesh.positions().as_slice().to_vec(),
        normals: Vec::new(),
        corner_normals: vec![Polygon::triangle([None; 3]); faces.len()],
        faces: faces.into_iter().map(Polygon::triangle).collect(),
    }
}

fn over_torus(settings: &Settings) -> RationalSurface {
    let mesh = polygons(&torus_grid([2.0, 0.8], 16, 12));
    rational_surface(&mesh, NormalSource::Field(&TORUS), settings).unwrap()
}

#[test]
fn the_figures_of_patches_and_of_the_whole_agree() {
    let surface = over_torus(&Settings::default());
    let diagonal = surface.mesh().diagonal();
    let field: &dyn ImplicitSurface = &TORUS;
    let target = FieldSource::new(field, diagonal, ProjectionSettings::default());
    let (report, figures) = report(&surface, Some(&target));
    let (deviation, figures) = (report.deviation.unwrap(), figures.unwrap());
    let all = || figures.faces.as_slice().iter().chain(figures.edges.as_slice());
    let worst = all().map(|patch| patch.max).fold(0.0, f64::max);
    assert!((worst / diagonal - deviation.max).abs() < 1e-15, "patches and summary agree");
    // unit normals of another program on the same mesh: 2.0e-3
    assert!(worst > 5e-4 && worst < 3e-3, "distance {worst}");
    assert!(deviation.rms > 0.0 && deviation.rms < 0.5 * deviation.max, "{deviation:?}");
    assert_eq!((deviation.failed_samples, deviation.folded.len()), (0, 0));
    assert_eq!((report.faces, report.euler_characteristic, report.closed), (384, 0, true));
    assert_eq!((report.sheet.bad, report.joints.missing), (0, 0));
    assert!(report.sheet.transversals > 384 * 150, "{:?}", report.sheet);

    let mesh = surface.tessellate(4, 2);
    let cells = grid(&surface, &mesh, Some(&figures));
    assert_eq!(cells.cells.len(), mesh.triangles.len());
    assert_eq!(triangles(&mesh).triangles, mesh.triangles);
    let data = |name: &str| &cells.cell_data.iter().find(|data| data.name == name).unwrap().values;
    let CellValues::Float64(distances) = data("deviation") else { panic!("no numbers") };
    let largest = distances.iter().copied().fold(0.0, f64::max);
    assert!((largest - deviation.max).abs() < 1e-15, "cells and summary agree");
    let CellValues::Int64(kinds) = data("patch_kind") else { panic!("no integers") };
    assert!(kinds.contains(&(PatchKind::NonconvexFace as i64)), "the torus has both kinds");
}

/// Heights of normals over edges that are not small, taken for zero: the function is then not smooth.
#[test]
fn a_broken_joint_is_seen() {
    let good = joints(&over_torus(&Settings::default()));
    assert!(good.compared > 10_000, "{good:?}");
    assert!(good.value_jump <= 1e-13 && good.gradient_jump <= 1e-12, "{good:?}");
    assert!(good.normal_angle <= 1e-10 && good.gap <= 1e-13, "{good:?}");
    let broken = joints(&over_torus(&Settings { straight: 0.05, ..Settings::default() }));
    assert!(broken.gradient_jump > 1e-3, "{broken:?}");
}

#[test]
fn tensions_belong_to_the_faces_that_are_given() {
    let build = |faces: &[(usize, f64)]| {
        let faces: BTreeMap<usize, f64> = faces.iter().copied().collect();
        let settings =
            Settings { shape: ShapeControl { tension: 0.0, faces }, ..Settings::default() };
        let mesh = polygons(&l_block());
        rational_surface(&mesh, NormalSource::Estimate, &settings).unwrap()
    };
    let (plain, tensed) = (build(&[]), build(&[(3, 2.0)]));
    assert_eq!(tensed.report().loop_steps, 1, "{:?}", tensed.report());
    let weights = |surface: &RationalSurface, face| {
        Side::BOTH.map(|side| surface.free_weight(FaceId::new(face), side))
    };
    for face in 0..plain.mesh().topology().face_count() {
        let same = weights(&plain, face) == weights(&tensed, face);
        assert_eq!(same, face / 4 != 3, "part {face}");
    }
    let mesh = polygons(&l_block());
    let shape = ShapeControl { tension: 0.0, faces: [(28, 1.0)].into() };
    let settings = Settings { shape, ..Settings::default() };
    let refused = rational_surface(&mesh, NormalSource::Estimate, &settings).unwrap_err();
    assert!(refused.to_string().contains("only 28 faces"), "{refused}");
}

#[test]
fn normals_of_files_are_those_of_vertices() {
    let mesh = noisy_sphere(0.0, 1);
    let mut file = polygons(&mesh);
    // every corner has its own copy, with other digits at the end
    for (face, normals) in file.faces.iter().zip(&mut file.corner_normals) {
        let first = file.normals.len();
        file.normals.extend(
            face.corners().iter().enumerate().map(|(corner, &v)| {
                file.positions[v] * (1.0 + 1e-8 * (first + corner) as f64 / 1e3)
            }),
        );
        *normals = Polygon::triangle([0, 1, 2].map(|corner| Some(first + corner)));
    }
    let settings = Settings::default();
    let surface = rational_surface(&file, NormalSource::File, &settings).unwrap();
    let given = Normals::Given(mesh.positions().clone());
    let expected = RationalSurface::new(mesh, given, &settings).unwrap();
    let [a, b] = [&surface, &expected].map(|s| s.tessellate(3, 2).positions);
    assert!(a.iter().zip(&b).all(|(p, q)| p.distance(*q) < 1e-6), "another surface");

    file.normals[4] = -file.normals[4];
    let refused = rational_surface(&file, NormalSource::File, &settings).unwrap_err();
    assert!(matches!(refused, RationalError::SeveralNormals { .. }), "{refused}");
}

/// By four where parameters run evenly, by less beside the curves where the surface crosses its faces.
#[test]
fn smaller_flat_triangles_come_closer() {
    let surface = over_torus(&Settings::default());
    let [coarse, fine] = [4, 8].map(|n| flat_gap(&surface, n, n / 2));
    assert!(coarse < 0.01 && fine > 0.0, "{coarse} {fine}");
    assert!((2.0..5.0).contains(&(coarse / fine)), "{coarse} {fine}");
}
