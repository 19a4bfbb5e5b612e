//! The faces of a surface, written after its edges.

use std::io;

use glam::DVec3;

use super::StepFaces;
use super::degenerate;
use super::document::Document;
use super::edges::{CurveInstance, EdgeInstances, VertexInstance, curve};
use super::three_quads::ThreeQuads;
use crate::patch_surface::{PatchNet, PatchSurface};

/// Writes face after face.
pub(super) struct FaceWriter<'a> {
    surface: &'a PatchSurface,
    edges: &'a EdgeInstances,
    kind: StepFaces,
    three_quads: ThreeQuads,
    /// Faces of the file so far.
    pub(super) written: usize,
    /// Edges of the file inside triangles.
    pub(super) inner_edges: usize,
}

/// A boundary row of a surface: its ends, and the first inner control point.
#[derive(Clone, Copy)]
struct Row {
    start: u64,
    end: u64,
    inner: u64,
    is_forward: bool,
}

impl Row {
    /// The control point so many steps from the start.
    fn at(&self, step: usize, degree: usize) -> u64 {
        let (step, degree) = (step as u64, degree as u64);
        match step {
            0 => self.start,
            _ if step == degree => self.end,
            _ if self.is_forward => self.inner + step - 1,
            _ => self.inner + degree - step - 1,
        }
    }

    fn reversed(self) -> Self {
        Self { start: self.end, end: self.start, is_forward: !self.is_forward, ..self }
    }
}

/// One half of a side of a triangle, in the direction of the side.
#[derive(Clone, Copy)]
struct Half {
    row: Row,
    edge: (u64, bool),
}

impl<'a> FaceWriter<'a> {
    pub(super) fn new(
        surface: &'a PatchSurface,
        edges: &'a EdgeInstances,
        kind: StepFaces,
    ) -> Self {
        let three_quads = ThreeQuads::new(surface.degree());
        Self { surface, edges, kind, three_quads, written: 0, inner_edges: 0 }
    }

    /// Writes a face of the surface and adds the numbers of the faces of the file.
    pub(super) fn write(
        &mut self,
        document: &mut Document<'_>,
        face: usize,
        ids: &mut Vec<u64>,
    ) -> io::Result<()> {
        let before = ids.len();
        match (self.surface.net(face), self.kind) {
            (PatchNet::Triangle(net), StepFaces::Quads) => {
                ids.extend(self.three_quads(document, face, net)?);
                self.inner_edges += 3;
            }
            (PatchNet::Triangle(net), StepFaces::Degenerate) => {
                ids.push(self.degenerate(document, face, net)?);
            }
            (PatchNet::Quad(net), _) => ids.push(self.quad(document, face, net)?),
        }
        self.written += ids.len() - before;
        Ok(())
    }

    /// The boundary row along a side, in its direction.
    fn row(&self, face: usize, side: usize) -> Row {
        let corners = self.surface.faces()[face].corners();
        let [start, end] = [side, (side + 1) % corners.len()]
            .map(|corner| self.edges.vertices[corners[corner]].point);
        let edge = self.edges.edges[self.surface.sides(face)[side]];
        let inner = edge.whole.expect("invariant: written for faces that are not cut").inner;
        Row { start, end, inner, is_forward: self.surface.runs_forward(face, side) }
    }

    /// The edges of the file along a side, in its direction.
    fn side(&self, face: usize, side: usize) -> Vec<(u64, bool)> {
        let is_forward = self.surface.runs_forward(face, side);
        let edge = self.edges.edges[self.surface.sides(face)[side]];
        let mut edges = match (edge.halves, edge.whole) {
            (Some((halves, _)), _) => halves.map(|half| (half.edge, is_forward)).to_vec(),
            (None, Some(whole)) => vec![(whole.edge, is_forward)],
            (None, None) => unreachable!("invariant: every edge is written"),
        };
        if !is_forward {
            edges.reverse();
        }
        edges
    }

    fn quad(&self, document: &mut Document<'_>, face: usize, net: &[DVec3]) -> io::Result<u64> {
        let n = self.surface.degree();
        let inner = inner_points(document, n, |i, j| net[j * (n + 1) + i])?;
        let [bottom, right, top, left] = [0, 1, 2, 3].map(|side| self.row(face, side));
        let rows = [bottom, right, top.reversed(), left.reversed()];
        let sides: Vec<_> = (0..4).flat_map(|side| self.side(face, side)).collect();
        document.face(n, |i, j| in_net(n, &rows, inner, i, j), &sides)
    }

    fn degenerate(
        &self,
        document: &mut Document<'_>,
        face: usize,
        net: &[DVec3],
    ) -> io::Result<u64> {
        let n = self.surface.degree();
        let inner = inner_points(document, n, |a, b| degenerate::point(n, net, a, b))?;
        let [first, opposite, last] = [0, 1, 2].map(|side| self.row(face, side));
        let last = last.reversed();
        let point = |a: usize, b: usize| match (a, b) {
            (0, _) => first.start,
            (_, 0) => first.at(a, n),
            _ if b == n => last.at(a, n),
            _ if a == n => opposite.at(b, n),
            _ => inner + ((b - 1) * (n - 1) + a - 1) as u64,
        };
        let sides: Vec<_> = (0..3).flat_map(|side| self.side(face, side)).collect();
        document.face(n, point, &sides)
    }

    fn three_quads(
        &self,
        document: &mut Document<'_>,
        face: usize,
        net: &[DVec3],
    ) -> io::Result<[u64; 3]> {
        let n = self.surface.degree();
        let point = document.point(self.three_quads.point(net, 0, n, n))?;
        let centre = VertexInstance { point, vertex: document.vertex(point)? };
        let corners = self.surface.faces()[face].corners();
        let mut spokes = Vec::with_capacity(3);
        for corner in 0..3 {
            spokes.push(self.spoke(document, face, net, corner, centre)?);
        }
        let mut faces = [0; 3];
        for (corner, id) in faces.iter_mut().enumerate() {
            let before = (corner + 2) % 3;
            let start = self.edges.vertices[corners[corner]].point;
            let (leaving, middle) = self.half(face, corner, 0, start);
            let (arriving, middle_before) = self.half(face, before, 1, start);
            let [right, top] = [(corner, middle), (before, middle_before)].map(|(at, middle)| {
                let inner = spokes[at].inner;
                Row { start: middle, end: centre.point, inner, is_forward: true }
            });
            let rows = [leaving.row, right, top, arriving.row.reversed()];
            let at = |i, j| self.three_quads.point(net, corner, i, j);
            let inner = inner_points(document, n, at)?;
            let sides = [
                leaving.edge,
                (spokes[corner].edge, true),
                (spokes[before].edge, false),
                arriving.edge,
            ];
            *id = document.face(n, |i, j| in_net(n, &rows, inner, i, j), &sides)?;
        }
        Ok(faces)
    }

    /// The curve from the middle of the side that starts at a corner to the centre.
    fn spoke(
        &self,
        document: &mut Document<'_>,
        face: usize,
        net: &[DVec3],
        corner: usize,
        centre: VertexInstance,
    ) -> io::Result<CurveInstance> {
        let n = self.surface.degree();
        let edge = self.edges.edges[self.surface.sides(face)[corner]];
        let (_, middle) = edge.halves.expect("invariant: edges of triangles are halved");
        let points: Vec<_> = (0..=n).map(|j| self.three_quads.point(net, corner, n, j)).collect();
        curve(document, [middle, centre], &points)
    }

    /// The first or second half of a side, in its direction, and the point in the middle; `corner`
    /// is the point at the other end.
    fn half(&self, face: usize, side: usize, half: usize, corner: u64) -> (Half, u64) {
        let is_forward = self.surface.runs_forward(face, side);
        let edge = self.edges.edges[self.surface.sides(face)[side]];
        let (halves, middle) = edge.halves.expect("invariant: edges of triangles are halved");
        let piece = halves[if is_forward { half } else { 1 - half }];
        let [start, end] = if half == 0 { [corner, middle.point] } else { [middle.point, corner] };
        let row = Row { start, end, inner: piece.inner, is_forward };
        (Half { row, edge: (piece.edge, is_forward) }, middle.point)
    }
}

/// Writes the inner control points of a net; returns the first, rows of `j` one after the other.
fn inner_points(
    document: &mut Document<'_>,
    degree: usize,
    at: impl Fn(usize, usize) -> DVec3,
) -> io::Result<u64> {
    let at = &at;
    document.points((1..degree).flat_map(|j| (1..degree).map(move |i| at(i, j))))
}

/// The control point `(i, j)` of a net with the boundary rows `j = 0`, `i = n`, `j = n`, `i = 0`.
fn in_net(n: usize, [bottom, right, top, left]: &[Row; 4], inner: u64, i: usize, j: usize) -> u64 {
    match (i, j) {
        (_, 0) => bottom.at(i, n),
        _ if i == n => right.at(j, n),
        _ if j == n => top.at(i, n),
        (0, _) => left.at(j, n),
        _ => inner + ((j - 1) * (n - 1) + i - 1) as u64,
    }
}
