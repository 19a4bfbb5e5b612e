//! Meshes on known surfaces, and how far patches are from them.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "each test file uses a part; helpers fail like tests"
)]

pub mod queries;

use nagata::basemesh::VertexId;
use nagata::bezier_core::Barycentric;
use nagata::glam::DVec3;
use nagata::{Apex, CornerNormals, NagataSurface, Patch, PolygonMesh, Settings};
pub use testkit::polygons::*;

/// One normal for each vertex, from the surface.
pub fn smooth(mesh: &PolygonMesh, surface: &KnownSurface) -> CornerNormals {
    CornerNormals::from_fn(mesh, |p| Some((surface.normal)(p)))
}

/// Grids as meshes.
pub trait GridMesh {
    fn mesh(&self) -> PolygonMesh;
}

impl GridMesh for Grid {
    fn mesh(&self) -> PolygonMesh {
        PolygonMesh::new(self.positions.clone(), &self.faces).unwrap()
    }
}

fn from_file(mesh: &PolygonMesh, file: &FileNormals) -> CornerNormals {
    let FileNormals { normals, corners } = file;
    CornerNormals::from_corners(mesh, normals, corners, CornerNormals::MERGE_ANGLE).unwrap()
}

/// Normals of the cylinder with discs: exact ones on the side, axial ones on the discs.
pub fn cylinder_normals(mesh: &PolygonMesh, rows: usize, n: usize) -> CornerNormals {
    from_file(mesh, &cylinder(n, rows, true).rimmed_normals(2 * rows * n, CYLINDER.normal))
}

pub fn cone_normals(mesh: &PolygonMesh, k: usize, apex: Apex) -> CornerNormals {
    let file = cone(k).rimmed_normals(cone_side_faces(k), CONE.normal);
    from_file(mesh, &file).with_apexes(mesh, &[VertexId::new(0)], apex)
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
    truth: &KnownSurface,
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
