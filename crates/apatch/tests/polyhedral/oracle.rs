//! The cube against numbers of an independent program.

use apatch::polyhedral::{Cell, PolyhedralSurface, Scheme};

use super::common::{index, list, number, read, settings, side, solid, vector};

/// The numbers have 12 digits after the point: they are off by up to 5e-13.
const TOLERANCE: f64 = 1e-12;

#[test]
fn the_cube() {
    let case = &read("reference")["cube"];
    let solids = read("solids");
    let surface =
        PolyhedralSurface::new(&solid(&solids["solids"]["cube"]), &settings(Scheme::C1Cubic))
            .unwrap();
    let hull = surface.hull();
    assert!(surface.report().is_clean(), "{:?}", surface.report());
    let base = list(&case["T_points"]).len();
    let mut points: Vec<_> = list(&case["T_points"]).iter().map(vector).collect();
    points.extend(list(&case["hull_points"]).iter().map(vector));
    assert_eq!(hull.points.len(), points.len(), "points of the hull");
    assert_eq!(hull.base_count(), base, "points of the triangulation");
    let same = |p: usize, q: usize| hull.points[p].distance(points[q]) <= TOLERANCE;
    let place = |q: usize| (0..points.len()).find(|&p| same(p, q));
    for (q, normal) in list(&case["T_normals"]).iter().enumerate() {
        let p = place(q).expect("a point of the triangulation");
        assert!(hull.normals[p].distance(vector(normal)) <= TOLERANCE, "normal {q}");
    }
    let tets = list(&case["tets"]);
    assert_eq!(hull.cells.len(), tets.len(), "tetrahedra");
    let mut cells = Vec::new();
    for (tet, weights) in tets.iter().zip(list(&case["cubic_weights"])) {
        let named: Vec<usize> =
            list(&tet["base"]).iter().chain(list(&tet["upper"])).map(index).collect();
        let wanted: Vec<usize> = named.iter().map(|&q| place(q).expect("a point")).collect();
        let cell = (0..hull.cells.len())
            .find(|&c| {
                let corners = hull.corners(hull.cells[c]);
                wanted.iter().all(|p| corners.contains(p))
            })
            .expect("a tetrahedron with these corners");
        assert_eq!(hull.cells[cell].side(), side(&tet["side"]), "side");
        let kind = matches!(hull.cells[cell], Cell::Face(..));
        assert_eq!(kind, tet["kind"] == "F", "kind");
        let corners = hull.corners(hull.cells[cell]);
        let indices = list(&case["multi_indices"]);
        for (multi, weight) in indices.iter().zip(list(weights)) {
            let of = |p: usize| wanted.iter().position(|&w| w == p).map_or(0, |k| index(&multi[k]));
            let own = corners.map(of);
            let at = indices
                .iter()
                .position(|m| (0..4).all(|k| index(&m[k]) == own[k]))
                .expect("an index");
            let found = surface.weights(cell)[at];
            let expected = number(weight);
            assert!((found - expected).abs() <= TOLERANCE, "{multi}: {found} is not {expected}");
        }
        cells.push((cell, wanted));
    }
    for sample in list(&case["samples"]) {
        let (cell, wanted) = &cells[index(&sample["tet"])];
        let corners = hull.corners(hull.cells[*cell]);
        let base = list(&sample["base"]);
        let upper = list(&sample["upper"]);
        let place = |p: usize| wanted.iter().position(|&w| w == p).unwrap_or(0);
        let foot = corners.map(|p| base.get(place(p)).map_or(0.0, number));
        let top =
            corners.map(|p| place(p).checked_sub(base.len()).map_or(0.0, |k| number(&upper[k])));
        let hit = surface.point(*cell, foot, top).expect("a point of the surface");
        assert!((hit.t - number(&sample["t"])).abs() <= 1e-11, "{sample}: {hit:?}");
        assert!(hit.point.distance(vector(&sample["point"])) <= 1e-11, "{sample}: {hit:?}");
        assert!(hit.normal().distance(vector(&sample["normal"])) <= 1e-11, "{sample}: {hit:?}");
    }
}
