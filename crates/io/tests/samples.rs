//! Crack-free samples of triangles and quadrilaterals, with creases.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use std::collections::HashMap;

use io::glam::DVec3;
use io::{
    CreasedTessellation, FacePoint, GridCell, LargeFaces, Polygon, Polygons, Samples,
    read_polygons, write_obj_creased,
};

/// A box of triangles and quadrilaterals: each side has its own normal, except that the first two
/// share theirs.
fn cube() -> Polygons {
    let positions: Vec<DVec3> =
        (0..8).map(|v| DVec3::from_array([v & 1, v >> 1 & 1, v >> 2].map(f64::from))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2]];
    let mut faces: Vec<_> = quads.map(Polygon::quad).into();
    faces.extend([[1, 3, 7], [1, 7, 5]].map(Polygon::triangle));
    let of_face = [0, 0, 0, 1, 2, 3, 3].map(|n| if n == 0 { None } else { Some(n) });
    let corner_normals = faces
        .iter()
        .zip(of_face)
        .map(|(face, n)| Polygon::new(&vec![n; face.corners().len()]).unwrap())
        .collect();
    Polygons { positions, normals: Vec::new(), faces, corner_normals }
}

/// A point of a flat face and a normal that depends on the face; off by a bit that depends on it
/// too, as rounding does.
fn flat(mesh: &Polygons) -> impl FnMut(usize, FacePoint) -> (DVec3, DVec3) + '_ {
    |face, at| {
        let corners: Vec<_> =
            mesh.faces[face].corners().iter().map(|&v| mesh.positions[v]).collect();
        let point = match at {
            FacePoint::Triangle(b) => corners[0] * b.u + corners[1] * b.v + corners[2] * b.w,
            FacePoint::Quad([x, y]) => {
                corners[0].lerp(corners[1], x).lerp(corners[3].lerp(corners[2], x), y)
            }
        };
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        (point + DVec3::splat(face as f64 * 1e-15), normal)
    }
}

/// How many triangles run along each directed pair of points.
fn directed_edges(tessellation: &CreasedTessellation) -> HashMap<[usize; 2], usize> {
    let mut edges = HashMap::new();
    for &[a, b, c] in &tessellation.triangles {
        for edge in [[a, b], [b, c], [c, a]] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges
}

#[test]
fn a_closed_mesh_stays_closed() {
    let mesh = cube();
    for divisions in [1, 2, 3, 8] {
        let flat = Samples::new(&mesh, divisions, flat(&mesh)).tessellation();
        assert_eq!(flat.triangles.len(), 12 * divisions * divisions);
        assert_eq!(flat.positions[..8], mesh.positions, "vertices keep their positions");
        let edges = directed_edges(&flat);
        assert!(
            edges.iter().all(|([a, b], &count)| count == 1 && edges.contains_key(&[*b, *a])),
            "{divisions} divisions: open or doubled edges"
        );
        let area = flat.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|point| flat.positions[point]);
            (b - a).cross(c - a).length() / 2.0
        });
        let area: f64 = area.sum();
        assert!((area - 6.0).abs() < 1e-12, "{divisions} divisions: area {area}");
    }
}

#[test]
fn creases_stay_sharp_and_smooth_edges_smooth() {
    let mesh = cube();
    let flat = Samples::new(&mesh, 4, flat(&mesh)).tessellation();
    for (corners, normals) in flat.triangles.iter().zip(&flat.triangle_normals) {
        let [a, b, c] = corners.map(|point| flat.positions[point]);
        let expected = (b - a).cross(c - a).normalize();
        for &normal in normals {
            let error = (flat.normals[normal] - expected).length();
            assert!(error < 1e-12, "a normal of {} at {expected}", flat.normals[normal]);
        }
    }
    // the two triangles share the normals along the diagonal: 5 points, ends included
    let [first, second] = [0, 1].map(|half| {
        let start = 5 * 32 + half * 16;
        let normals: Vec<_> = flat.triangle_normals[start..start + 16].concat();
        normals.into_iter().collect::<std::collections::HashSet<_>>()
    });
    assert_eq!(first.intersection(&second).count(), 5);
    // and no other two faces do
    assert_eq!(flat.normals.len(), 5 * 25 + 2 * 15 - 5);
}

#[test]
fn quadratic_cells_share_their_nodes() {
    let mesh = cube();
    let (grid, counts) = Samples::new(&mesh, 2, flat(&mesh)).quadratic_grid();
    assert_eq!(counts, [1; 7]);
    // vertices and edges; no centres of quadrilaterals
    assert_eq!(grid.points.len(), 8 + 13);
    let mut middles = HashMap::new();
    for cell in &grid.cells {
        let points = cell.points();
        let corners = points.len() / 2;
        for side in 0..corners {
            let [a, b] = [points[side], points[(side + 1) % corners]];
            let middle = points[corners + side];
            let expected = (grid.points[a] + grid.points[b]) * 0.5;
            assert!(grid.points[middle].distance(expected) < 1e-13, "side {a}-{b}: node {middle}");
            assert_eq!(*middles.entry([a.min(b), a.max(b)]).or_insert(middle), middle);
        }
    }
    assert_eq!(middles.len(), 13);
    // one normal only inside the side of two triangles: at the middle of its diagonal
    let with_normal: Vec<_> = (0..21).filter(|&p| grid.normals[p] != DVec3::ZERO).collect();
    assert_eq!(with_normal, [middles[&[1, 7]]]);

    let (fine, counts) = Samples::new(&mesh, 6, flat(&mesh)).quadratic_grid();
    assert_eq!(counts, [9; 7]);
    assert!(matches!(fine.cells[0], GridCell::QuadraticQuad(_)));
    assert!(matches!(fine.cells[62], GridCell::QuadraticTriangle(_)));
    let (flat_cells, counts) = Samples::new(&mesh, 3, flat(&mesh)).flat_grid();
    assert_eq!(counts, [18, 18, 18, 18, 18, 9, 9]);
    assert_eq!(flat_cells.cells.len(), 108);
}

#[test]
fn a_written_tessellation_keeps_its_creases() {
    let mesh = cube();
    let flat = Samples::new(&mesh, 2, flat(&mesh)).tessellation();
    let mut file = Vec::new();
    write_obj_creased(&mut file, &flat).unwrap();
    let back = read_polygons(&mut file.as_slice(), LargeFaces::Refuse).unwrap();
    assert_eq!((&back.positions, &back.normals), (&flat.positions, &flat.normals));
    for (at, (face, normals)) in back.faces.iter().zip(&back.corner_normals).enumerate() {
        assert_eq!(face.corners(), flat.triangles[at]);
        assert_eq!(normals.corners(), flat.triangle_normals[at].map(Some));
    }
}
