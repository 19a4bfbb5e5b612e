//! How long edges should be, from what was measured.

use basemesh::{FaceId, FaceMap, HalfedgeId, TriMesh, VertexId, VertexMap};

use crate::repair::edges_to_split;
use crate::surface::G1Surface;

/// Where the deviation is aimed at, as part of the tolerance: faces scatter around it.
const AIM: f64 = 0.35;
/// Where it is aimed at once the mesh has its shape.
const URGENT_AIM: f64 = 0.7;
/// A face with an error of more than this multiple of the aim is not left to the mean of its
/// neighbours.
const OUTLIER: f64 = 2.0;
/// Order of the deviation in the edge length.
const ORDER: f64 = 6.0;
/// Most that one round changes a length.
const SHRINK: f64 = 0.5;
const GROW: f64 = 1.6;
/// What a refining round changes at least, and at most.
const LEAST: f64 = 0.9;
const MOST: f64 = 0.6;
/// By how much wishes grow from one refining round to the next: a face within the range of lengths
/// that the remesher accepts would stay as it is.
const STUBBORN: f64 = 0.95;

/// A length for every vertex, so that all faces come close to the same deviation.
pub(super) fn all_wishes(mesh: &TriMesh, excess: &FaceMap<f64>) -> VertexMap<Option<f64>> {
    even_wishes(mesh, excess, AIM)
}

/// A length for every vertex, so that the error of all faces comes close to `aim`.
pub(super) fn even_wishes(
    mesh: &TriMesh,
    errors: &FaceMap<f64>,
    aim: f64,
) -> VertexMap<Option<f64>> {
    let topology = mesh.topology();
    let factor = |face: FaceId| stretch(errors[face], aim).ln();
    let limit = |face: FaceId| stretch(errors[face], OUTLIER * aim);
    VertexMap::from_fn(topology.vertex_count(), |vertex| {
        let faces = || topology.fan(vertex).map(HalfedgeId::face);
        let mean = faces().map(factor).sum::<f64>() / faces().count() as f64;
        let limit = faces().map(limit).fold(f64::INFINITY, f64::min);
        Some(length_at(mesh, vertex) * mean.exp().min(limit))
    })
}

/// The error, at most one, at which faces of these errors, with their edges changed accordingly,
/// would be `count`: the number of faces falls with the square of the length.
pub(super) fn aim_for(errors: &FaceMap<f64>, count: f64) -> f64 {
    let faces = |aim: f64| errors.as_slice().iter().map(|&e| stretch(e, aim).powi(-2)).sum::<f64>();
    let mut range = [f64::EPSILON.powi(2).ln(), 0.0];
    for _ in 0..60 {
        let middle = 0.5 * (range[0] + range[1]);
        range[usize::from(faces(middle.exp()) < count)] = middle;
    }
    range[0].exp()
}

/// The factor for the edge lengths of a face that makes its error about `aim`.
fn stretch(error: f64, aim: f64) -> f64 {
    (aim / error).powf(1.0 / ORDER).clamp(SHRINK, GROW)
}

/// Shorter lengths at the corners of faces that exceed the tolerance and of edges that the mesh does
/// not resolve; `None` if there are none.
pub(super) fn urgent_wishes(
    surface: &G1Surface,
    excess: &FaceMap<f64>,
    round: usize,
) -> Option<VertexMap<Option<f64>>> {
    let topology = surface.mesh.topology();
    let stubborn = STUBBORN.powi(i32::try_from(round).unwrap_or(i32::MAX));
    let mut factors: Vec<Option<f64>> = vec![None; topology.vertex_count()];
    let mut wish = |vertex: VertexId, factor: f64| {
        let slot = &mut factors[vertex.index()];
        *slot = Some(slot.map_or(factor, |other| other.min(factor)));
    };
    for (face, &excess) in excess.iter().filter(|(_, excess)| **excess > 1.0) {
        let factor = (URGENT_AIM / excess).powf(1.0 / ORDER).clamp(MOST, LEAST) * stubborn;
        topology.corners(face).into_iter().for_each(|vertex| wish(vertex, factor));
    }
    for edge in edges_to_split(&surface.mesh, &surface.jets, &surface.curves) {
        topology.edge_vertices(edge).into_iter().for_each(|vertex| wish(vertex, MOST));
    }
    if factors.iter().all(Option::is_none) {
        return None;
    }
    Some(VertexMap::from_fn(topology.vertex_count(), |vertex| {
        factors[vertex.index()].map(|factor| factor * length_at(&surface.mesh, vertex))
    }))
}

/// The edge length of equilateral triangles as large as those around a vertex.
fn length_at(mesh: &TriMesh, vertex: VertexId) -> f64 {
    let topology = mesh.topology();
    let area = |face| {
        let [p, q, r] = mesh.triangle(face);
        0.5 * (q - p).cross(r - p).length()
    };
    let faces = || topology.fan(vertex).map(HalfedgeId::face);
    let mean = faces().map(area).sum::<f64>() / faces().count() as f64;
    (mean * 4.0 / 3.0_f64.sqrt()).sqrt()
}
