//! Input without a good answer: an outcome or a clear error, and never a number that is none.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod common;

use common::GridMesh as _;

use common::{Random, build, samples};
use nagata::glam::DVec3;
use nagata::{
    CornerNormals, EdgeNormals, EdgeSettings, Join, MeshError, NagataSurface, NormalsError,
    PolygonMesh, Settings, SurfaceError, curvature_parameter,
};

fn all_finite(surface: &NagataSurface) {
    for face in surface.mesh().faces() {
        let patch = surface.patch(face);
        for (point, normal) in samples(&patch, 6) {
            assert!(point.is_finite(), "{face:?}: {point}");
            assert!(normal.is_none_or(|n| n.is_finite() && n.is_normalized()), "{normal:?}");
        }
        let area = patch.area(1e-2);
        assert!(area.value.is_finite() && area.error.is_finite(), "{area:?}");
        let report = surface.patch_report(face);
        assert!(report.misfit.is_finite(), "{report:?}");
    }
    for edge in surface.mesh().edges() {
        assert!(surface.edge_misfit(edge).is_finite(), "{edge:?}");
        assert!(surface.kink(edge, 4).is_none_or(f64::is_finite), "{edge:?}");
        let _ = surface.join(edge);
    }
}

const ALL: fn() -> [Settings; 3] =
    || [Settings::position(), Settings::published(), Settings::tangent_plane()];

#[test]
fn degenerate_triangles() {
    let p = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0, DVec3::new(1.0, 1e-9, 0.0), DVec3::X];
    let triangles = [[0, 1, 2], [0, 2, 3], [0, 1, 4], [1, 4, 1 + 1]];
    let mut random = Random(2);
    for round in 0..50 {
        for triangle in triangles {
            let corners: Vec<DVec3> = triangle.iter().map(|&v| p[v]).collect();
            let mesh = PolygonMesh::new(corners, &[[0, 1, 2]]).unwrap();
            let mut normals = [DVec3::Z; 3];
            if round > 0 {
                normals = std::array::from_fn(|_| random.unit());
            }
            let normals = CornerNormals::per_vertex(&mesh, &normals).unwrap();
            for settings in ALL() {
                all_finite(&build(&mesh, &normals, settings));
            }
            // nothing can be estimated where there is no area
            let estimated = CornerNormals::estimated(&mesh, 0.7);
            all_finite(&build(&mesh, &estimated, Settings::tangent_plane()));
        }
    }
    // all corners in one point
    let mesh = PolygonMesh::new(vec![DVec3::ONE; 4], &[[0, 1, 2, 3]]).unwrap();
    let normals = CornerNormals::estimated(&mesh, 0.7);
    assert_eq!(normals.normals(), []);
    all_finite(&build(&mesh, &normals, Settings::position()));
}

#[test]
fn opposite_and_parallel_normals() {
    let mesh = PolygonMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]).unwrap();
    let tilted = DVec3::new(0.6, 0.0, 0.8);
    let cases = [
        [DVec3::Z, -DVec3::Z, DVec3::Z],
        [DVec3::X, DVec3::X, DVec3::X],
        [DVec3::X, -DVec3::X, DVec3::Y],
        [tilted, -tilted, tilted],
        [tilted, (tilted + DVec3::Y * 1e-9).normalize(), -tilted],
    ];
    for normals in cases {
        let normals = CornerNormals::per_vertex(&mesh, &normals).unwrap();
        for settings in ALL() {
            all_finite(&build(&mesh, &normals, settings));
        }
    }
}

#[test]
fn very_small_and_very_large_meshes() {
    for scale in [1e-200, 1e-60, 1e60, 1e200] {
        let mut grid = common::sphere(2);
        let mesh = grid.mesh();
        let normals = common::smooth(&mesh, &common::SPHERE);
        grid.positions.iter_mut().for_each(|p| *p *= scale);
        let mesh = grid.mesh();
        for settings in ALL() {
            let surface = build(&mesh, &normals, settings);
            for face in mesh.faces() {
                for (point, normal) in samples(&surface.patch(face), 4) {
                    assert!(point.is_finite(), "{scale}: {point}");
                    assert!(normal.is_none_or(DVec3::is_finite), "{scale}: {normal:?}");
                }
            }
        }
    }
}

#[test]
fn parallel_normals_miss_by_the_tilt() {
    let tilt: f64 = 0.1;
    let d = DVec3::new(tilt.cos(), 0.0, tilt.sin());
    let normals = EdgeNormals { start: &[DVec3::Z], end: &[DVec3::Z] };
    let found = curvature_parameter(d, normals, &EdgeSettings::default());
    assert_eq!((found.value, found.status.rank), (DVec3::ZERO, 1));
    let misfit = nagata::end_misfit(d, d, d, normals);
    assert!((misfit - tilt.sin()).abs() <= 1e-15, "{misfit}");
}

#[test]
fn bad_meshes_are_refused() {
    let p = || vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let none: [[usize; 3]; 0] = [];
    assert_eq!(PolygonMesh::new(p(), &none), Err(MeshError::Empty));
    assert_eq!(
        PolygonMesh::new(p(), &[vec![0, 1]]),
        Err(MeshError::Corners { face: 0, corners: 2 })
    );
    assert_eq!(
        PolygonMesh::new(p(), &[[0, 1, 2], [0, 1, 3]]),
        Err(MeshError::MissingVertex { face: 1, vertex: 3, count: 3 })
    );
    assert_eq!(
        PolygonMesh::new(p(), &[[0, 1, 1]]),
        Err(MeshError::RepeatedVertex { face: 0, vertex: 1 })
    );
    let mut q = p();
    q[1].y = f64::INFINITY;
    assert!(
        matches!(PolygonMesh::new(q, &[[0, 1, 2]]), Err(MeshError::NotFinite { vertex: 1, .. })),
        "an infinite coordinate"
    );
}

#[test]
fn bad_normals_are_refused() {
    let mesh = PolygonMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]).unwrap();
    for bad in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
        let given = CornerNormals::per_vertex(&mesh, &[DVec3::Z, bad, DVec3::Z]);
        assert!(matches!(given, Err(NormalsError::NotUsable { index: 1, .. })), "{bad}: {given:?}");
        // from a function they are simply missing
        let function = CornerNormals::from_fn(&mesh, |_| Some(bad));
        assert_eq!(function.normals(), []);
        all_finite(&build(&mesh, &function, Settings::tangent_plane()));
    }
    let few = CornerNormals::per_vertex(&mesh, &[DVec3::Z]);
    assert!(matches!(few, Err(NormalsError::Count { .. })), "{few:?}");
    let missing = CornerNormals::from_corners(&mesh, &[DVec3::Z], &[[Some(0), Some(1), None]], 0.0);
    assert!(matches!(missing, Err(NormalsError::MissingNormal { normal: 1, .. })), "{missing:?}");
    // normals of another mesh
    let other = common::sphere(1).mesh();
    let normals = CornerNormals::per_vertex(&mesh, &[DVec3::Z; 3]).unwrap();
    let surface = NagataSurface::new(other, normals, Settings::position());
    assert!(matches!(surface, Err(SurfaceError::Normals(_))), "{surface:?}");
}

#[test]
fn tangent_planes_need_triangles() {
    let mesh = common::torus(6, 4, false).mesh();
    let normals = common::smooth(&mesh, &common::TORUS);
    let refused = NagataSurface::new(mesh, normals, Settings::tangent_plane()).unwrap_err();
    assert_eq!(refused, SurfaceError::Quadrilateral { face: 0 });
}

#[test]
fn bad_settings_are_refused() {
    let mesh = common::sphere(1).mesh();
    for value in [f64::NAN, -1.0, f64::INFINITY] {
        let normals = common::smooth(&mesh, &common::SPHERE);
        let mut settings = Settings::tangent_plane();
        settings.edges.rank = value;
        let refused = NagataSurface::new(mesh.clone(), normals, settings).unwrap_err();
        assert!(matches!(refused, SurfaceError::Setting { name: "edges.rank", .. }), "{refused}");
    }
}

/// Between two sound faces, a triangle without area: nothing can be smooth across its edges.
#[test]
fn edges_of_collinear_triangles_are_singular() {
    let third = 1.0 / 3.0;
    let along = DVec3::new(1.0, third, 0.1);
    let positions = vec![
        DVec3::ZERO,
        along * 2.0,
        along * third,
        DVec3::new(0.5, 1.0, 0.0),
        DVec3::new(0.2, -1.0, 0.0),
        DVec3::new(1.7, -1.0, 0.0),
    ];
    // the one without area first
    let faces = [[0, 2, 1], [0, 1, 3], [2, 0, 4], [1, 2, 5]];
    let mesh = PolygonMesh::new(positions, &faces).unwrap();
    let normal = along.cross(DVec3::Y).normalize();
    let normals = CornerNormals::per_vertex(&mesh, &[normal; 6]).unwrap();
    for settings in [Settings::tangent_plane(), Settings::published()] {
        let surface = build(&mesh, &normals, settings);
        let flat = surface.mesh().faces().next().unwrap();
        for side in surface.mesh().sides(flat) {
            assert_eq!(surface.join(surface.mesh().edge(side)), Join::Singular, "{side:?}");
        }
        let patch = surface.patch(flat);
        for at in [[0.3, 0.3], [0.1, 0.7], [0.5, 0.5], [0.0, 0.25]] {
            assert_eq!(patch.normal(at), None, "{at:?}");
        }
        assert!(patch.point([0.3, 0.3]).is_finite());
        assert_eq!(surface.report().tangent_plane, 0);
    }
}

#[test]
fn updates_are_refused_as_a_whole() {
    let mesh = common::sphere(2).mesh();
    let normals = common::smooth(&mesh, &common::SPHERE);
    let mut surface = build(&mesh, &normals, Settings::position());
    let before = surface.clone();
    let positions = mesh.positions().as_slice();
    let (given, expected) = (positions.len() - 1, positions.len());
    let refused = surface.update(&positions[1..], normals.clone());
    assert_eq!(refused, Err(MeshError::Positions { given, expected }.into()));
    let mut bad = positions.to_vec();
    bad[5].y = f64::NAN;
    let refused = surface.update(&bad, normals.clone());
    assert!(
        matches!(refused, Err(SurfaceError::Mesh(MeshError::NotFinite { vertex: 5, .. }))),
        "{refused:?}"
    );
    let other = common::sphere(3).mesh();
    let refused = surface.update(positions, common::smooth(&other, &common::SPHERE));
    assert!(matches!(refused, Err(SurfaceError::Normals(_))), "{refused:?}");
    assert_eq!(surface, before);
}
