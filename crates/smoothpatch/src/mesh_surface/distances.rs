//! How far the points of a mesh are from patches.

use basemesh::glam::DVec3;
use basemesh::{FaceId, FaceMap, TriMesh, VertexMap};
use bezier_core::{Barycentric, SepticTriangle};
use meshfield::TriangleTree;
use serde::{Deserialize, Serialize};

use crate::measure::GRID;

/// Divisions of the flat triangles among which the nearest one is looked for.
const COARSE: usize = 4;
/// Steps from there to the closest point of the patch.
const STEPS: usize = 20;
/// Steps end when they move the point by less than this part of its patch.
const SETTLED: f64 = 1e-10;
/// Divisions of the lattice of samples on each triangle of the mesh.
const SAMPLES: usize = 4;

/// Distances of the input mesh from the patches, over the diagonal of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshDistances {
    /// Diagonal of the bounding box of the mesh, which all distances are relative to.
    pub diagonal: f64,
    /// Of the vertices of the mesh.
    pub vertices: Distances,
    /// Of other points of its flat triangles: on coarse meshes mostly how far a chord is from its arc.
    pub triangle_samples: Distances,
    /// Of points of the patches from the flat triangles.
    pub patch_samples: Distances,
}

impl MeshDistances {
    /// The largest one of all, in both directions.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.vertices.max.max(self.triangle_samples.max).max(self.patch_samples.max)
    }
}

/// Distances of some points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distances {
    /// Number of points.
    pub points: usize,
    /// The largest distance.
    pub max: f64,
    /// The root mean square.
    pub rms: f64,
    /// The vertex or triangle of the mesh, or the patch, with the largest one, counted from 0.
    pub worst: usize,
}

/// Measures how far a mesh is from patches: its vertices, and samples inside its triangles and edges; and
/// the other way round the farthest of 153 points of each patch.
///
/// # Panics
///
/// If there are no patches or no triangles, or control points are not finite.
#[must_use]
pub fn mesh_distances(mesh: &TriMesh, nets: &FaceMap<SepticTriangle>) -> MeshDistances {
    let patches = Patches::new(nets);
    let topology = mesh.topology();
    let vertices = VertexMap::from_fn(topology.vertex_count(), |vertex| {
        patches.distance(mesh.position(vertex))
    });
    let samples: Vec<Barycentric> = Barycentric::lattice(SAMPLES)
        .filter(|at| at.to_array().iter().all(|&weight| weight < 1.0))
        .collect();
    let faces = FaceMap::from_fn(topology.face_count(), |face| {
        let [a, b, c] = mesh.triangle(face);
        let distance = |at: &Barycentric| patches.distance(a * at.u + b * at.v + c * at.w);
        samples.iter().map(distance).collect::<Vec<f64>>()
    });
    let triangles = TriangleTree::new(topology.faces().map(|face| mesh.triangle(face)).collect());
    let from_triangles = nets.map(|_, net| {
        let distance = |at: Barycentric| {
            triangles
                .closest(net.eval(at))
                .expect("invariant: finite patches and triangles")
                .distance
        };
        Barycentric::lattice(GRID).map(distance).fold(0.0, f64::max)
    });
    let diagonal = mesh.diagonal();
    let of_patches = from_triangles.iter().map(|(patch, &d)| (patch.index(), d));
    let of_vertices = vertices.as_slice().iter().copied().enumerate();
    let of_samples =
        faces.iter().flat_map(|(face, all)| all.iter().map(move |&d| (face.index(), d)));
    MeshDistances {
        diagonal,
        vertices: summary(of_vertices, diagonal),
        triangle_samples: summary(of_samples, diagonal),
        patch_samples: summary(of_patches, diagonal),
    }
}

fn summary(distances: impl Iterator<Item = (usize, f64)>, diagonal: f64) -> Distances {
    let mut found = Distances { points: 0, max: 0.0, rms: 0.0, worst: 0 };
    for (element, distance) in distances {
        let distance = distance / diagonal;
        found.points += 1;
        found.rms += distance * distance;
        if distance > found.max {
            (found.max, found.worst) = (distance, element);
        }
    }
    found.rms = (found.rms / found.points.max(1) as f64).sqrt();
    found
}

/// Patches, ready for the search of closest points.
struct Patches<'a> {
    nets: &'a FaceMap<SepticTriangle>,
    tree: TriangleTree,
    /// The parts of each patch, as parameters of their corners.
    parts: Vec<[Barycentric; 3]>,
}

impl<'a> Patches<'a> {
    fn new(nets: &'a FaceMap<SepticTriangle>) -> Self {
        let parts = parts();
        let of_patch = nets.map(|_, net| {
            parts.iter().map(|corners| corners.map(|at| net.eval(at))).collect::<Vec<_>>()
        });
        let tree = TriangleTree::new(of_patch.into_vec().into_iter().flatten().collect());
        Self { nets, tree, parts }
    }

    /// Distance of a point from the patches: from the nearest flat part downhill to a point of the patch
    /// where no step along it comes closer.
    fn distance(&self, p: DVec3) -> f64 {
        let near = self.tree.closest(p).expect("invariant: finite patches and points");
        let (patch, part) = (near.triangle / self.parts.len(), near.triangle % self.parts.len());
        let net = &self.nets[FaceId::new(patch)];
        let corners = self.parts[part];
        let weighted = |k: usize| -> f64 {
            corners.iter().zip(near.weights).map(|(at, w)| at.to_array()[k] * w).sum()
        };
        let mut at = Barycentric::from_array([weighted(0), weighted(1), weighted(2)]);
        let mut best = net.eval(at).distance(p);
        for _ in 0..STEPS {
            let Some(next) = step(net, at, p) else { break };
            let distance = net.eval(next).distance(p);
            if distance >= best {
                break;
            }
            best = distance;
            let moved = (next.u - at.u).abs() + (next.v - at.v).abs();
            at = next;
            if moved < SETTLED {
                break;
            }
        }
        best
    }
}

/// The foot of `p` in the tangent plane at `at`, as a parameter of the patch.
fn step(net: &SepticTriangle, at: Barycentric, p: DVec3) -> Option<Barycentric> {
    let [a, b, c] = net.last_triangle(at);
    let point = a * at.u + b * at.v + c * at.w;
    let (du, dv) = ((a - c) * 7.0, (b - c) * 7.0);
    let (e, f, g) = (du.dot(du), du.dot(dv), dv.dot(dv));
    let (r, s) = (du.dot(p - point), dv.dot(p - point));
    let determinant = e * g - f * f;
    let (u, v) = ((g * r - f * s) / determinant, (e * s - f * r) / determinant);
    // back into the triangle, if the step leaves it
    let [u, v, w] = [at.u + u, at.v + v, at.w - u - v].map(|x| x.max(0.0));
    let sum = u + v + w;
    let next = [u / sum, v / sum, w / sum];
    next.iter().all(|x| x.is_finite()).then_some(Barycentric::from_array(next))
}

/// A triangle cut into equal parts.
fn parts() -> Vec<[Barycentric; 3]> {
    let n = COARSE;
    let at = |i: usize, j: usize| {
        let [u, v] = [i, j].map(|k| k as f64 / n as f64);
        Barycentric::from_array([u, v, (n - i - j) as f64 / n as f64])
    };
    let mut parts = Vec::with_capacity(n * n);
    for i in 0..n {
        for j in 0..n - i {
            parts.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
            if i + j + 2 <= n {
                parts.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
    parts
}
