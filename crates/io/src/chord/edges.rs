//! The edges of the mesh, cut before the faces.

use std::collections::HashMap;

use glam::DVec3;

use super::error::ChordError;
use super::flatness::{finite, side};
use super::on_side;
use crate::obj::Polygons;
use crate::samples::FacePoint;
use crate::shared_points::edges;

/// More halvings than a reasonable tolerance needs: a million pieces.
const MAX_HALVINGS: usize = 20;

/// The points of the tessellation so far: vertices, points inside edges, then points inside faces.
pub(super) struct CutEdges {
    pub(super) positions: Vec<DVec3>,
    /// The middle of each piece of an edge, by its ends in ascending order; `None` if it is not cut.
    pub(super) cuts: HashMap<[usize; 2], Option<usize>>,
    /// The mesh edge of each point after the vertices.
    edge_of: Vec<usize>,
    vertex_count: usize,
    is_smooth: Vec<bool>,
    pub(super) gap: f64,
}

/// What a point of the tessellation belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    Vertex(usize),
    /// Whether all faces have the same normals at both ends.
    Edge {
        is_smooth: bool,
    },
    Inside,
}

impl CutEdges {
    pub(super) fn place(&self, point: usize) -> Place {
        if point < self.vertex_count {
            return Place::Vertex(point);
        }
        match self.edge_of.get(point - self.vertex_count) {
            Some(&edge) => Place::Edge { is_smooth: self.is_smooth[edge] },
            None => Place::Inside,
        }
    }
}

/// Halves all edges until their pieces are within the tolerance.
pub(super) fn cut_edges(
    mesh: &Polygons,
    tolerance: f64,
    evaluate: &impl Fn(usize, FacePoint) -> (DVec3, DVec3),
) -> Result<CutEdges, ChordError> {
    let (ids, is_smooth) = edges(mesh);
    let mut owners = vec![None; ids.len()];
    for (face, polygon) in mesh.faces.iter().enumerate() {
        let corners = polygon.corners();
        for side in 0..corners.len() {
            let [a, b] = [corners[side], corners[(side + 1) % corners.len()]];
            finite(face, mesh.positions[a])?;
            let edge = ids.binary_search(&[a.min(b), a.max(b)]);
            let edge = edge.expect("invariant: a side has an edge");
            owners[edge].get_or_insert((face, side));
        }
    }
    let mut result = CutEdges {
        positions: mesh.positions.clone(),
        cuts: HashMap::new(),
        edge_of: Vec::new(),
        vertex_count: mesh.positions.len(),
        is_smooth,
        gap: 0.0,
    };
    for (edge, (ends, owner)) in ids.into_iter().zip(owners).enumerate() {
        let (face, side) = owner.expect("invariant: an edge belongs to a face");
        let corners = mesh.faces[face].corners();
        // from the lower vertex
        let is_forward = corners[side] == ends[0];
        let at = |t: f64| on_side(corners.len(), side, if is_forward { t } else { 1.0 - t });
        cut_edge(&mut result, edge, face, ends, at, tolerance, evaluate)?;
    }
    Ok(result)
}

#[allow(clippy::too_many_arguments, reason = "one edge of one face of one surface")]
fn cut_edge(
    result: &mut CutEdges,
    edge: usize,
    face: usize,
    ends: [usize; 2],
    at: impl Fn(f64) -> FacePoint,
    tolerance: f64,
    evaluate: &impl Fn(usize, FacePoint) -> (DVec3, DVec3),
) -> Result<(), ChordError> {
    let mut pieces = vec![(ends, [0.0, 1.0], 0)];
    while let Some((points, parameters, halvings)) = pieces.pop() {
        let chord = points.map(|id| result.positions[id]);
        let seen = side(face, parameters.map(&at), chord, evaluate)?;
        let key = [points[0].min(points[1]), points[0].max(points[1])];
        if seen.gap <= tolerance {
            result.gap = result.gap.max(seen.gap);
            result.cuts.insert(key, None);
            continue;
        }
        if halvings == MAX_HALVINGS {
            let [lower, higher] = ends;
            return Err(ChordError::Edge { lower, higher, tolerance, halvings });
        }
        let middle = result.positions.len();
        result.positions.push(seen.middle);
        result.edge_of.push(edge);
        result.cuts.insert(key, Some(middle));
        let half = 0.5 * (parameters[0] + parameters[1]);
        pieces.push(([middle, points[1]], [half, parameters[1]], halvings + 1));
        pieces.push(([points[0], middle], [parameters[0], half], halvings + 1));
    }
    Ok(())
}
