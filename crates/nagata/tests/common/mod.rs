//! Meshes on known surfaces, and how far patches are from them.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "each test file uses a part; helpers fail like tests"
)]

use nagata::basemesh::VertexId;
use nagata::bezier_core::Barycentric;
use nagata::glam::{DVec2, DVec3};
use nagata::{Apex, CornerNormals, NagataSurface, Patch, PolygonMesh, Settings};

/// A surface `f = 0` with unit gradient on it, so that `f` is the distance near by.
pub struct Surface {
    pub distance: fn(DVec3) -> f64,
    pub normal: fn(DVec3) -> DVec3,
}

pub const SPHERE: Surface = Surface { distance: |p| p.length() - 1.0, normal: |p| p.normalize() };

pub const CYLINDER: Surface = Surface {
    distance: |p| p.truncate().length() - 1.0,
    normal: |p| p.truncate().normalize().extend(0.0),
};

/// Radii 2 and 1.
pub const TORUS: Surface = Surface {
    distance: |p| (p - torus_axis(p)).length() - 1.0,
    normal: |p| (p - torus_axis(p)).normalize(),
};

fn torus_axis(p: DVec3) -> DVec3 {
    (p.truncate().normalize() * 2.0).extend(0.0)
}

/// Apex (0, 0, 1), base circle of radius 1 at z = 0.
pub const CONE: Surface = Surface {
    distance: |p| (p.truncate().length() + p.z - 1.0) * 0.5_f64.sqrt(),
    normal: |p| (p.truncate().normalize().extend(1.0)).normalize(),
};

pub struct Grid {
    pub positions: Vec<DVec3>,
    pub faces: Vec<Vec<usize>>,
}

impl Grid {
    pub fn mesh(&self) -> PolygonMesh {
        PolygonMesh::new(self.positions.clone(), &self.faces).unwrap()
    }

    pub fn quad(&mut self, [a, b, c, d]: [usize; 4], split: bool) {
        if split {
            self.faces.extend([vec![a, b, c], vec![a, c, d]]);
        } else {
            self.faces.push(vec![a, b, c, d]);
        }
    }
}

/// One normal for each vertex, from the surface.
pub fn smooth(mesh: &PolygonMesh, surface: &Surface) -> CornerNormals {
    CornerNormals::from_fn(mesh, |p| Some((surface.normal)(p)))
}

/// The octahedron, each face cut into `n²` triangles.
pub fn sphere(n: usize) -> Grid {
    let mut grid = Grid { positions: Vec::new(), faces: Vec::new() };
    let mut index = std::collections::HashMap::new();
    for signs in 0..8 {
        let sign = |bit: usize| if signs >> bit & 1 == 0 { 1_i64 } else { -1 };
        let n = n as i64;
        let mut vertex = |i: i64, j: i64| {
            let key = [sign(0) * (n - i - j), sign(1) * i, sign(2) * j];
            *index.entry(key).or_insert_with(|| {
                grid.positions.push(DVec3::from_array(key.map(|x| x as f64)).normalize());
                grid.positions.len() - 1
            })
        };
        let flip = sign(0) * sign(1) * sign(2) < 0;
        let mut face = |a, b, c| grid.faces.push(if flip { vec![a, c, b] } else { vec![a, b, c] });
        for i in 0..n {
            for j in 0..n - i {
                let (a, b, c) = (vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
                face(a, b, c);
                if i + j + 1 < n {
                    let d = vertex(i + 1, j + 1);
                    face(b, d, c);
                }
            }
        }
    }
    grid
}

fn turn(k: usize, n: usize) -> DVec2 {
    DVec2::from_angle(std::f64::consts::TAU * k as f64 / n as f64)
}

/// `n` around the axis, `m` around the tube.
pub fn torus(n: usize, m: usize, split: bool) -> Grid {
    let point = |i, j| {
        let (around, tube) = (turn(i, n), turn(j, m));
        (around * (2.0 + tube.x)).extend(tube.y)
    };
    let positions = (0..n * m).map(|v| point(v / m, v % m)).collect();
    let mut grid = Grid { positions, faces: Vec::new() };
    for i in 0..n {
        for j in 0..m {
            let at = |i: usize, j: usize| i % n * m + j % m;
            grid.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], split);
        }
    }
    grid
}

/// Side of a cylinder of height 1 with `n` by `rows` pieces; with its discs the vertices of the rims
/// are those of the side, and the last two vertices are the centres.
pub fn cylinder(n: usize, rows: usize, discs: bool) -> Grid {
    let point = |row: usize, k| turn(k, n).extend(row as f64 / rows as f64);
    let positions = (0..n * (rows + 1)).map(|v| point(v / n, v % n)).collect();
    let mut grid = Grid { positions, faces: Vec::new() };
    for row in 0..rows {
        for k in 0..n {
            let at = |row: usize, k: usize| row * n + k % n;
            grid.quad([at(row, k), at(row, k + 1), at(row + 1, k + 1), at(row + 1, k)], true);
        }
    }
    if discs {
        let bottom = grid.positions.len();
        grid.positions.extend([DVec3::ZERO, DVec3::Z]);
        for k in 0..n {
            let (a, b) = (k, (k + 1) % n);
            grid.faces.push(vec![b, a, bottom]);
            grid.faces.push(vec![rows * n + a, rows * n + b, bottom + 1]);
        }
    }
    grid
}

/// Normals of the cylinder with discs: exact ones on the side, axial ones on the discs.
pub fn cylinder_normals(mesh: &PolygonMesh, rows: usize, n: usize) -> CornerNormals {
    rimmed_normals(mesh, 2 * rows * n, CYLINDER.normal)
}

/// The first `side_faces` faces have the normals `side`, the others those of their plane.
fn rimmed_normals(
    mesh: &PolygonMesh,
    side_faces: usize,
    side: impl Fn(DVec3) -> DVec3,
) -> CornerNormals {
    let mut normals: Vec<DVec3> =
        mesh.vertices().map(|v| side(mesh.position(v) + DVec3::Z * 1e-300)).collect();
    normals.iter_mut().filter(|n| !n.is_finite()).for_each(|n| *n = DVec3::Z);
    let (down, up) = (normals.len(), normals.len() + 1);
    normals.extend([-DVec3::Z, DVec3::Z]);
    let corners: Vec<Vec<Option<usize>>> = mesh
        .faces()
        .map(|face| {
            let own = mesh.corners(face).iter();
            own.map(|v| {
                let top = mesh.position(*v).z > 0.5;
                let flat = if top { up } else { down };
                Some(if face.index() < side_faces { v.index() } else { flat })
            })
            .collect()
        })
        .collect();
    CornerNormals::from_corners(mesh, &normals, &corners, CornerNormals::MERGE_ANGLE).unwrap()
}

/// `6 k` sectors and `k` rows down to the apex, which is vertex 0; the base is a fan around the last
/// vertex.
pub fn cone(k: usize) -> Grid {
    let mut grid = Grid { positions: vec![DVec3::Z], faces: Vec::new() };
    let n = 6 * k;
    for row in 1..=k {
        let radius = row as f64 / k as f64;
        grid.positions.extend((0..n).map(|s| (turn(s, n) * radius).extend(1.0 - radius)));
    }
    let at = |row: usize, s: usize| 1 + (row - 1) * n + s % n;
    grid.faces.extend((0..n).map(|s| vec![0, at(1, s), at(1, s + 1)]));
    for row in 1..k {
        for s in 0..n {
            grid.quad([at(row, s), at(row + 1, s), at(row + 1, s + 1), at(row, s + 1)], true);
        }
    }
    let centre = grid.positions.len();
    grid.positions.push(DVec3::ZERO);
    grid.faces.extend((0..n).map(|s| vec![at(k, s + 1), at(k, s), centre]));
    grid
}

/// Number of faces of the side of [`cone`].
pub fn cone_side_faces(k: usize) -> usize {
    12 * k * k - 6 * k
}

pub fn cone_normals(mesh: &PolygonMesh, k: usize, apex: Apex) -> CornerNormals {
    let normals = rimmed_normals(mesh, cone_side_faces(k), CONE.normal);
    normals.with_apexes(mesh, &[VertexId::new(0)], apex)
}

/// The graph of a function over [-1, 1]², `n` by `n` pieces, inner vertices moved by up to a quarter
/// of a piece.
pub fn graph(n: usize, height: impl Fn(f64, f64) -> f64, seed: u64) -> Grid {
    let mut random = Random(seed);
    let h = 2.0 / n as f64;
    let mut positions = Vec::new();
    for v in 0..(n + 1) * (n + 1) {
        let (i, j) = (v / (n + 1), v % (n + 1));
        let mut moved = |k: usize| {
            let by = if k == 0 || k == n { 0.0 } else { random.next(-0.25, 0.25) };
            (k as f64 + by) * h - 1.0
        };
        let (x, y) = (moved(i), moved(j));
        positions.push(DVec3::new(x, y, height(x, y)));
    }
    let mut grid = Grid { positions, faces: Vec::new() };
    for i in 0..n {
        for j in 0..n {
            let at = |i: usize, j: usize| i * (n + 1) + j;
            grid.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], true);
        }
    }
    grid
}

/// A small generator of pseudo-random numbers (xorshift).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn vector(&mut self) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.next(-1.0, 1.0)))
    }

    pub fn unit(&mut self) -> DVec3 {
        loop {
            let v = self.vector();
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

/// Points and normals at the lattice with this many divisions.
pub fn samples(patch: &Patch, divisions: usize) -> Vec<(DVec3, Option<DVec3>)> {
    match patch {
        Patch::Triangle(p) => {
            Barycentric::lattice(divisions).map(|at| (p.point(at), p.normal(at))).collect()
        }
        Patch::TangentPlane(p) => {
            Barycentric::lattice(divisions).map(|at| (p.point(at), p.normal(at))).collect()
        }
        Patch::Quad(p) => (0..(divisions + 1) * (divisions + 1))
            .map(|s| {
                [s / (divisions + 1), s % (divisions + 1)].map(|k| k as f64 / divisions as f64)
            })
            .map(|at| (p.point(at), p.normal(at)))
            .collect(),
    }
}

/// Largest distance of the first `faces` patches from a surface, and largest angle of normals in
/// radians.
pub fn errors(
    surface: &NagataSurface,
    faces: usize,
    truth: &Surface,
    divisions: usize,
) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for face in surface.mesh().faces().take(faces) {
        for (point, normal) in samples(&surface.patch(face), divisions) {
            let distance = (truth.distance)(point).abs();
            assert!(distance.is_finite(), "distance at {point}");
            worst[0] = worst[0].max(distance);
            if let Some(normal) = normal {
                let exact = (truth.normal)(point);
                let angle = normal.cross(exact).length().atan2(normal.dot(exact));
                worst[1] = worst[1].max(angle);
            }
        }
    }
    worst
}

pub fn build(mesh: &PolygonMesh, normals: &CornerNormals, settings: Settings) -> NagataSurface {
    NagataSurface::new(mesh.clone(), normals.clone(), settings).unwrap()
}

/// Largest kink of the edges that join with common tangent planes, and their number.
pub fn residual(surface: &NagataSurface, samples: usize) -> (f64, usize) {
    let smooth = surface.mesh().edges().filter(|e| surface.join(*e) == nagata::Join::TangentPlane);
    smooth.fold((0.0, 0), |(worst, count), edge| {
        (f64::max(worst, surface.kink(edge, samples).unwrap()), count + 1)
    })
}
