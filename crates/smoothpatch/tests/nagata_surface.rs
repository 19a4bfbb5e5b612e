//! From meshes with normals to Nagata surfaces and their files.

#![cfg(feature = "io")]
#![allow(clippy::unwrap_used, reason = "test helpers")]

use std::f64::consts::PI;

use smoothpatch::FieldSource;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::implicit::{Formula, ProjectionSettings, Torus};
use smoothpatch::io::{GridCell, Polygon, Polygons};
use smoothpatch::nagata::{Continuity, NagataSurface, Settings, TangentPlanes};
use smoothpatch::nagata_surface::{
    NagataError, NormalSource, curved_grid, flat_gap, from_polygons, report, samples,
};

const RADII: [f64; 2] = [5.0, 1.0];

fn torus() -> Torus {
    Torus { major_radius: RADII[0], minor_radius: RADII[1] }
}

/// A grid of `2n` by `n` quadrilaterals on the torus.
fn grid(n: usize) -> Polygons {
    let point = |i: usize, j: usize| {
        let (a, b) = (PI * i as f64 / n as f64, 2.0 * PI * j as f64 / n as f64);
        let r = RADII[0] + RADII[1] * b.cos();
        DVec3::new(r * a.cos(), r * a.sin(), RADII[1] * b.sin())
    };
    let id = |i: usize, j: usize| (i % (2 * n)) * n + j % n;
    let all = || (0..2 * n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let quad = |(i, j)| Polygon::quad([id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]);
    Polygons {
        positions: all().map(|(i, j)| point(i, j)).collect(),
        normals: Vec::new(),
        faces: all().map(quad).collect(),
        corner_normals: vec![Polygon::quad([None; 4]); 2 * n * n],
    }
}

fn over_torus(polygons: &Polygons, settings: Settings) -> NagataSurface {
    from_polygons(polygons, NormalSource::Field(&torus()), settings).unwrap()
}

/// Largest distance from the torus over the minor radius.
fn deviation(surface: &NagataSurface) -> f64 {
    let field = torus();
    let diagonal = surface.mesh().diagonal();
    let target = FieldSource::new(&field, diagonal, ProjectionSettings::default());
    let (report, figures) = report(surface, Some(&target));
    let deviation = report.deviation.unwrap();
    let by_face = figures.deviation.unwrap();
    let worst = by_face.as_slice().iter().map(|face| face.max).fold(0.0, f64::max);
    assert!((worst / diagonal - deviation.max).abs() < 1e-15, "faces and summary agree");
    assert_eq!(deviation.failed_samples, 0, "every sample has a foot");
    assert_eq!((report.euler_characteristic, report.closed), (0, true), "a closed torus");
    assert!(report.folded.is_empty() && deviation.folded.is_empty(), "folds");
    deviation.max * diagonal / RADII[1]
}

#[test]
fn distances_fall_with_the_known_orders() {
    for (triangulate, order) in [(false, 3.9), (true, 2.9)] {
        let errors = [16, 32].map(|n| {
            let mesh = if triangulate { grid(n).triangulated() } else { grid(n) };
            deviation(&over_torus(&mesh, Settings::position()))
        });
        let observed = (errors[0] / errors[1]).log2();
        assert!(observed > order - 0.2, "triangulate {triangulate}: {errors:?}, order {observed}");
    }
}

#[test]
fn quadratic_cells_hold_c0_patches_exactly() {
    for mesh in [grid(6), grid(6).triangulated()] {
        let surface = over_torus(&mesh, Settings::position());
        let file = curved_grid(&surface, 5);
        assert!(file.gap < 8.0 * f64::EPSILON * surface.mesh().diagonal(), "gap {}", file.gap);
        assert_eq!(file.cells_of_face, vec![1; mesh.faces.len()]);
        assert_eq!(file.grid.points[..72], mesh.positions, "the vertices come first");
        for (cell, face) in file.grid.cells.iter().zip(&mesh.faces) {
            assert_eq!(cell.points()[..face.corners().len()], *face.corners());
        }
        // every vertex has one normal, every edge as well: all nodes
        assert!(file.grid.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-14), "normals");
        assert!(flat_gap(&surface, &samples(&surface, 4)) > 1e-4, "flat triangles are not exact");
    }
}

#[test]
fn g1_patches_become_samples_with_a_gap() {
    let surface = over_torus(&grid(8).triangulated(), Settings::tangent_plane());
    let (report, figures) = report(&surface, None);
    assert!(report.g1_residual.unwrap() < 1e-11, "{:?}", report.g1_residual);
    assert_eq!((report.flawed_edges.len(), report.construction.tangent_plane), (0, 384));
    assert_eq!(figures.kinks.len(), 384);
    let gaps = [2, 4].map(|divisions| {
        let file = curved_grid(&surface, divisions);
        assert_eq!(file.cells_of_face, vec![divisions * divisions; 256]);
        assert!(file.grid.cells.iter().all(|c| matches!(c, GridCell::QuadraticTriangle(_))));
        file.gap
    });
    assert!(gaps[1] > 0.0 && gaps[1] < gaps[0] / 2.0, "{gaps:?}");
}

#[test]
fn flaws_of_the_published_construction_are_told() {
    // an octahedron with one normal turned far away: edges with inflections
    let corners = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let faces =
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let mut normals = corners.to_vec();
    normals[4] = DVec3::new(0.9, 0.0, 0.3);
    let polygons = Polygons {
        positions: corners.to_vec(),
        normals,
        faces: faces.map(Polygon::triangle).into(),
        corner_normals: faces.map(|f| Polygon::triangle(f.map(Some))).into(),
    };
    let surface = from_polygons(&polygons, NormalSource::File, Settings::published()).unwrap();
    let (report, _) = report(&surface, None);
    assert_eq!(surface.settings().continuity, Continuity::TangentPlane(TangentPlanes::Published));
    assert!(!report.flawed_edges.is_empty(), "{report:?}");
    assert_eq!(report.flawed_edges.len(), report.construction.failures);
}

#[test]
fn lengths_scale_exactly() {
    let scale = 4096.0;
    let mesh = grid(5).triangulated();
    let mut large = mesh.clone();
    large.positions.iter_mut().for_each(|p| *p *= scale);
    let source = NormalSource::Estimate { crease_angle: 2.0 };
    for settings in [Settings::position(), Settings::tangent_plane()] {
        let [small, large] = [&mesh, &large].map(|mesh| {
            let surface = from_polygons(mesh, source, settings).unwrap();
            (curved_grid(&surface, 2), report(&surface, None).0)
        });
        assert_eq!(small.0.gap * scale, large.0.gap);
        let scaled: Vec<_> = small.0.grid.points.iter().map(|&p| p * scale).collect();
        assert_eq!(scaled, large.0.grid.points);
        assert_eq!(small.0.grid.normals, large.0.grid.normals);
        assert_eq!(small.1.max_kink_deg, large.1.max_kink_deg);
        assert_eq!(small.1.area.value * scale * scale, large.1.area.value);
    }
}

#[test]
fn sources_without_normals_are_refused() {
    let mesh = grid(3);
    let refused = |source| from_polygons(&mesh, source, Settings::position()).unwrap_err();
    assert!(matches!(refused(NormalSource::File), NagataError::NoNormals));
    let flat = Formula::parse("1").unwrap();
    assert!(matches!(refused(NormalSource::Field(&flat)), NagataError::NoGradient));
    let g1 = from_polygons(
        &mesh,
        NormalSource::Estimate { crease_angle: 1.0 },
        Settings::tangent_plane(),
    );
    assert!(matches!(g1, Err(NagataError::Surface(_))), "quadrilaterals have no G1 patches");
}
