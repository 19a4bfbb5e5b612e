//! G1 splines over meshes.

use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{FaceMap, FieldTarget, TriMesh};
use smoothpatch::bezier_core::{MultiIndex, SepticTriangle};
use smoothpatch::implicit::{ProjectionSettings, Sphere, Torus};
use smoothpatch::measure::deviation;
use smoothpatch::mesh_surface::{
    MeshBase, MeshSource, MeshSurfaceError, SharpMesh, fit_mesh_field, mesh_distances, mesh_field,
};
use smoothpatch::meshfield::{JetSettings, MeshField, sharp_edges, subdivided};
use smoothpatch::{Distance, G1Surface, Report, Settings, Silent, Tolerance, report, report_sharp};
use testkit::meshes::{icosphere, torus_grid};

fn field(mesh: TriMesh) -> MeshField {
    mesh_field(mesh, &JetSettings::default(), 60_f64.to_radians()).expect("a smooth mesh")
}

fn fit(field: &MeshField, base: MeshBase, faces: usize) -> G1Surface {
    fit_mesh_field(field, base, &Settings::with_faces(faces), &mut Silent).expect("a surface")
}

fn check_smooth(field: &MeshField, surface: &G1Surface) {
    let source = MeshSource::new(field, Settings::with_faces(0).projection);
    let (report, _) = report(surface, &source, &mut Silent);
    assert!(report.continuity.g1_angle_deg < 1e-9, "{:?}", report.continuity);
    assert!(report.row_residual < 1e-12, "{}", report.row_residual);
    let failures = (report.deviation.folded.len(), report.deviation.failed_samples);
    assert_eq!(failures, (0, 0), "folds and samples without foot");
}

/// Largest distance from the torus, over the diagonal.
fn from_torus(surface: &G1Surface, torus: &Torus) -> f64 {
    let diagonal = surface.mesh.diagonal();
    let target = FieldTarget::new(torus, diagonal, ProjectionSettings::default());
    deviation(&surface.patches.nets, &target, diagonal).0.max
}

#[test]
fn kept_vertices_are_met_and_the_torus_is_close() {
    let torus = Torus { major_radius: 3.0, minor_radius: 1.0 };
    let mut errors = Vec::new();
    for n in [20, 40] {
        let field = field(torus_grid([3.0, 1.0], 2 * n, n));
        let surface = fit(&field, MeshBase::Keep, 0);
        check_smooth(&field, &surface);
        assert_eq!(surface.mesh, *field.mesh(), "all triangles become patches");
        let distances = mesh_distances(field.mesh(), &surface.patches.nets);
        assert!(distances.vertices.max < 1e-14, "{distances:?}");
        errors.push(from_torus(&surface, &torus));
    }
    let order = (errors[0] / errors[1]).log2();
    assert!(order > 3.5, "order {order:.2} of {errors:?}");
    assert!(errors[1] < 1e-4, "{errors:?}");
}

/// A spline of so many faces over a mesh of 1600.
fn from_1600_to(faces: usize) {
    let torus = Torus { major_radius: 3.0, minor_radius: 1.0 };
    let field = field(torus_grid([3.0, 1.0], 40, 20));
    let surface = fit(&field, MeshBase::Faces, faces);
    check_smooth(&field, &surface);
    assert_eq!(surface.mesh.topology().face_count(), faces, "faces");
    assert!(from_torus(&surface, &torus) < 3e-4, "{}", from_torus(&surface, &torus));
}

#[test]
fn fewer_faces_than_the_mesh_has() {
    from_1600_to(300);
}

#[test]
#[ignore = "a minute without optimisation: cargo test --release -p smoothpatch -- --ignored more_faces"]
fn more_faces_than_the_mesh_has() {
    from_1600_to(2000);
}

#[test]
fn a_tolerance() {
    let field = field(icosphere(3));
    let tolerance = Tolerance { distance: Distance::Relative(1e-4), normal_deg: None };
    let surface = fit(&field, MeshBase::Tolerance(tolerance), 0);
    check_smooth(&field, &surface);
    assert!(surface.origin.adaptation.is_some_and(|adaptation| adaptation.met));
    assert!(surface.mesh.topology().face_count() < 200, "few patches are enough");
}

#[test]
fn what_is_not_smooth_is_refused_with_its_edges() {
    let jets = JetSettings::default();
    let octahedron = icosphere(0);
    let error = mesh_field(octahedron.clone(), &jets, 0.5).expect_err("an icosahedron is sharp");
    let MeshSurfaceError::Creases { edges, largest_deg, .. } = &error else { panic!("{error}") };
    assert_eq!(edges.len(), octahedron.topology().edge_count());
    assert!((largest_deg - 41.8).abs() < 0.1, "{largest_deg}");

    let whole = icosphere(2);
    let faces = whole.face_indices()[1..].to_vec();
    let open = TriMesh::new(whole.positions().as_slice().to_vec(), &faces).expect("a mesh");
    let error = mesh_field(open, &jets, 1.0).expect_err("a hole").to_string();
    assert!(error.starts_with("the mesh is open: 3 edges have one face only, "), "{error}");
}

/// A mesh with sharp edges, fitted and measured.
fn fit_sharp(mesh: TriMesh, crease_deg: f64) -> (G1Surface, Report) {
    let sharp = sharp_edges(&mesh, crease_deg.to_radians());
    let sharp = SharpMesh::new(mesh, &sharp, &JetSettings::default()).expect("pieces");
    let settings = Settings::with_faces(0);
    let surface = sharp.fit(&settings, &mut Silent).expect("a surface");
    let (report, _) = report_sharp(&surface, &sharp, &settings, &mut Silent);
    (surface, report)
}

/// Exactly smooth but along sharp edges, where both patches have the same bits.
fn check_sharp(report: &Report, creases: usize) {
    let joined = &report.continuity;
    assert_eq!(joined.sharp_edges, creases, "creases");
    assert!(joined.g1_angle_deg < 1e-9, "{joined:?}");
    assert_eq!(joined.position_gap, 0.0, "no gaps, bit for bit");
    assert!(report.row_residual < 1e-12, "{}", report.row_residual);
    assert_eq!(report.deviation.folded.len(), 0, "folds");
    assert_eq!(report.deviation.failed_samples, 0, "samples without foot");
}

#[test]
fn a_block_keeps_its_edges_and_flat_faces() {
    let mesh = testkit::meshes::l_block();
    let euler = mesh.topology().euler_characteristic();
    let (surface, report) = fit_sharp(mesh, 60.0);
    let creases = surface.rim.as_ref().expect("a rim").creases.len();
    check_sharp(&report, creases);
    assert!(creases > 18 && report.continuity.closed, "{creases} creases");
    assert_eq!(report.continuity.euler_characteristic, euler);
    assert!(report.deviation.max < 1e-14, "{}", report.deviation.max);
    assert!((report.continuity.sharp_angle_deg - 90.0).abs() < 1e-9);
}

#[test]
fn half_a_sphere_is_open_and_close_to_the_sphere() {
    let whole = icosphere(3);
    let is_upper =
        |face: &[usize; 3]| face.iter().all(|&v| whole.positions().as_slice()[v].z > -0.2);
    let faces: Vec<[usize; 3]> = whole.face_indices().into_iter().filter(is_upper).collect();
    let mut used: Vec<usize> = faces.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let faces: Vec<[usize; 3]> =
        faces.iter().map(|face| face.map(|v| used.binary_search(&v).expect("used"))).collect();
    let positions = used.iter().map(|&v| whole.positions().as_slice()[v]).collect();
    let (surface, report) = fit_sharp(TriMesh::new(positions, &faces).expect("a mesh"), 60.0);
    check_sharp(&report, 0);
    let joined = &report.continuity;
    assert!(!joined.closed && joined.euler_characteristic == 1, "{joined:?}");
    let exact = Sphere::default();
    let target = FieldTarget::new(&exact, surface.mesh.diagonal(), ProjectionSettings::default());
    // the rim runs to and fro and is no circle
    let distance = deviation(&surface.patches.nets, &target, surface.mesh.diagonal()).0.max;
    assert!(distance < 1e-2, "{distance}");
}

#[test]
#[ignore = "minutes without optimisation: cargo test --release -p smoothpatch -- --ignored spot"]
#[cfg(feature = "io")]
fn spot_is_smooth_with_all_its_vertices() {
    use smoothpatch::io::read_mesh_file;
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/meshes/spot_triangulated.obj");
    let mesh = read_mesh_file(file).expect("spot").mesh;
    let field = mesh_field(mesh, &JetSettings::default(), 80_f64.to_radians()).expect("smooth");
    let surface = fit(&field, MeshBase::Keep, 0);
    check_smooth(&field, &surface);
    assert_eq!(surface.curve_summary().fallbacks, 0, "curves");
}

#[test]
fn cut_triangles_are_the_same_surface() {
    let mesh = torus_grid([3.0, 1.0], 12, 6);
    let cut = subdivided(&mesh);
    assert_eq!(cut.topology().face_count(), 4 * mesh.topology().face_count());
    assert_eq!(cut.topology().euler_characteristic(), 0);
    assert!(cut.topology().is_closed());
}

/// A flat patch over the unit triangle; points above it, and beside its edges and corners.
#[test]
fn distances_of_points_beside_a_patch() {
    let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::Y];
    // flat, but not with the regular parameters
    let net = SepticTriangle::from_fn(|MultiIndex { i, j, k }| {
        let [u, v, w] = [i, j, k].map(|n| n as f64 / 7.0);
        let bend = 0.3 * u * v * w;
        a * (u - bend) + b * (v + bend) + c * w
    });
    let nets = FaceMap::from_vec(vec![net]);
    let points = [
        (DVec3::new(0.3, 0.2, 0.5), 0.5),
        (DVec3::new(0.4, -0.25, 0.0), 0.25),
        (DVec3::new(0.75, 0.75, 0.0), 0.5 / 2.0_f64.sqrt()),
        (DVec3::new(-0.3, -0.4, 1.2), 1.3),
        (DVec3::new(0.1, 0.1, 0.0), 0.0),
        (DVec3::new(0.6, 0.3, 0.0), 0.0),
    ];
    for (point, expected) in points {
        let [p, q, r] = [point, point + DVec3::X * 1e-9, point + DVec3::Y * 1e-9];
        let mesh = TriMesh::new(vec![p, q, r], &[[0, 1, 2]]).expect("a small triangle");
        let found = mesh_distances(&mesh, &nets);
        let distance = found.vertices.max * found.diagonal;
        assert!((distance - expected).abs() < 1e-8, "{point}: {distance}, not {expected}");
    }
}
