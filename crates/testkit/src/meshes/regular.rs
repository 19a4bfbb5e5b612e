//! Regular meshes, and meshes moved onto a surface.

use basemesh::{EdgeId, FaceId, TriMesh, VertexMap};
use glam::DVec3;
use implicit::{ImplicitField, ProjectionSettings, project};

/// The icosahedron with vertices on the unit sphere, each face split into four `levels` times:
/// `20 · 4^levels` faces.
#[must_use]
pub fn icosphere(levels: usize) -> TriMesh {
    const FACES: [[usize; 3]; 20] = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let corners = [
        [-1.0, golden, 0.0],
        [1.0, golden, 0.0],
        [-1.0, -golden, 0.0],
        [1.0, -golden, 0.0],
        [0.0, -1.0, golden],
        [0.0, 1.0, golden],
        [0.0, -1.0, -golden],
        [0.0, 1.0, -golden],
        [golden, 0.0, -1.0],
        [golden, 0.0, 1.0],
        [-golden, 0.0, -1.0],
        [-golden, 0.0, 1.0],
    ];
    let positions = corners.map(|c| DVec3::from_array(c).normalize()).to_vec();
    let mesh = TriMesh::new(positions, &FACES).expect("an icosahedron");
    (0..levels).fold(mesh, |mesh, _| moved(&refined(&mesh), DVec3::normalize))
}

/// The torus around the z-axis with `around` times `across` quadrilaterals, each cut in two along
/// the same diagonal.
///
/// # Panics
/// If one of the counts is below 3.
#[must_use]
pub fn torus_grid(radii: [f64; 2], around: usize, across: usize) -> TriMesh {
    let turn = |i: usize, n: usize| std::f64::consts::TAU * i as f64 / n as f64;
    let mut positions = Vec::with_capacity(around * across);
    let mut faces = Vec::with_capacity(2 * around * across);
    for i in 0..around {
        for j in 0..across {
            let (u, v) = (turn(i, around), turn(j, across));
            let rho = radii[0] + radii[1] * v.cos();
            positions.push(DVec3::new(rho * u.cos(), rho * u.sin(), radii[1] * v.sin()));
            let at = |i: usize, j: usize| (i % around) * across + j % across;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriMesh::new(positions, &faces).expect("a torus of at least three by three cells")
}

/// Every face split into four at the midpoints of its edges.
#[must_use]
pub fn refined(mesh: &TriMesh) -> TriMesh {
    let t = mesh.topology();
    let middle = |e: EdgeId| {
        let [a, b] = t.edge_vertices(e);
        (mesh.position(a) + mesh.position(b)) * 0.5
    };
    let mut positions = mesh.positions().as_slice().to_vec();
    positions.extend(t.edges().map(middle));
    let split = |face: FaceId| {
        let [a, b, c] = t.corners(face).map(basemesh::VertexId::index);
        let [ab, bc, ca] = face.halfedges().map(|h| t.vertex_count() + t.edge(h).index());
        [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    };
    let faces: Vec<[usize; 3]> = t.faces().flat_map(split).collect();
    TriMesh::new(positions, &faces).expect("refinement keeps a manifold")
}

/// The mesh with its vertices projected onto the zero set of `field`; `None` where that fails.
#[must_use]
pub fn on_surface(mesh: &TriMesh, field: &dyn ImplicitField) -> Option<TriMesh> {
    let (length, settings) = (mesh.diagonal(), ProjectionSettings::default());
    let positions = VertexMap::try_from_fn(mesh.positions().len(), |v| {
        project(field, mesh.position(v), length, &settings)
    });
    mesh.clone().with_positions(positions.ok()?).ok()
}

/// The mesh with every vertex moved along the ray from the origin to where `field` turns positive,
/// within a distance of `outer`.
///
/// # Panics
/// If the field is not negative at the origin and positive at that distance.
#[must_use]
pub fn radially_on_surface(mesh: &TriMesh, field: &dyn ImplicitField, outer: f64) -> TriMesh {
    moved(mesh, |p| {
        let direction = p.normalize();
        let value = |r: f64| field.value(direction * r);
        let (mut inside, mut outside) = (0.0, outer);
        assert!(value(inside) < 0.0 && value(outside) > 0.0, "no sign change along {direction}");
        // bisection until the two are neighbouring numbers
        loop {
            let middle = 0.5 * (inside + outside);
            if middle <= inside || middle >= outside {
                return direction * outside;
            }
            if value(middle) < 0.0 { inside = middle } else { outside = middle }
        }
    })
}

fn moved(mesh: &TriMesh, motion: impl Fn(DVec3) -> DVec3 + Sync) -> TriMesh {
    let positions = mesh.positions().map(|_, &p| motion(p));
    mesh.clone().with_positions(positions).expect("finite positions")
}
