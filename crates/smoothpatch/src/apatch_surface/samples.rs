//! Points of single patches with normals that are as long as the area around them.

use apatch::rational::{RationalSurface, SurfacePoint};
use basemesh::glam::DVec3;
use basemesh::{EdgeId, FaceId};

use crate::measure::PatchSamples;

/// The patch over a face, on a lattice with `n` steps along each side.
pub(super) fn face_samples(surface: &RationalSurface, face: FaceId, n: usize) -> PatchSamples {
    let mut rows = Vec::with_capacity(n + 1);
    for i in 0..=n {
        let at = |j: usize| [n - i - j, i, j].map(|steps| steps as f64 / n as f64);
        rows.push((0..=n - i).map(|j| surface.face_point(face, at(j))).collect::<Vec<_>>());
    }
    weighted(&rows)
}

/// The patch over an edge, on a grid with `n` steps along it and half as many across.
pub(super) fn edge_samples(surface: &RationalSurface, edge: EdgeId, n: usize) -> PatchSamples {
    if surface.edge(edge).sides.iter().all(Option::is_none) {
        return PatchSamples::default();
    }
    let m = n.div_ceil(2);
    let at = |i: usize, j: usize| [i as f64 / n as f64, j as f64 / m as f64];
    let row = |i: usize| (0..=m).map(move |j| surface.edge_point(edge, at(i, j))).collect();
    let rows: Vec<Vec<_>> = (0..=n).map(row).collect();
    weighted(&rows)
}

/// Gives each point a third of the area of the triangles around it. Points that are missing, or have
/// no normal or no area around them, are left out.
fn weighted(rows: &[Vec<Option<SurfacePoint>>]) -> PatchSamples {
    let mut areas: Vec<Vec<f64>> = rows.iter().map(|row| vec![0.0; row.len()]).collect();
    for i in 1..rows.len() {
        for j in 1..rows[i - 1].len() {
            let mut triangle = |corners: [[usize; 2]; 3]| {
                let point = |[i, j]: [usize; 2]| rows[i].get(j).copied().flatten();
                if let [Some(a), Some(b), Some(c)] = corners.map(point) {
                    let area = (b.point - a.point).cross(c.point - a.point).length() / 2.0;
                    corners.iter().for_each(|&[i, j]| areas[i][j] += area / 3.0);
                }
            };
            triangle([[i - 1, j - 1], [i - 1, j], [i, j - 1]]);
            triangle([[i, j - 1], [i - 1, j], [i, j]]);
        }
    }
    let points = rows.iter().flatten().zip(areas.iter().flatten());
    points
        .filter_map(|(point, area)| point.map(|p| (p.point, p.normal() * *area)))
        .filter(|(_, normal)| *normal != DVec3::ZERO)
        .collect()
}
