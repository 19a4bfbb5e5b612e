//! On bad meshes the refined method never folds more patches than the published one, stays exactly
//! smooth, and says which patches it took back.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test with figures for people")]

use smoothpatch::basemesh::{
    EdgeId, FieldTarget, PolygonizeSettings, SimplifySettings, TriMesh, polygonize, simplify,
};
use smoothpatch::g1_triangular::EdgeWeights;
use smoothpatch::implicit::{ImplicitSurface, NamedShape};
use smoothpatch::measure::deviation;
use smoothpatch::{FieldSource, G1Surface, Method, Settings, Silent, fit_base_mesh};
use testkit::meshes::{Edit, apply_edits, icosphere, jittered, on_surface, torus_grid};

fn fit(field: &dyn ImplicitSurface, mesh: &TriMesh, method: Method) -> (G1Surface, usize) {
    let settings = Settings::with_faces(0).with_method(method);
    let surface = fit_base_mesh(field, mesh.clone(), &settings, &mut Silent).unwrap();
    let diagonal = mesh.diagonal();
    let source = FieldSource::new(field, diagonal, settings.projection);
    let folds = deviation(&surface.patches.nets, &source, diagonal).0.folded.len();
    (surface, folds)
}

/// What rounding the coordinates alone contributes to a residual in chord lengths: much for an
/// edge of 1e-5 in a mesh of size 1.
fn round_off(mesh: &TriMesh, weights: &EdgeWeights, edge: EdgeId) -> f64 {
    let [a, b] = mesh.topology().edge_vertices(edge).map(|v| mesh.position(v));
    let amplification =
        weights.mu.iter().chain(&weights.lambda).map(|w| w.abs()).fold(1.0, f64::max);
    10.0 * f64::EPSILON * a.length() / a.distance(b) * amplification
}

/// Fits both ways, compares, and returns how many patches were taken back.
fn compare(name: &str, field: &dyn ImplicitSurface, mesh: &TriMesh) -> usize {
    let (published, published_folds) = fit(field, mesh, Method::Published);
    let (refined, refined_folds) = fit(field, mesh, Method::Refined);
    let taken_back = refined.retreats.as_slice().iter().flatten().count();
    println!(
        "{name}: {} faces, folds {published_folds} published, {refined_folds} refined, \
         {taken_back} taken back",
        mesh.topology().face_count()
    );
    assert!(refined_folds <= published_folds, "{name}: {refined_folds} > {published_folds}");
    assert!(published.retreats.as_slice().iter().all(Option::is_none), "{name}");
    // end data of an edge that needs the fallback, or that turns far, may contradict each other
    let sound = |e: &EdgeId| {
        !refined.curves[*e].status.is_fallback() && turning_deg(field, mesh, *e) < 70.0
    };
    for edge in mesh.topology().edges().filter(sound) {
        let residual = refined.patches.edge_residual(mesh, &refined.network, edge).unwrap();
        let round_off = round_off(mesh, &refined.patches.weights[edge], edge);
        let mut bound = 1e-12 + round_off;
        // weights above a thousand, at slivers, cost both methods the same digits
        let weights = &refined.patches.weights[edge];
        if weights.mu.iter().chain(&weights.lambda).any(|w| w.abs() > 1e3) {
            let same = published.patches.edge_residual(mesh, &published.network, edge).unwrap();
            bound = bound.max(2.0 * same);
        }
        assert!(residual <= bound, "{name}: {edge:?} {residual:e} > {bound:e}");
    }
    // every fallback is counted
    let fallbacks = refined.curves.iter().filter(|(_, curve)| curve.status.is_fallback()).count();
    assert_eq!(refined.curve_summary().fallbacks, fallbacks, "{name}");
    taken_back
}

/// Marched meshes as they come: slivers, and vertices beside the surface.
#[test]
fn marched_meshes() {
    for (name, cells) in [("double-torus", 24), ("deccube", 50)] {
        let shape = NamedShape::find(name).unwrap();
        let field = shape.field();
        let settings = PolygonizeSettings::with_cells(cells);
        let mesh = polygonize(&*field, &shape.region, &settings).unwrap();
        compare(name, &*field, &mesh);
    }
}

/// Decimation by quadric error alone, without any guard or improvement.
#[test]
fn unguarded_decimation() {
    let mut taken_back = 0;
    for (name, faces) in
        [("double-torus", 900), ("mcmullen", 700), ("deccube", 3000), ("chair", 2000)]
    {
        let shape = NamedShape::find(name).unwrap();
        let field = shape.field();
        let dense =
            polygonize(&*field, &shape.region, &PolygonizeSettings::with_cells(64)).unwrap();
        let target =
            FieldTarget::new(&*field, dense.diagonal(), Settings::with_faces(0).projection);
        let settings = SimplifySettings {
            plain_factor: 1,
            relaxation_iterations: 0,
            exchange_rounds: 0,
            rounds: 0,
            max_turning_deg: 180.0,
            min_quality: 0.0,
            ..SimplifySettings::to_faces(faces)
        };
        let mesh = simplify(dense, &target, &settings).unwrap().mesh;
        taken_back += compare(name, &*field, &mesh);
    }
    assert!(taken_back > 0, "no mesh was bad enough to try the guard");
}

/// Vertices moved at random until the surface turns by more than 60° along an edge.
#[test]
fn jitter_of_sixty_degrees() {
    let shape = NamedShape::find("torus").unwrap();
    let field = shape.field();
    for seed in 0..3 {
        let grid = torus_grid([5.0, 1.0], 20, 10);
        let jitter = |amount| on_surface(&jittered(&grid, amount, seed), &*field).unwrap();
        let turns = |mesh: &TriMesh| largest_turning_deg(&*field, mesh) > 60.0;
        let amounts = (1..=20).map(|step| 0.05 * f64::from(step));
        let mesh = amounts.map(jitter).find(turns).expect("a tenth of a turn is 36°");
        compare("jittered torus", &*field, &mesh);
    }
}

fn turning_deg(field: &dyn ImplicitSurface, mesh: &TriMesh, edge: EdgeId) -> f64 {
    let normal = |v| field.value_gradient(mesh.position(v)).1.normalize();
    let [n, m] = mesh.topology().edge_vertices(edge).map(normal);
    n.cross(m).length().atan2(n.dot(m)).to_degrees()
}

fn largest_turning_deg(field: &dyn ImplicitSurface, mesh: &TriMesh) -> f64 {
    mesh.topology().edges().map(|edge| turning_deg(field, mesh, edge)).fold(0.0, f64::max)
}

/// Good base meshes after random collapses: high valences, slivers, faces that lean.
#[test]
fn random_collapses() {
    let torus = NamedShape::find("torus").unwrap().field();
    let sphere = NamedShape::find("sphere").unwrap().field();
    let grid = torus_grid([5.0, 1.0], 20, 10);
    for seed in 0..4_usize {
        let collapses = |count: usize| -> Vec<Edit> {
            (0..count).map(|i| Edit::Collapse((i + 1) * 7919 + seed * 104_729)).collect()
        };
        compare("collapsed torus", &*torus, &apply_edits(grid.clone(), &collapses(12), 0.0));
        compare("collapsed sphere", &*sphere, &apply_edits(icosphere(2), &collapses(12), 0.0));
    }
}
