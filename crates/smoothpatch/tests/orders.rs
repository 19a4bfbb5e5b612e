//! Observed orders of approximation on small meshes: edges halve from level to level.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test with figures for people")]

use smoothpatch::basemesh::{SurfaceTarget, TriMesh};
use smoothpatch::hermite_sqp::CurveRefinement;
use smoothpatch::implicit::{ImplicitSurface, Sphere, Torus};
use smoothpatch::measure::deviation;
use smoothpatch::{FieldSource, Method, Settings, Silent, fit_base_mesh};
use testkit::meshes::{icosphere, jittered, on_surface, torus_grid};

/// Largest deviations over the diagonal: of the curves, of the patches, and of their normals.
fn errors(field: &dyn ImplicitSurface, mesh: TriMesh, method: Method) -> [f64; 3] {
    let mut settings = Settings::with_faces(0).with_method(method);
    // the same curves in both methods: what refinement gains shrinks with the edges
    settings.curve_refinement = CurveRefinement::None;
    let surface = fit_base_mesh(field, mesh, &settings, &mut Silent).unwrap();
    let diagonal = surface.mesh.diagonal();
    let target = FieldSource::new(field, diagonal, settings.projection);
    let on_curves = surface.network.curves().as_slice().iter().flat_map(|curve| {
        (1..20).map(|j| {
            let p = curve.eval(f64::from(j) / 20.0);
            p.distance(target.foot(p).unwrap().point) / diagonal
        })
    });
    let curves = on_curves.fold(0.0, f64::max);
    let (patches, _) = deviation(&surface.patches.nets, &target, diagonal);
    assert_eq!(patches.folded, Vec::<usize>::new(), "folded patches");
    [curves, patches.max, patches.max_normal_deg]
}

/// Orders between the last two of some levels.
fn orders(name: &str, levels: &[[f64; 3]]) -> [f64; 3] {
    let [coarse, fine] = [levels[levels.len() - 2], levels[levels.len() - 1]];
    let orders = std::array::from_fn(|i| (coarse[i] / fine[i]).log2());
    println!("{name}: errors {levels:?}, orders {orders:.2?}");
    orders
}

fn jittered_torus(levels: std::ops::RangeInclusive<usize>) -> (Torus, Vec<TriMesh>) {
    let field = Torus { major_radius: 2.0, minor_radius: 1.0 };
    let mesh = |level: usize| {
        let grid = torus_grid([2.0, 1.0], 16 << level, 8 << level);
        on_surface(&jittered(&grid, 0.1, 17), &field).unwrap()
    };
    (field, levels.map(mesh).collect())
}

#[test]
fn published_on_a_jittered_torus() {
    let (field, meshes) = jittered_torus(0..=2);
    let levels: Vec<_> = meshes.into_iter().map(|m| errors(&field, m, Method::Published)).collect();
    let [curves, position, _] = orders("published, torus", &levels);
    assert!(curves >= 5.5, "curves: {curves}");
    assert!(position >= 3.5, "position: {position}");
}

#[test]
fn refined_on_a_jittered_torus() {
    let (field, meshes) = jittered_torus(0..=2);
    let levels: Vec<_> = meshes.into_iter().map(|m| errors(&field, m, Method::Refined)).collect();
    let [curves, position, normals] = orders("refined, torus", &levels);
    assert!(curves >= 5.5, "curves: {curves}");
    assert!(position >= 5.0, "position: {position}");
    assert!(normals >= 4.0, "normals: {normals}");
}

#[test]
fn both_on_a_sphere() {
    let field = Sphere::default();
    for method in [Method::Published, Method::Refined] {
        let levels: Vec<_> =
            (1..=3).map(|level| errors(&field, icosphere(level), method)).collect();
        let orders = orders(&format!("{method:?}, sphere"), &levels);
        let expected = [5.5, 5.5, 4.5];
        assert!(orders.iter().zip(expected).all(|(o, e)| *o >= e), "{method:?}: {orders:?}");
    }
}
