//! Random smooth surfaces, random base meshes: exactly smooth and interpolating, in both methods.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{TriMesh, VertexMap, edge_turning, invalid_fans, triangle_quality};
use smoothpatch::implicit::{ImplicitSurface, Torus, surface_point};
use smoothpatch::measure::{continuity, interpolation};
use smoothpatch::{G1Surface, Method, Settings, Silent, fit_base_mesh};
use testkit::fields::{Blend, Blob, Wave};
use testkit::meshes::{
    Edit, apply_edits, icosphere, jittered, on_surface, radially_on_surface, torus_grid,
};

/// Quality that every edit keeps, before the vertices are moved.
const EDITED_QUALITY: f64 = 0.35;
/// Slivers below this quality are left out: the weight functions of a patch with a corner of a few
/// degrees amplify round-off by the inverse of that angle, squared, and the bounds below would
/// measure the mesh instead of the construction.
const MIN_QUALITY: f64 = 0.15;
/// Edges whose normals turn by more, in degrees, are left out: there the solver may give up, and
/// says so by its status; see the tests of the fold guard.
const MAX_TURNING_DEG: f64 = 55.0;

fn blob() -> impl Strategy<Value = Blob> {
    let wave = (0.0..0.05, vector(2.5), 0.0..6.3).prop_map(|(amplitude, wave, phase)| Wave {
        amplitude,
        wave,
        phase,
    });
    let semi_axes = (0.7..1.4, 0.7..1.4, 0.7..1.4).prop_map(|(a, b, c)| DVec3::new(a, b, c));
    (semi_axes, prop::collection::vec(wave, 0..4), prop::array::uniform4(-0.1..0.1))
        .prop_map(|(semi_axes, waves, cubic)| Blob { semi_axes, waves, cubic })
}

fn blend() -> impl Strategy<Value = Blend> {
    prop::collection::vec(vector(0.4), 1..4).prop_map(|centers| Blend { centers })
}

fn vector(largest: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-largest..largest).prop_map(DVec3::from_array)
}

/// Edits, jitter over the shortest edge, and its seed.
type Disturbance = (Vec<Edit>, f64, u64);

fn disturbance() -> impl Strategy<Value = Disturbance> {
    let edit = (any::<bool>(), 0..10_000_usize).prop_map(|(flip, number)| match flip {
        true => Edit::Flip(number),
        false => Edit::Split(number),
    });
    (prop::collection::vec(edit, 0..80), 0.0..0.15, any::<u64>())
}

/// `regular` with the changes made and its vertices moved by `onto`; a mesh that is not usable is
/// made again with half the changes, up to five times.
fn disturbed(
    regular: &TriMesh,
    (edits, jitter, seed): &Disturbance,
    field: &dyn ImplicitSurface,
    onto: impl Fn(&TriMesh) -> Option<TriMesh>,
) -> Option<TriMesh> {
    (0..6_u32)
        .map(|halvings| edits.len() >> halvings)
        .zip([1.0, 0.5, 0.25, 0.125, 0.0625, 0.0])
        .find_map(|(count, part)| {
            let edited = apply_edits(regular.clone(), &edits[..count], EDITED_QUALITY);
            onto(&jittered(&edited, jitter * part, *seed)).filter(|mesh| is_usable(mesh, field))
        })
}

fn is_usable(mesh: &TriMesh, field: &dyn ImplicitSurface) -> bool {
    let t = mesh.topology();
    let normals = VertexMap::try_from_fn(t.vertex_count(), |v| {
        surface_point(field, mesh.position(v)).map(|p| p.normal)
    });
    let Ok(normals) = normals else { return false };
    invalid_fans(mesh, &normals).is_empty()
        && t.faces().all(|f| triangle_quality(mesh.triangle(f)) >= MIN_QUALITY)
        && t.edges().all(|e| edge_turning(mesh, &normals, e).to_degrees() <= MAX_TURNING_DEG)
}

/// Largest coefficient of the smoothness condition, over the size of the edge's weight functions:
/// the round-off of an affine combination grows with them.
fn relative_row_residual(surface: &G1Surface) -> f64 {
    let edges = surface.mesh.topology().edges();
    let relative = edges.map(|edge| {
        let weights = &surface.patches.weights[edge];
        let size = weights.lambda.iter().chain(&weights.mu).fold(1.0, |s: f64, w| s.max(w.abs()));
        surface.patches.edge_residual(&surface.mesh, &surface.network, edge).unwrap() / size
    });
    relative.fold(0.0, f64::max)
}

fn check(field: &dyn ImplicitSurface, mesh: &TriMesh) -> TestCaseResult {
    for method in [Method::Published, Method::Refined] {
        let settings = Settings::with_faces(0).with_method(method);
        let surface = fit_base_mesh(field, mesh.clone(), &settings, &mut Silent)
            .map_err(|error| TestCaseError::fail(format!("{method:?}: {error}")))?;
        let residual = relative_row_residual(&surface);
        prop_assert!(residual <= 1e-12, "{method:?}: row residual {residual:e}");
        let joined = continuity(surface.mesh.topology(), &surface.patches.nets);
        prop_assert!(joined.closed && joined.position_gap <= 0.0, "{method:?}: {joined:?}");
        prop_assert!(joined.g1_angle_deg <= 1e-9, "{method:?}: {joined:?}");
        let defects = interpolation(&surface);
        prop_assert!(defects.position <= 0.0, "{method:?}: {defects:?}");
        prop_assert!(defects.normal.max(defects.second_form) <= 1e-10, "{method:?}: {defects:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 10,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn disturbed_ellipsoids(field in blob(), change in disturbance()) {
        let onto = |mesh: &TriMesh| Some(radially_on_surface(mesh, &field, 4.0));
        let mesh = disturbed(&icosphere(2), &change, &field, onto);
        prop_assume!(mesh.is_some());
        check(&field, &mesh.unwrap())?;
    }

    #[test]
    fn blended_balls(field in blend(), change in disturbance()) {
        let onto = |mesh: &TriMesh| Some(radially_on_surface(mesh, &field, 4.0));
        let mesh = disturbed(&icosphere(2), &change, &field, onto);
        prop_assume!(mesh.is_some());
        check(&field, &mesh.unwrap())?;
    }

    #[test]
    fn tori(minor_radius in 0.7..1.3, change in disturbance()) {
        let field = Torus { major_radius: 3.0, minor_radius };
        let grid = torus_grid([3.0, minor_radius], 20, 10);
        let mesh = disturbed(&grid, &change, &field, |mesh| on_surface(mesh, &field));
        prop_assume!(mesh.is_some());
        check(&field, &mesh.unwrap())?;
    }
}
