//! Surfaces as files have them: flat triangles with normals.

use std::collections::BTreeSet;

use apatch::rational::RationalSurface;
use apatch::{Element, Tessellation};
use basemesh::glam::DVec3;
use basemesh::{EdgeMap, FaceMap};
use io::{CellData, CellValues, CreasedTessellation, Grid, GridCell};

use super::report::RationalFigures;

/// The triangles of a tessellation as files of flat triangles have them.
#[must_use]
pub fn triangles(tessellation: &Tessellation) -> CreasedTessellation {
    CreasedTessellation {
        positions: tessellation.positions.clone(),
        normals: tessellation.normals.clone(),
        triangles: tessellation.triangles.clone(),
        triangle_normals: tessellation.triangles.clone(),
    }
}

/// Distance between flat triangles, `along` steps on each side of a face and `across` over an edge, and
/// the surface: the largest one at the middles of the triangles. Unit: length.
#[must_use]
pub fn flat_gap(surface: &RationalSurface, along: usize, across: usize) -> f64 {
    let topology = surface.mesh().topology();
    let faces = FaceMap::from_fn(topology.face_count(), |face| {
        let point = |[u, v]: [f64; 2]| Some(surface.face_point(face, [1.0 - u - v, u, v])?.point);
        largest_gap(point, [along; 2], |i, j| i + j < along)
    });
    let edges = EdgeMap::from_fn(topology.edge_count(), |edge| {
        let point = |at: [f64; 2]| Some(surface.edge_point(edge, at)?.point);
        largest_gap(point, [along, across], |_, _| true)
    });
    faces.as_slice().iter().chain(edges.as_slice()).copied().fold(0.0, f64::max)
}

/// At the middles of the two triangles of each square of a grid of parameters; of those on the diagonal
/// of a triangular grid there is only the first.
fn largest_gap(
    point: impl Fn([f64; 2]) -> Option<DVec3>,
    steps: [usize; 2],
    is_inside: impl Fn(usize, usize) -> bool,
) -> f64 {
    let gap = |corners: [[usize; 2]; 3]| {
        let at = |[i, j]: [f64; 2]| point([i / steps[0] as f64, j / steps[1] as f64]);
        let [a, b, c] = corners.map(|[i, j]| at([i as f64, j as f64]));
        let sum = |axis: usize| corners.iter().map(|c| c[axis] as f64).sum::<f64>() / 3.0;
        let (a, middle) = (a?, at([sum(0), sum(1)])?);
        let normal = (b? - a).cross(c? - a).try_normalize()?;
        Some((middle - a).dot(normal).abs())
    };
    let mut largest: f64 = 0.0;
    for (i, j) in (0..steps[0]).flat_map(|i| (0..steps[1]).map(move |j| (i, j))) {
        if is_inside(i, j) {
            largest = largest.max(gap([[i, j], [i + 1, j], [i, j + 1]]).unwrap_or(0.0));
        }
        if is_inside(i + 1, j) {
            let second = [[i + 1, j], [i + 1, j + 1], [i, j + 1]];
            largest = largest.max(gap(second).unwrap_or(0.0));
        }
    }
    largest
}

/// The triangles of a tessellation as cells, with normals and these numbers for each cell:
/// `patch_kind` ([`apatch::PatchKind`]), `face` and `edge` (the id, or -1 if the patch is over the
/// other one), `invalid` (1 over an edge whose tetrahedra do not fit), and with `figures` `deviation`
/// over the diagonal and `normal_error_deg`.
#[must_use]
pub fn grid(
    surface: &RationalSurface,
    tessellation: &Tessellation,
    figures: Option<&RationalFigures>,
) -> Grid {
    let elements = &tessellation.elements;
    let integers =
        |value: &dyn Fn(&Element) -> i64| CellValues::Int64(elements.iter().map(value).collect());
    let id = |index: usize| i64::try_from(index).expect("invariant: ids fit 32 bits");
    let face = |element: &Element| match *element {
        Element::Face(face) => id(face.index()),
        Element::Edge(_) => -1,
    };
    let edge = |element: &Element| match *element {
        Element::Face(_) => -1,
        Element::Edge(edge) => id(edge.index()),
    };
    let invalid_edges: BTreeSet<usize> =
        surface.report().invalid_edges.iter().map(|found| found.edge).collect();
    let invalid = |element: &Element| match *element {
        Element::Face(_) => 0,
        Element::Edge(edge) => i64::from(invalid_edges.contains(&edge.index())),
    };
    let kinds = tessellation.kinds.iter().map(|&kind| i64::from(kind as u8)).collect();
    let mut data = vec![
        ("patch_kind", CellValues::Int64(kinds)),
        ("face", integers(&face)),
        ("edge", integers(&edge)),
        ("invalid", integers(&invalid)),
    ];
    if let Some(figures) = figures {
        let diagonal = surface.mesh().diagonal();
        let of = |element: &Element| match *element {
            Element::Face(face) => figures.faces[face],
            Element::Edge(edge) => figures.edges[edge],
        };
        let distances = elements.iter().map(|e| of(e).max / diagonal).collect();
        let angles = elements.iter().map(|e| of(e).max_normal.to_degrees()).collect();
        data.push(("deviation", CellValues::Float64(distances)));
        data.push(("normal_error_deg", CellValues::Float64(angles)));
    }
    Grid {
        points: tessellation.positions.clone(),
        normals: tessellation.normals.clone(),
        cells: tessellation.triangles.iter().map(|&t| GridCell::Triangle(t)).collect(),
        point_data: Vec::new(),
        cell_data: data
            .into_iter()
            .map(|(name, values)| CellData { name: name.to_owned(), values })
            .collect(),
    }
}
