//! Points of the surface by their parameters.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

use super::edge::EdgePatch;
use super::face::{FacePatch, ON_SURFACE, dot, side_of};
use super::kinds::Side;
use super::lanes::{EdgeSolver, FaceFeet, FaceSolver, LANES, Queue};
use super::surface::RationalSurface;
use crate::cubic_root::RayCubic;
use crate::tetrahedron::gradient;

/// A point of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub point: DVec3,
    /// Gradient of the function: normal to the surface, to the positive side, not of unit length.
    pub gradient: DVec3,
    /// How far along its transversal, from 0 on the mesh to 1 at the apices.
    pub t: f64,
    /// The side; `None` for a point on the mesh.
    pub side: Option<Side>,
}

impl SurfacePoint {
    /// Unit normal, to the positive side; zero at a singular point.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.gradient.normalize_or_zero()
    }
}

impl FacePatch {
    /// The point of the surface on the transversal from barycentric coordinates `x` of the triangle;
    /// `None` if the function has no root there, which the report of the surface tells.
    #[inline]
    #[must_use]
    pub fn point(&self, x: [f64; 3]) -> Option<SurfacePoint> {
        let feet = FaceFeet::new(&self.base, &[x]);
        let Some((side, _)) = self.side_at(feet.value[0]) else { return Some(self.on_mesh(x)) };
        let mut found = [None];
        FaceSolver::new(self, side)?.points(&feet, &mut found);
        found[0]
    }

    /// Appends the points for many barycentric coordinates: the same as one by one, bit for bit, in
    /// less time.
    pub fn points(&self, at: &[[f64; 3]], out: &mut Vec<Option<SurfacePoint>>) {
        let first = out.len();
        out.resize(first + at.len(), None);
        let out = &mut out[first..];
        let solvers = Side::BOTH.map(|side| FaceSolver::new(self, side));
        let mut queues = [Queue::default(); 2];
        let mut sort_in = |place: usize, row: [f64; 7], out: &mut [Option<SurfacePoint>]| {
            let side = side_of(row[3]).index();
            match &solvers[side] {
                Some(solver) if solver.takes(row[3]) => {
                    queues[side].push(place, row);
                    if queues[side].is_full() {
                        queues[side].empty::<LANES>(out, |rows, points| {
                            solver.points(&FaceFeet::from_rows(rows), points);
                        });
                    }
                }
                _ => out[place] = Some(self.on_mesh([row[0], row[1], row[2]])),
            }
        };
        let (eights, rest) = at.as_chunks::<LANES>();
        for (part, eight) in eights.iter().enumerate() {
            let (start, feet) = (part * LANES, FaceFeet::new(&self.base, eight));
            // most often all go the same way
            match solvers.iter().flatten().find(|s| feet.value.iter().all(|&v| s.takes(v))) {
                Some(solver) => solver.points(&feet, &mut out.as_chunks_mut().0[part]),
                None => (0..LANES).for_each(|i| sort_in(start + i, feet.row(i), out)),
            }
        }
        for (i, &x) in rest.iter().enumerate() {
            sort_in(eights.len() * LANES + i, FaceFeet::new(&self.base, &[x]).row(0), out);
        }
        for (queue, solver) in queues.iter_mut().zip(&solvers) {
            let Some(solver) = solver else { continue };
            while !queue.is_empty() {
                queue.empty::<2>(out, |rows, points| {
                    solver.points(&FaceFeet::from_rows(rows), points);
                });
            }
        }
    }

    #[inline]
    fn foot(&self, x: [f64; 3]) -> DVec3 {
        self.corners[0] * x[0] + self.corners[1] * x[1] + self.corners[2] * x[2]
    }

    /// A point of the triangle that is on the surface.
    fn on_mesh(&self, x: [f64; 3]) -> SurfacePoint {
        let gradient = match self.sides.iter().flatten().next() {
            Some(s) => {
                let (_, slopes) = s.jet(&self.base, [x[0], x[1], x[2], 0.0]);
                gradient(slopes, &s.tetrahedron(&self.corners).gradients())
            }
            None => {
                let [a, b, c] = self.corners;
                (b - a).cross(c - a)
            }
        };
        SurfacePoint { point: self.foot(x), gradient, t: 0.0, side: None }
    }

    /// The function along the transversal, as that of a point of the triangle, for the side where it
    /// goes; the sign is reversed on the negative side.
    #[must_use]
    pub fn transversal(&self, x: [f64; 3]) -> Option<RayCubic> {
        let base = self.base.value(x);
        let (side, s) = self.side_at(base)?;
        Some(if side == Side::Negative { s.ray(base, x).negated() } else { s.ray(base, x) })
    }
}

impl EdgePatch {
    /// The point of the surface on the transversal from `x p_i + (1 - x) p_j` to `y` times the left
    /// apex plus `1 - y` times the right one; `None` without a root, or without a tetrahedron.
    #[inline]
    #[must_use]
    pub fn point(&self, [x, y]: [f64; 2]) -> Option<SurfacePoint> {
        match EdgeSolver::new(self, side_of(self.base(x))) {
            None => self.on_mesh(x),
            Some(solver) => {
                let mut found = [None];
                solver.points(&[[x], [y]], &mut found);
                found[0]
            }
        }
    }

    /// Appends the points for many parameters: the same as one by one, bit for bit, in less time.
    pub fn points(&self, at: &[[f64; 2]], out: &mut Vec<Option<SurfacePoint>>) {
        let first = out.len();
        out.resize(first + at.len(), None);
        let out = &mut out[first..];
        let solvers = Side::BOTH.map(|side| EdgeSolver::new(self, side));
        let mut queues = [Queue::default(); 2];
        let mut sort_in = |place: usize, row: [f64; 2], out: &mut [Option<SurfacePoint>]| {
            let side = side_of(self.base(row[0])).index();
            match &solvers[side] {
                None => out[place] = self.on_mesh(row[0]),
                Some(solver) => {
                    queues[side].push(place, row);
                    if queues[side].is_full() {
                        queues[side]
                            .empty::<LANES>(out, |rows, points| solver.points(rows, points));
                    }
                }
            }
        };
        let (eights, rest) = at.as_chunks::<LANES>();
        for (part, eight) in eights.iter().enumerate() {
            let start = part * LANES;
            let goes = |solver: &EdgeSolver<'_>| {
                eight.iter().all(|&[x, _]| side_of(self.base(x)) == solver.side)
            };
            // most often all go the same way
            match solvers.iter().flatten().find(|solver| goes(solver)) {
                Some(solver) => {
                    let rows = [eight.map(|at| at[0]), eight.map(|at| at[1])];
                    solver.points(&rows, &mut out.as_chunks_mut().0[part]);
                }
                None => (0..LANES).for_each(|i| sort_in(start + i, eight[i], out)),
            }
        }
        for (i, &row) in rest.iter().enumerate() {
            sort_in(eights.len() * LANES + i, row, out);
        }
        for (queue, solver) in queues.iter_mut().zip(&solvers) {
            let Some(solver) = solver else { continue };
            while !queue.is_empty() {
                queue.empty::<2>(out, |rows, points| solver.points(rows, points));
            }
        }
    }

    fn on_mesh(&self, x: f64) -> Option<SurfacePoint> {
        let s = self.sides.iter().flatten().next()?;
        let (_, slopes) = s.jet(self.weights, [0.0, x, 1.0 - x, 0.0]);
        let gradient = gradient(slopes, &s.tetrahedron(&self.ends).gradients());
        let point = self.ends[0] * x + self.ends[1] * (1.0 - x);
        Some(SurfacePoint { point, gradient, t: 0.0, side: None })
    }

    /// The function along a transversal; the sign is reversed on the negative side.
    #[must_use]
    pub fn transversal(&self, [x, y]: [f64; 2]) -> Option<RayCubic> {
        let (side, s) = self.side_at(self.base(x))?;
        let cubic = s.ray(self.weights, [x, y]);
        Some(if side == Side::Negative { cubic.negated() } else { cubic })
    }
}

impl RationalSurface {
    /// The point of the surface over a point of a face, see [`FacePatch::point`].
    #[inline]
    #[must_use]
    pub fn face_point(&self, face: FaceId, x: [f64; 3]) -> Option<SurfacePoint> {
        let (record, corners) = (&self.faces[face], self.mesh.triangle(face));
        let base = record.base();
        let value = base.value(x);
        let side = side_of(value).index();
        // only the tetrahedron where the transversal goes is needed, if it goes anywhere
        let needed = record.sides[side].as_ref();
        let Some(s) = needed.filter(|s| value.abs() > ON_SURFACE * s.scale()) else {
            return self.face(face).point(x);
        };
        let mut sides = [None; 2];
        sides[side] = Some(record.side(s));
        let (convexity, promoted) = (record.convexity, record.promoted);
        FacePatch { corners, convexity, promoted, base, sides }.point(x)
    }

    /// The point of the surface over an edge, see [`EdgePatch::point`].
    #[inline]
    #[must_use]
    pub fn edge_point(&self, edge: EdgeId, at: [f64; 2]) -> Option<SurfacePoint> {
        let mut sides = [None; 2];
        let side = side_of(self.edge_with(edge, sides).base(at[0]));
        sides[side.index()] = self.edge_side(edge, side);
        match sides {
            [None, None] => self.edge(edge).point(at),
            _ => self.edge_with(edge, sides).point(at),
        }
    }
}

/// Barycentric coordinates that add up to one, whatever the rounding.
#[inline]
pub(crate) fn foot_of(at: [f64; 4]) -> ([f64; 3], f64) {
    let x = [at[0], at[1], at[2]];
    let sum = dot(x, [1.0; 3]);
    (x.map(|v| v / sum), at[3] / (sum + at[3]))
}
