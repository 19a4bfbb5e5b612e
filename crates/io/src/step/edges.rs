//! Vertices and edges of a surface, written before its faces.

use std::io;

use glam::DVec3;

use super::StepFaces;
use super::document::Document;
use crate::patch_surface::PatchSurface;

/// A point that is also a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexInstance {
    pub(super) point: u64,
    pub(super) vertex: u64,
}

/// A curve between two vertices.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurveInstance {
    pub(super) edge: u64,
    /// The first of `degree - 1` inner control points, whose numbers follow each other.
    pub(super) inner: u64,
}

/// What was written for an edge of the surface.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EdgeInstance {
    /// The whole curve, where a face needs it.
    pub(super) whole: Option<CurveInstance>,
    /// Its two halves from the lower vertex, and the vertex between.
    pub(super) halves: Option<([CurveInstance; 2], VertexInstance)>,
}

pub(super) struct EdgeInstances {
    pub(super) vertices: Vec<VertexInstance>,
    pub(super) edges: Vec<EdgeInstance>,
    /// Edges of the file so far.
    pub(super) written: usize,
}

impl EdgeInstances {
    /// Writes all vertices and edges. Edges of triangles that become three faces are halved; if a
    /// quadrilateral has such an edge, the control points of the whole curve are written as well.
    pub(super) fn write(
        document: &mut Document<'_>,
        surface: &PatchSurface,
        faces: StepFaces,
    ) -> io::Result<Self> {
        let mut halved = vec![false; surface.edges().len()];
        let mut whole = vec![false; surface.edges().len()];
        for (face, polygon) in surface.faces().iter().enumerate() {
            let is_cut = polygon.corners().len() == 3 && faces == StepFaces::Quads;
            let wanted = if is_cut { &mut halved } else { &mut whole };
            surface.sides(face).iter().for_each(|&edge| wanted[edge] = true);
        }
        let mut vertices = Vec::with_capacity(surface.vertices().len());
        for &position in surface.vertices() {
            // a vertex that no face uses is not written
            vertices.push(match position.is_finite() {
                true => vertex(document, position)?,
                false => VertexInstance { point: 0, vertex: 0 },
            });
        }
        let mut instances = Self { vertices, edges: Vec::new(), written: 0 };
        for edge in 0..surface.edges().len() {
            let instance = instances.edge(document, surface, edge, halved[edge], whole[edge])?;
            instances.edges.push(instance);
        }
        Ok(instances)
    }

    fn edge(
        &mut self,
        document: &mut Document<'_>,
        surface: &PatchSurface,
        edge: usize,
        is_halved: bool,
        is_whole: bool,
    ) -> io::Result<EdgeInstance> {
        let ends = surface.edges()[edge].map(|vertex| self.vertices[vertex]);
        let points = surface.curve(edge);
        if !is_halved {
            self.written += 1;
            return Ok(EdgeInstance { whole: Some(curve(document, ends, points)?), halves: None });
        }
        let [first, second] = halves(points);
        let middle = vertex(document, second[0])?;
        let [start, end] = ends;
        let halves =
            [curve(document, [start, middle], &first)?, curve(document, [middle, end], &second)?];
        self.written += 2;
        let whole = match is_whole {
            // a net names its points; the halves are the edges
            true => {
                let inner = points[1..points.len() - 1].iter().copied();
                Some(CurveInstance { edge: 0, inner: document.points(inner)? })
            }
            false => None,
        };
        Ok(EdgeInstance { whole, halves: Some((halves, middle)) })
    }
}

fn vertex(document: &mut Document<'_>, position: DVec3) -> io::Result<VertexInstance> {
    let point = document.point(position)?;
    Ok(VertexInstance { point, vertex: document.vertex(point)? })
}

/// Writes the inner control points of a curve, and the edge.
pub(super) fn curve(
    document: &mut Document<'_>,
    [start, end]: [VertexInstance; 2],
    points: &[DVec3],
) -> io::Result<CurveInstance> {
    let count = points.len() as u64 - 2;
    let inner = document.points(points[1..points.len() - 1].iter().copied())?;
    let ids: Vec<u64> =
        [start.point].into_iter().chain(inner..inner + count).chain([end.point]).collect();
    let edge = document.edge([start.vertex, end.vertex], &ids)?;
    Ok(CurveInstance { edge, inner })
}

/// The control points of the two halves of a Bézier curve: the same bits from either end, because
/// each step is the mean of two numbers.
fn halves(points: &[DVec3]) -> [Vec<DVec3>; 2] {
    let mut level = points.to_vec();
    let (mut first, mut second) = (vec![level[0]], vec![level[level.len() - 1]]);
    while level.len() > 1 {
        level = level.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5).collect();
        first.push(level[0]);
        second.push(level[level.len() - 1]);
    }
    second.reverse();
    [first, second]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_do_not_depend_on_the_direction() {
        let points: Vec<_> =
            (0..8).map(|i| DVec3::new(f64::from(i).sqrt(), f64::from(i).sin(), 0.1)).collect();
        let [first, second] = halves(&points);
        let reversed: Vec<_> = points.iter().rev().copied().collect();
        let [mut other_second, mut other_first] = halves(&reversed);
        other_first.reverse();
        other_second.reverse();
        assert_eq!((&first, &second), (&other_first, &other_second));
        assert_eq!(first.last(), second.first());
    }
}
