//! G1 splines over meshes from files, and the orders of the jets they start from.

use anyhow::Result;
use smoothpatch::basemesh::{FieldTarget, TriMesh};
use smoothpatch::implicit::{ImplicitSurface, ProjectionSettings, Sphere, Torus, surface_point};
use smoothpatch::io::read_mesh_file;
use smoothpatch::measure::deviation;
use smoothpatch::mesh_surface::{
    MeshBase, MeshSource, SharpMesh, fit_mesh_field, mesh_distances, mesh_field,
};
use smoothpatch::meshfield::{JetSettings, fit_jets, sharp_edges};
use smoothpatch::{Settings, Silent, report, report_sharp};
use testkit::meshes::{l_block, torus_grid};

use super::{Case, Measured};
use crate::check::Check;

const SCHEME: &str = "mesh to G1";
const CREASE_ANGLE: f64 = 80.0 * std::f64::consts::PI / 180.0;

pub(super) fn cases() -> Vec<Case> {
    vec![
        Case::new("sphere, STL of 1280", SCHEME, |_| {
            let expected = Expected { euler: 2, vertices: 1e-7, triangles: 4e-3 };
            let exact = Sphere::default();
            fitted("sphere_1280.stl", MeshBase::Keep, Some((&exact, 1e-5)), &expected)
        }),
        Case::new("torus, PLY of 2304", SCHEME, |_| {
            let expected = Expected { euler: 0, vertices: 4e-4, triangles: 2e-3 };
            let exact = Torus { major_radius: 3.0, minor_radius: 1.0 };
            fitted("torus_48x24.ply", MeshBase::Faces, Some((&exact, 2e-4)), &expected)
        }),
        Case::new("block with creases", SCHEME, |_| block()),
        Case::new("torus 5, 1", "jets", |_| jets()),
    ]
}

/// What a fit must reach.
struct Expected {
    euler: i64,
    /// Largest distances of the input vertices and of samples on the input triangles, over the diagonal.
    vertices: f64,
    triangles: f64,
}

/// Patches asked for, where not all triangles are kept.
const FACES: usize = 600;

/// A mesh of `fixtures/meshes`, fitted; compared with the exact surface and a bound over the diagonal.
fn fitted(
    name: &str,
    base: MeshBase,
    exact: Option<(&dyn ImplicitSurface, f64)>,
    expected: &Expected,
) -> Result<Measured> {
    let mesh = read_mesh_file(crate::root().join("fixtures/meshes").join(name))?.mesh;
    let diagonal = mesh.diagonal();
    let field = mesh_field(mesh, &JetSettings::default(), CREASE_ANGLE)?;
    let settings = Settings::with_faces(FACES);
    let surface = fit_mesh_field(&field, base, &settings, &mut Silent)?;
    let source = MeshSource::new(&field, settings.projection);
    let (report, _) = report(&surface, &source, &mut Silent);
    let distances = mesh_distances(field.mesh(), &surface.patches.nets);
    let joined = &report.continuity;
    let count = |n: usize| i64::try_from(n).expect("invariant: counts fit 32 bits");
    let mut measured = Measured {
        faces: joined.faces,
        euler: joined.euler_characteristic,
        kink: Some(joined.g1_angle_deg.to_radians()),
        deviation: Some(report.deviation.max),
        order: None,
        checks: vec![
            Check::exactly("Euler characteristic", joined.euler_characteristic, expected.euler),
            Check::at_most("G1 angle, degrees", joined.g1_angle_deg, 1e-9),
            Check::at_most("row residual", report.row_residual, 1e-12),
            Check::exactly("folds", count(report.deviation.folded.len()), 0),
            Check::exactly("samples without foot", count(report.deviation.failed_samples), 0),
            Check::at_most("input vertices", distances.vertices.max, expected.vertices),
            Check::at_most("input triangles", distances.triangle_samples.max, expected.triangles),
        ],
    };
    if let Some((exact, bound)) = exact {
        let target = FieldTarget::new(exact, diagonal, ProjectionSettings::default());
        let (from_exact, _) = deviation(&surface.patches.nets, &target, diagonal);
        measured.deviation = Some(from_exact.max);
        measured.checks.push(Check::at_most(
            "distance from the exact surface",
            from_exact.max,
            bound,
        ));
    }
    Ok(measured)
}

/// A block of cubes: flat faces, C0 along all creases, one closed surface.
fn block() -> Result<Measured> {
    let mesh = l_block();
    let euler = mesh.topology().euler_characteristic();
    let sharp = sharp_edges(&mesh, CREASE_ANGLE);
    let creases = sharp.creases.len();
    let sharp = SharpMesh::new(mesh, &sharp, &JetSettings::default())?;
    let settings = Settings::with_faces(0);
    let surface = sharp.fit(&settings, &mut Silent)?;
    let (report, _) = report_sharp(&surface, &sharp, &settings, &mut Silent);
    let joined = &report.continuity;
    let count = |n: usize| i64::try_from(n).expect("invariant: counts fit 32 bits");
    Ok(Measured {
        faces: joined.faces,
        euler: joined.euler_characteristic,
        kink: Some(joined.g1_angle_deg.to_radians()),
        deviation: Some(report.deviation.max),
        order: None,
        checks: vec![
            Check::exactly("Euler characteristic", joined.euler_characteristic, euler),
            Check::exactly("C0 edges", count(joined.sharp_edges), count(creases)),
            Check::at_most("G1 angle of the others, degrees", joined.g1_angle_deg, 1e-9),
            Check::at_most("gap", joined.position_gap, 0.0),
            Check::at_most("deviation", report.deviation.max, 1e-14),
            Check::exactly("folds", count(report.deviation.folded.len()), 0),
        ],
    })
}

/// Orders of normals and curvatures, for all degrees, on tori of which the second has half the steps.
fn jets() -> Result<Measured> {
    let exact = Torus { major_radius: 5.0, minor_radius: 1.0 };
    let meshes = [1, 2].map(|k| torus_grid([5.0, 1.0], 100 * k, 32 * k));
    let mut measured = Measured { faces: meshes[1].topology().face_count(), ..Measured::default() };
    for degree in 2..=4 {
        let settings = JetSettings { degree, ..JetSettings::default() };
        let [coarse, fine] = [
            jet_errors(&meshes[0], &exact, &settings)?,
            jet_errors(&meshes[1], &exact, &settings)?,
        ];
        let [normals, forms] = [0, 1].map(|k| f64::log2(coarse[k] / fine[k]));
        let d = degree as f64;
        measured.checks.extend([
            Check::at_least(format!("order of normals, degree {degree}"), normals, d - 0.3),
            Check::at_least(format!("order of curvatures, degree {degree}"), forms, d - 1.3),
        ]);
        measured.order = Some(normals);
    }
    Ok(measured)
}

/// Largest errors of normals and of entries of the second fundamental form at the vertices.
fn jet_errors(
    mesh: &TriMesh,
    exact: &dyn ImplicitSurface,
    settings: &JetSettings,
) -> Result<[f64; 2]> {
    let jets = fit_jets(mesh, settings)?;
    let mut errors = [0.0_f64; 2];
    for (vertex, jet) in jets.iter() {
        let truth = surface_point(exact, mesh.position(vertex))?;
        let jet = jet.surface_jet().expect("invariant: a graph has a normal");
        let form = jet.second_fundamental_form - truth.second_fundamental_form;
        let entries = form.to_cols_array().into_iter().map(f64::abs);
        errors[0] = errors[0].max(jet.normal.distance(truth.normal));
        errors[1] = entries.fold(errors[1], f64::max);
    }
    Ok(errors)
}
