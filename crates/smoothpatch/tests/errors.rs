//! Meshes and surfaces that cannot be fitted: an error that names the place, never NaN.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{MeshError, TriMesh};
use smoothpatch::hermite_sqp::EdgeProblemError;
use smoothpatch::implicit::{Formula, ImplicitSurface, Sphere};
use smoothpatch::{FitError, G1Surface, Method, Settings, Silent, fit_base_mesh};
use testkit::meshes::icosphere;

fn fit(field: &dyn ImplicitSurface, mesh: TriMesh, method: Method) -> Result<G1Surface, FitError> {
    let settings = Settings::with_faces(0).with_method(method);
    fit_base_mesh(field, mesh, &settings, &mut Silent)
}

/// The error, which must be the same in both methods.
fn refuse(field: &dyn ImplicitSurface, mesh: &TriMesh) -> FitError {
    let [error, other] = [Method::Published, Method::Refined]
        .map(|method| fit(field, mesh.clone(), method).expect_err("no surface can be fitted"));
    assert_eq!(error.to_string(), other.to_string(), "both methods say the same");
    error
}

/// The unit sphere's mesh shifted so that this vertex lies at the origin.
fn with_vertex_at_origin(vertex: usize) -> TriMesh {
    let mesh = icosphere(1);
    let shift = mesh.positions().as_slice()[vertex];
    let positions = mesh.positions().map(|_, &p| p - shift);
    mesh.with_positions(positions).unwrap()
}

#[test]
fn the_apex_of_a_cone() {
    let cone = Formula::parse("x^2 + y^2 - z^2").unwrap();
    match refuse(&cone, &with_vertex_at_origin(7)) {
        FitError::Singular { vertex: 7, at } => assert_eq!(at, DVec3::ZERO),
        other => panic!("{other}"),
    }
}

#[test]
fn undefined_values_and_derivatives() {
    // not a number on one side, and without a derivative at the border
    for text in ["x^2 + y^2 + z^2 - 1 + 0*sqrt(z + 0.2)", "x^2 + y^2 + z^2 - 1 + 0*ln(z + 0.2)"] {
        let field = Formula::parse(text).unwrap();
        match refuse(&field, &icosphere(1)) {
            FitError::Singular { at, .. } => assert!(at.z < -0.2, "{text}: {at}"),
            other => panic!("{text}: {other}"),
        }
    }
}

#[test]
fn an_open_mesh_is_smooth_inside() {
    let closed = icosphere(1);
    let mut faces = closed.face_indices();
    faces.pop();
    let open = TriMesh::new(closed.positions().as_slice().to_vec(), &faces).unwrap();
    for method in [Method::Published, Method::Refined] {
        let surface = fit(&Sphere::default(), open.clone(), method).unwrap();
        let joined = smoothpatch::measure::continuity(open.topology(), &surface.patches.nets);
        assert!(!joined.closed && joined.g1_angle_deg < 1e-9, "{joined:?}");
    }
}

#[test]
fn coinciding_vertices() {
    let mesh = icosphere(1);
    let [a, b] = mesh.topology().edge_vertices(mesh.topology().edges().nth(20).unwrap());
    let mut positions = mesh.positions().clone();
    positions[b] = positions[a];
    let mesh = mesh.with_positions(positions).unwrap();
    match refuse(&Sphere::default(), &mesh) {
        FitError::Edge { a: start, b: end, reason: EdgeProblemError::NoChord, .. } => {
            assert_eq!([start, end], [a.index(), b.index()]);
        }
        other => panic!("{other}"),
    }
}

#[test]
fn positions_that_are_not_finite_make_no_mesh() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mesh = icosphere(0);
        let mut positions = mesh.positions().as_slice().to_vec();
        positions[5].y = bad;
        let refused = TriMesh::new(positions, &mesh.face_indices());
        assert!(matches!(refused, Err(MeshError::NotFinite { vertex: 5, .. })), "{refused:?}");
    }
}
