//! Surfaces to simplify towards, and meshes to start from.

use std::f64::consts::TAU;

use basemesh::glam::DVec3;
use basemesh::{Foot, SurfaceTarget, TriMesh, VertexId};
#[cfg(feature = "polygonize")]
use implicit::{ImplicitField, ProjectionSettings, project_with_gradient};

/// A field seen as the target of a mesh of size `length`.
#[cfg(feature = "polygonize")]
pub(crate) struct FieldTarget<'a> {
    pub(crate) field: &'a dyn ImplicitField,
    pub(crate) length: f64,
}

#[cfg(feature = "polygonize")]
impl SurfaceTarget for FieldTarget<'_> {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        project_with_gradient(self.field, near, self.length, &ProjectionSettings::default())
            .ok()
            .map(|(point, normal)| Foot { point, normal })
    }
}

/// Spheres around `centers`; the nearest one counts.
pub(crate) struct Spheres {
    pub(crate) centers: Vec<DVec3>,
    pub(crate) radius: f64,
}

impl Spheres {
    pub(crate) fn unit() -> Self {
        Self { centers: vec![DVec3::ZERO], radius: 1.0 }
    }
}

impl SurfaceTarget for Spheres {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let nearest = |a: &&DVec3, b: &&DVec3| {
            near.distance_squared(**a).total_cmp(&near.distance_squared(**b))
        };
        let center = *self.centers.iter().min_by(nearest)?;
        let normal = (near - center).try_normalize()?;
        Some(Foot { point: center + self.radius * normal, normal })
    }
}

/// A torus around the z axis.
pub(crate) struct Torus {
    pub(crate) major: f64,
    pub(crate) minor: f64,
}

impl SurfaceTarget for Torus {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let axis = self.major * near.with_z(0.0).try_normalize()?;
        let normal = (near - axis).try_normalize()?;
        Some(Foot { point: axis + self.minor * normal, normal })
    }
}

/// Another target in a larger unit of length.
pub(crate) struct Scaled<'a> {
    pub(crate) inner: &'a dyn SurfaceTarget,
    pub(crate) factor: f64,
}

impl SurfaceTarget for Scaled<'_> {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        let Foot { point, normal } = self.inner.foot(near / self.factor)?;
        Some(Foot { point: self.factor * point, normal })
    }
}

/// A target that has feet only above the plane z = `floor`.
pub(crate) struct Above<'a> {
    pub(crate) inner: &'a dyn SurfaceTarget,
    pub(crate) floor: f64,
}

impl SurfaceTarget for Above<'_> {
    fn foot(&self, near: DVec3) -> Option<Foot> {
        if near.z < self.floor { None } else { self.inner.foot(near) }
    }
}

/// An octahedron whose faces are cut into `n²` triangles, on the unit sphere around `center`.
pub(crate) fn sphere_mesh(n: usize, center: DVec3) -> TriMesh {
    let mut soup = Vec::new();
    for signs in 0..8 {
        let sign = |bit: usize| if signs & bit == 0 { 1.0 } else { -1.0 };
        let point = |i: usize, j: usize| {
            let [x, y, z] = [i, j, n - i - j].map(|k| k as f64);
            DVec3::new(sign(1) * x, sign(2) * y, sign(4) * z).normalize()
        };
        let even = sign(1) * sign(2) * sign(4) > 0.0;
        let mut push = |t: [DVec3; 3]| soup.push(if even { t } else { [t[0], t[2], t[1]] });
        for i in 0..n {
            for j in 0..n - i {
                push([point(i, j), point(i + 1, j), point(i, j + 1)]);
                if i + j + 2 <= n {
                    push([point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
                }
            }
        }
    }
    let mesh = weld(&soup);
    map_positions(mesh, |_, p| p + center)
}

/// Triangles that share equal corners as a mesh.
fn weld(soup: &[[DVec3; 3]]) -> TriMesh {
    let mut ids = std::collections::HashMap::new();
    let mut positions = Vec::new();
    let faces: Vec<[usize; 3]> = soup
        .iter()
        .map(|t| {
            t.map(|p| {
                // adding zero makes the two signs of zero equal
                let key = (p + DVec3::ZERO).to_array().map(f64::to_bits);
                *ids.entry(key).or_insert_with(|| {
                    positions.push(p);
                    positions.len() - 1
                })
            })
        })
        .collect();
    TriMesh::new(positions, &faces).unwrap()
}

/// A torus as a grid of `n` times `m` quadrilaterals cut in two.
pub(crate) fn torus_mesh(torus: &Torus, n: usize, m: usize) -> TriMesh {
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..m {
            let (u, v) = (TAU * i as f64 / n as f64, TAU * j as f64 / m as f64);
            let r = torus.major + torus.minor * v.cos();
            positions.push(DVec3::new(r * u.cos(), r * u.sin(), torus.minor * v.sin()));
            let id = |i: usize, j: usize| (i % n) * m + j % m;
            let (a, b, c, d) = (id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriMesh::new(positions, &faces).unwrap()
}

/// The same mesh with other positions.
pub(crate) fn map_positions(mesh: TriMesh, f: impl Fn(usize, DVec3) -> DVec3 + Sync) -> TriMesh {
    let positions = mesh.positions().map(|v: VertexId, &p| f(v.index(), p));
    mesh.with_positions(positions).unwrap()
}

/// A pseudo-random vector with coordinates in -1..1, the same for the same seed and index.
pub(crate) fn noise(seed: u64, index: usize) -> DVec3 {
    let mut state = seed ^ (index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut next = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64 * 2.0 - 1.0
    };
    DVec3::new(next(), next(), next())
}

/// Several meshes as one.
pub(crate) fn together(meshes: &[TriMesh]) -> TriMesh {
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    for mesh in meshes {
        let first = positions.len();
        positions.extend_from_slice(mesh.positions().as_slice());
        faces.extend(mesh.face_indices().iter().map(|f| f.map(|v| v + first)));
    }
    TriMesh::new(positions, &faces).unwrap()
}

/// Largest distance of a vertex from the target.
pub(crate) fn largest_distance(mesh: &TriMesh, target: &dyn SurfaceTarget) -> f64 {
    mesh.positions()
        .as_slice()
        .iter()
        .map(|&p| target.foot(p).unwrap().point.distance(p))
        .fold(0.0, f64::max)
}
