//! One face after the other, cut into triangles.

use std::collections::HashMap;

use glam::DVec3;

use super::edges::CutEdges;
use super::error::ChordError;
use super::flatness::{finite, side, to_triangle};
use super::{between, on_side};
use crate::obj::Polygons;
use crate::samples::FacePoint;

/// More cuts than a reasonable tolerance needs; each one at least halves a side in some triangles.
const MAX_CUTS: usize = 60;

/// A point of the tessellation on one face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) id: usize,
    pub(super) at: FacePoint,
}

/// Cuts one face. Points are named by their index in `points`.
pub(super) struct FaceCutter<'a, F> {
    mesh: &'a Polygons,
    face: usize,
    tolerance: f64,
    edges: &'a mut CutEdges,
    evaluate: &'a F,
    points: Vec<Point>,
    /// Index of the point with each id.
    index_of: HashMap<usize, usize>,
    /// The middle of each side inside the face, by its ends in ascending order.
    cuts: HashMap<[usize; 2], Option<usize>>,
    pub(super) gap: f64,
}

impl<'a, F: Fn(usize, FacePoint) -> (DVec3, DVec3)> FaceCutter<'a, F> {
    pub(super) fn new(
        mesh: &'a Polygons,
        face: usize,
        tolerance: f64,
        edges: &'a mut CutEdges,
        evaluate: &'a F,
    ) -> Self {
        let (points, index_of, cuts) = (Vec::new(), HashMap::new(), HashMap::new());
        Self { mesh, face, tolerance, edges, evaluate, points, index_of, cuts, gap: 0.0 }
    }

    pub(super) fn into_points(self) -> Vec<Point> {
        self.points
    }

    /// The triangles of the face.
    pub(super) fn cut(&mut self) -> Result<Vec<[usize; 3]>, ChordError> {
        let corners = self.mesh.faces[self.face].corners();
        for (side, &id) in corners.iter().enumerate() {
            self.add(id, on_side(corners.len(), side, 0.0));
        }
        let mut waiting = match corners.len() {
            3 => vec![([0, 1, 2], 0)],
            _ => {
                let centre = self.new_point(FacePoint::Quad([0.5; 2]))?;
                vec![
                    ([3, 0, centre], 0),
                    ([2, 3, centre], 0),
                    ([1, 2, centre], 0),
                    ([0, 1, centre], 0),
                ]
            }
        };
        let mut done = Vec::new();
        while let Some((triangle, cuts)) = waiting.pop() {
            let parts = self.parts(triangle)?;
            if parts.is_empty() {
                done.push(triangle);
                continue;
            }
            if cuts == MAX_CUTS {
                let (face, tolerance) = (self.face, self.tolerance);
                return Err(ChordError::Face { face, tolerance, cuts });
            }
            waiting.extend(parts.into_iter().rev().map(|part| (part, cuts + 1)));
        }
        Ok(done)
    }

    /// What a triangle is cut into; nothing if it is near enough.
    fn parts(&mut self, [a, b, c]: [usize; 3]) -> Result<Vec<[usize; 3]>, ChordError> {
        let middles = [self.middle(a, b)?, self.middle(b, c)?, self.middle(c, a)?];
        Ok(match middles {
            [None, None, None] => match self.centre([a, b, c])? {
                Some(m) => vec![[a, b, m], [b, c, m], [c, a, m]],
                None => Vec::new(),
            },
            [Some(m), None, None] => vec![[a, m, c], [m, b, c]],
            [None, Some(m), None] => vec![[b, m, a], [m, c, a]],
            [None, None, Some(m)] => vec![[c, m, b], [m, a, b]],
            [Some(m), Some(n), None] => self.two([a, m, b, n, c]),
            [None, Some(m), Some(n)] => self.two([b, m, c, n, a]),
            [Some(n), None, Some(m)] => self.two([c, m, a, n, b]),
            [Some(l), Some(m), Some(n)] => vec![[a, l, n], [l, b, m], [n, m, c], [l, m, n]],
        })
    }

    /// A triangle `a b c` with the middles `m` of `a b` and `n` of `b c`: what is left of it beside
    /// `m b n` is cut along its shorter diagonal.
    fn two(&self, [a, m, b, n, c]: [usize; 5]) -> Vec<[usize; 3]> {
        let length = |p: usize, q: usize| self.position(p).distance(self.position(q));
        if length(a, n) <= length(m, c) {
            vec![[m, b, n], [a, m, n], [a, n, c]]
        } else {
            vec![[m, b, n], [a, m, c], [m, n, c]]
        }
    }

    /// The middle of a side if the side is cut.
    fn middle(&mut self, p: usize, q: usize) -> Result<Option<usize>, ChordError> {
        let ends = [self.points[p], self.points[q]];
        let key = [ends[0].id.min(ends[1].id), ends[0].id.max(ends[1].id)];
        if let Some(&cut) = self.edges.cuts.get(&key) {
            return Ok(cut.map(|id| match self.index_of.get(&id) {
                Some(&index) => index,
                None => self.add(id, between(ends[0].at, ends[1].at, 0.5)),
            }));
        }
        if let Some(&cut) = self.cuts.get(&key) {
            return Ok(cut);
        }
        let chord = [self.position(p), self.position(q)];
        let seen = side(self.face, ends.map(|end| end.at), chord, self.evaluate)?;
        let cut = if seen.gap <= self.tolerance {
            self.gap = self.gap.max(seen.gap);
            None
        } else {
            Some(self.new_point(between(ends[0].at, ends[1].at, 0.5))?)
        };
        self.cuts.insert(key, cut);
        Ok(cut)
    }

    /// The centre of a triangle if that is too far from the surface.
    fn centre(&mut self, triangle: [usize; 3]) -> Result<Option<usize>, ChordError> {
        let [a, b, c] = triangle.map(|index| self.points[index].at);
        let at = between(between(a, b, 0.5), c, 1.0 / 3.0);
        let position = finite(self.face, (self.evaluate)(self.face, at).0)?;
        let gap = to_triangle(position, triangle.map(|index| self.position(index)));
        if gap <= self.tolerance {
            self.gap = self.gap.max(gap);
            return Ok(None);
        }
        self.new_point(at).map(Some)
    }

    fn position(&self, index: usize) -> DVec3 {
        self.edges.positions[self.points[index].id]
    }

    fn new_point(&mut self, at: FacePoint) -> Result<usize, ChordError> {
        let position = finite(self.face, (self.evaluate)(self.face, at).0)?;
        let id = self.edges.positions.len();
        self.edges.positions.push(position);
        Ok(self.add(id, at))
    }

    fn add(&mut self, id: usize, at: FacePoint) -> usize {
        let index = self.points.len();
        self.points.push(Point { id, at });
        self.index_of.insert(id, index);
        index
    }
}
