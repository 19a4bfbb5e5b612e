//! Polygon meshes on known surfaces.

mod surfaces;

use std::collections::HashMap;

use glam::{DVec2, DVec3};

pub use surfaces::{CONE, CYLINDER, KnownSurface, MONKEY, SINE, SPHERE, TORUS, monkey, sine};

/// Vertices and faces, as in a file.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// Of the vertices.
    pub positions: Vec<DVec3>,
    /// Vertices of each face, counter-clockwise from outside.
    pub faces: Vec<Vec<usize>>,
}

impl Grid {
    /// Adds a quadrilateral, whole or as two triangles.
    pub fn quad(&mut self, [a, b, c, d]: [usize; 4], split: bool) {
        if split {
            self.faces.extend([vec![a, b, c], vec![a, c, d]]);
        } else {
            self.faces.push(vec![a, b, c, d]);
        }
    }

    /// Normals of a solid with flat ends below and above: the first `side_faces` faces have those of
    /// the side, the others point down or up. Where the side has no normal, it points up.
    #[must_use]
    pub fn rimmed_normals(&self, side_faces: usize, side: impl Fn(DVec3) -> DVec3) -> FileNormals {
        let upright = |n: DVec3| if n.is_finite() { n } else { DVec3::Z };
        let mut normals: Vec<DVec3> =
            self.positions.iter().map(|p| upright(side(*p + DVec3::Z * 1e-300))).collect();
        let (down, up) = (normals.len(), normals.len() + 1);
        normals.extend([-DVec3::Z, DVec3::Z]);
        let flat = |v: usize| if self.positions[v].z > 0.5 { up } else { down };
        let corners = self.faces.iter().enumerate().map(|(face, own)| {
            own.iter().map(|&v| Some(if face < side_faces { v } else { flat(v) })).collect()
        });
        FileNormals { corners: corners.collect(), normals }
    }
}

/// Normals as in files: those of a corner by index.
#[derive(Clone, Debug, Default)]
pub struct FileNormals {
    /// Unit normals.
    pub normals: Vec<DVec3>,
    /// Per face and corner.
    pub corners: Vec<Vec<Option<usize>>>,
}

/// The octahedron, each face cut into `n²` triangles.
#[must_use]
pub fn sphere(n: usize) -> Grid {
    let mut grid = Grid { positions: Vec::new(), faces: Vec::new() };
    let mut index = HashMap::new();
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
#[must_use]
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
#[must_use]
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

/// `6 k` sectors and `k` rows down to the apex, which is vertex 0; the base is a fan around the last
/// vertex.
#[must_use]
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
#[must_use]
pub fn cone_side_faces(k: usize) -> usize {
    12 * k * k - 6 * k
}

/// The graph of a function over [-1, 1]², `n` by `n` pieces, inner vertices moved by up to a quarter
/// of a piece.
#[must_use]
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
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// Evenly between two numbers.
    pub fn next(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In the cube from -1 to 1.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.next(-1.0, 1.0)))
    }

    /// Of length one, evenly over the sphere.
    pub fn unit(&mut self) -> DVec3 {
        loop {
            let v = self.vector();
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

/// An L-shaped solid of quadrilaterals: the outline of an L, lifted.
#[must_use]
pub fn l_shape() -> Grid {
    let outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    let mut grid = Grid::default();
    for z in [0.0, 1.0] {
        let lifted = outline.map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), z));
        grid.positions.extend(lifted);
    }
    // the flat parts are one quad each way from the inner corner
    grid.faces = (0..6).map(|k| vec![k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k]).collect();
    let flat: [[usize; 4]; 4] = [[0, 3, 2, 1], [0, 5, 4, 3], [6, 7, 8, 9], [6, 9, 10, 11]];
    grid.faces.extend(flat.map(Vec::from));
    grid
}
