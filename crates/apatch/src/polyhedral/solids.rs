//! Solids by name, convex hulls, duals and prisms.

use glam::{DVec2, DVec3};

use super::error::PolyhedronError;
use super::polyhedron::{Planarity, Polyhedron};

/// Names that [`Polyhedron::named`] knows.
pub const SOLID_NAMES: [&str; 14] = [
    "tetrahedron",
    "cube",
    "octahedron",
    "dodecahedron",
    "icosahedron",
    "cuboctahedron",
    "truncated-octahedron",
    "truncated-icosahedron",
    "square-pyramid",
    "hexagonal-prism",
    "l-prism",
    "u-prism",
    "frame",
    "notched-box",
];

/// Points nearer to the plane of a face than this belong to it, in sizes of the set.
const COPLANAR: f64 = 1e-9;

impl Polyhedron {
    /// One of [`SOLID_NAMES`]; `None` for other names.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let solid = match name {
            "tetrahedron" => Self::convex_hull(&[
                DVec3::new(1.0, 1.0, 1.0),
                DVec3::new(1.0, -1.0, -1.0),
                DVec3::new(-1.0, 1.0, -1.0),
                DVec3::new(-1.0, -1.0, 1.0),
            ]),
            "cube" => Self::convex_hull(&turns([1.0, 1.0, 1.0])),
            "octahedron" => Self::convex_hull(&turns([0.0, 0.0, 1.0])),
            "dodecahedron" => {
                let golden = golden();
                let mut points = turns([1.0, 1.0, 1.0]);
                points.extend(turns([0.0, 1.0 / golden, golden]));
                Self::convex_hull(&points)
            }
            "icosahedron" => Self::convex_hull(&turns([0.0, 1.0, golden()])),
            "cuboctahedron" => Self::convex_hull(&turns([0.0, 1.0, 1.0])),
            "truncated-octahedron" => {
                let mut points = turns([0.0, 1.0, 2.0]);
                points.extend(turns([1.0, 0.0, 2.0]));
                Self::convex_hull(&points)
            }
            "truncated-icosahedron" => {
                let golden = golden();
                let mut points = turns([0.0, 1.0, 3.0 * golden]);
                points.extend(turns([1.0, 2.0 + golden, 2.0 * golden]));
                points.extend(turns([golden, 2.0, 2.0 * golden + 1.0]));
                Self::convex_hull(&points)
            }
            "square-pyramid" => {
                let base = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
                let mut points = base.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
                points.push(DVec3::new(0.0, 0.0, 1.5));
                Self::convex_hull(&points)
            }
            "hexagonal-prism" => {
                let corner = |k: i32| DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_3);
                Self::prism(&[(0..6).map(corner).collect()], 1.0)
            }
            "l-prism" => Self::prism(&[plan(&L)], 1.0),
            "u-prism" => Self::prism(&[plan(&U)], 1.0),
            "frame" => {
                let outer = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]];
                let hole = [[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0]];
                Self::prism(&[plan(&outer), plan(&hole)], 1.0)
            }
            "notched-box" => notched_box(),
            _ => return None,
        };
        Some(solid.expect("invariant: the named solids are valid"))
    }

    /// The convex hull of points; those that are no corners of it belong to no face. Time `n^4`, for
    /// small sets.
    ///
    /// # Errors
    ///
    /// [`PolyhedronError`] for points in one plane, or not finite.
    pub fn convex_hull(points: &[DVec3]) -> Result<Self, PolyhedronError> {
        let reach = points.iter().map(|p| p.distance(points[0])).fold(0.0, f64::max);
        let slack = COPLANAR * reach;
        let mut faces: Vec<Vec<usize>> = Vec::new();
        for i in 0..points.len() {
            for j in i + 1..points.len() {
                for k in j + 1..points.len() {
                    let [a, b, c] = [i, j, k].map(|p| points[p]);
                    let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
                    for normal in [normal, -normal] {
                        let height = |p: &DVec3| normal.dot(*p - a);
                        if points.iter().any(|p| height(p) > slack) {
                            continue;
                        }
                        let on = |p: &usize| height(&points[*p]) >= -slack;
                        let face: Vec<usize> = (0..points.len()).filter(on).collect();
                        let known = faces.iter().any(|f| face.iter().all(|p| f.contains(p)));
                        if face.len() >= 3 && face[..3] == [i, j, k] && !known {
                            faces.push(turned(points, face, normal));
                        }
                    }
                }
            }
        }
        let faces = faces.into_iter().map(|f| vec![f]).collect();
        Self::new(points.to_vec(), faces, &Planarity::default())
    }

    /// The polar dual: a vertex for each face, a face for each vertex. The faces must be convex and
    /// see the origin from outside.
    ///
    /// # Errors
    ///
    /// [`PolyhedronError`] where that is not so.
    pub fn dual(&self) -> Result<Self, PolyhedronError> {
        let pole = |f: &super::Facet| f.normal / f.normal.dot(f.centroid);
        let vertices = self.facets().iter().map(pole).collect();
        let around = |vertex: usize| -> Vec<usize> {
            self.fan(vertex).into_iter().map(|side| self.sides[side].face).collect()
        };
        let faces = (0..self.vertices().len()).map(around).filter(|f| !f.is_empty());
        Self::new(vertices, faces.map(|f| vec![f]).collect(), &Planarity::default())
    }

    /// A prism over a plan in the plane `z = 0`, upwards: the outer loop counter-clockwise, holes
    /// clockwise.
    ///
    /// # Errors
    ///
    /// [`PolyhedronError`] for loops that are no plan, or a height that is not positive.
    pub fn prism(plan: &[Vec<DVec2>], height: f64) -> Result<Self, PolyhedronError> {
        let count: usize = plan.iter().map(Vec::len).sum();
        let flat: Vec<DVec2> = plan.iter().flatten().copied().collect();
        let level = |z: f64| flat.iter().map(move |p| DVec3::new(p.x, p.y, z));
        let vertices: Vec<DVec3> = level(0.0).chain(level(height)).collect();
        let (mut top, mut bottom, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        let mut start = 0;
        for corners in plan {
            let n = corners.len();
            let corner = |i: usize| start + i % n;
            bottom.push((0..n).rev().map(corner).collect::<Vec<_>>());
            top.push((0..n).map(|i| count + corner(i)).collect::<Vec<_>>());
            for i in 0..n {
                let [a, b] = [corner(i), corner(i + 1)];
                faces.push(vec![vec![a, b, count + b, count + a]]);
            }
            start += n;
        }
        faces.extend([bottom, top]);
        Self::new(vertices, faces, &Planarity::default())
    }
}

const L: [[f64; 2]; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
const U: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [3.0, 0.0],
    [3.0, 2.0],
    [2.0, 2.0],
    [2.0, 1.0],
    [1.0, 1.0],
    [1.0, 2.0],
    [0.0, 2.0],
];

fn plan(corners: &[[f64; 2]]) -> Vec<DVec2> {
    corners.iter().map(|&c| DVec2::from_array(c)).collect()
}

fn golden() -> f64 {
    f64::midpoint(1.0, 5.0_f64.sqrt())
}

/// All points with these coordinates in cyclic order and any signs.
fn turns([x, y, z]: [f64; 3]) -> Vec<DVec3> {
    let mut points: Vec<DVec3> = Vec::new();
    for [x, y, z] in [[x, y, z], [y, z, x], [z, x, y]] {
        for signs in 0..8 {
            let sign = |bit: i32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
            // no negative zeros
            let p = DVec3::new(x * sign(0), y * sign(1), z * sign(2)) + DVec3::ZERO;
            if !points.contains(&p) {
                points.push(p);
            }
        }
    }
    points
}

/// Corners of a convex face in counter-clockwise order.
fn turned(points: &[DVec3], mut face: Vec<usize>, normal: DVec3) -> Vec<usize> {
    let middle = face.iter().map(|&p| points[p]).sum::<DVec3>() / face.len() as f64;
    let x = (points[face[0]] - middle).normalize_or_zero();
    let y = normal.cross(x);
    let angle = |p: usize| {
        let d = points[p] - middle;
        d.dot(y).atan2(d.dot(x))
    };
    face.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
    face
}

/// A box of edge 2 without the octant at its far corner.
fn notched_box() -> Result<Polyhedron, PolyhedronError> {
    let vertices: [[f64; 3]; 14] = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 2.0],
        [2.0, 0.0, 2.0],
        [0.0, 2.0, 2.0],
        [1.0, 1.0, 1.0],
        [2.0, 1.0, 1.0],
        [1.0, 2.0, 1.0],
        [1.0, 1.0, 2.0],
        [2.0, 2.0, 1.0],
        [2.0, 1.0, 2.0],
        [1.0, 2.0, 2.0],
    ];
    let faces: [&[usize]; 9] = [
        &[0, 3, 2, 1],
        &[0, 1, 5, 4],
        &[0, 4, 6, 3],
        &[1, 2, 11, 8, 12, 5],
        &[2, 3, 6, 13, 9, 11],
        &[4, 5, 12, 10, 13, 6],
        &[7, 9, 13, 10],
        &[7, 10, 12, 8],
        &[7, 8, 11, 9],
    ];
    let vertices = vertices.map(DVec3::from_array).to_vec();
    Polyhedron::new(vertices, faces.map(|f| vec![f.to_vec()]).to_vec(), &Planarity::default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_edges_and_holes_of_named_solids() {
        let counts = [
            ("tetrahedron", 4, 6, 2),
            ("dodecahedron", 12, 30, 2),
            ("icosahedron", 20, 30, 2),
            ("cuboctahedron", 14, 24, 2),
            ("truncated-octahedron", 14, 36, 2),
            ("truncated-icosahedron", 32, 90, 2),
            ("u-prism", 10, 24, 2),
            ("frame", 10, 24, 0),
        ];
        for (name, faces, edges, characteristic) in counts {
            let solid = Polyhedron::named(name).expect("a solid");
            assert_eq!(solid.facets().len(), faces, "{name}: faces");
            assert_eq!(solid.edge_count(), edges, "{name}: edges");
            assert_eq!(solid.euler_characteristic(), characteristic, "{name}");
        }
        assert!(SOLID_NAMES.iter().all(|name| Polyhedron::named(name).is_some()), "all names");
        assert_eq!(Polyhedron::named("sphere"), None);
    }

    #[test]
    fn the_dual_of_an_icosahedron() {
        let dual = Polyhedron::named("icosahedron").expect("a solid").dual().expect("a solid");
        assert_eq!(dual.facets().len(), 12);
        assert!(dual.facets().iter().all(|f| f.loops[0].len() == 5), "pentagons");
    }
}
