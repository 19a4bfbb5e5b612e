//! A watertight triangle mesh of the surface.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

use super::hull::{Cell, HullTriangle};
use super::surface::PolyhedralSurface;
use crate::rational::Side;
use crate::tessellate::{Element, PatchKind, Tessellation, lattice_triangles};

/// Numbers of mesh points, shared between neighbours.
struct Points {
    /// For each edge the points over it, from its first end: at the first triangle, between the
    /// apices, at the second triangle; the same three times for a straight edge.
    edges: Vec<[Vec<usize>; 3]>,
    /// Index of each cell.
    cells: std::collections::HashMap<Cell, usize>,
}

/// A triangle mesh with the place of each point in the hull.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sampled {
    /// The mesh.
    pub mesh: Tessellation,
    /// Cell and barycentric coordinates of each point; `None` on planar pieces.
    pub places: Vec<Option<(usize, [f64; 4])>>,
}

impl Sampled {
    fn push(&mut self, point: DVec3, normal: DVec3, place: Option<(usize, [f64; 4])>) -> usize {
        self.places.push(place);
        self.mesh.push_point(point, normal)
    }
}

impl PolyhedralSurface {
    /// A triangle mesh with `n` steps along each side of a triangle, and `across` steps over each half
    /// of an edge; both at least 1.
    ///
    /// The points lie on the surface to round-off, with the normals of the gradient; neighbours share
    /// them by index. The first points are those of the triangulation. Facets that would look the
    /// wrong way are avoided by flipping edges, which may join points of two patches.
    #[must_use]
    pub fn tessellate(&self, n: usize, across: usize) -> Tessellation {
        self.sample(n, across).mesh
    }

    /// The same with the places of its points in the hull, for other quantities there.
    #[must_use]
    pub fn sample(&self, n: usize, across: usize) -> Sampled {
        let (n, across) = (n.max(1), across.max(1));
        let mut out = Sampled::default();
        let corner_places = self.corner_places();
        for (p, normal) in self.hull.normals.iter().enumerate() {
            out.push(self.hull.points[p], *normal, corner_places[p]);
        }
        let cells = self.hull.cells.iter().enumerate().map(|(i, &c)| (c, i)).collect();
        let mut points = Points { edges: Vec::new(), cells };
        for e in 0..self.hull.edges.len() {
            let of_edge = self.edge_points(e, n, &points, &mut out);
            points.edges.push(of_edge);
        }
        for e in 0..self.hull.edges.len() {
            if let Some(side) = self.hull.edge_side(e) {
                self.push_strips(e, side, across, &points, &mut out);
            }
        }
        for t in 0..self.hull.triangles.len() {
            self.push_lattice(t, n, &points, &mut out);
        }
        out.mesh.unfold();
        out
    }

    /// For each point of the triangulation the first cell that has it as a corner.
    fn corner_places(&self) -> Vec<Option<(usize, [f64; 4])>> {
        let mut places = vec![None; self.hull.base_count()];
        for (index, &cell) in self.hull.cells.iter().enumerate() {
            for (c, p) in self.hull.corners(cell).into_iter().enumerate() {
                if let Some(place @ None) = places.get_mut(p) {
                    let mut at = [0.0; 4];
                    at[c] = 1.0;
                    *place = Some((index, at));
                }
            }
        }
        places
    }

    fn push(&self, cell: usize, foot: [f64; 4], top: [f64; 4], out: &mut Sampled) -> usize {
        match self.point(cell, foot, top) {
            Some(p) => out.push(p.point, p.normal(), Some((cell, p.at))),
            None => {
                out.mesh.missing += 1;
                let tetrahedron = self.hull.tetrahedron(self.hull.cells[cell]);
                out.push(tetrahedron.point(foot), DVec3::ZERO, None)
            }
        }
    }

    fn edge_points(
        &self,
        e: usize,
        n: usize,
        points: &Points,
        out: &mut Sampled,
    ) -> [Vec<usize>; 3] {
        let edge = &self.hull.edges[e];
        let [a, b] = edge.ends;
        let row = |inner: &mut dyn FnMut(f64) -> usize| {
            let steps = (1..n).map(|i| inner(i as f64 / n as f64));
            [a].into_iter().chain(steps).chain([b]).collect::<Vec<usize>>()
        };
        let cell = |which: usize| {
            let side = self.hull.edge_side(e)?;
            points.cells.get(&Cell::Edge(e, side, which)).copied()
        };
        if let [Some(first), Some(second)] = [cell(0), cell(1)] {
            let apex = [0.0, 0.0, 0.0, 1.0];
            let split = [0.0, 0.0, 1.0, 0.0];
            [(first, apex), (first, split), (second, apex)]
                .map(|(cell, top)| row(&mut |x| self.push(cell, [1.0 - x, x, 0.0, 0.0], top, out)))
        } else {
            // the edge is on the surface
            let [p, q] = [a, b].map(|i| self.hull.points[i]);
            let normal = (self.hull.normals[a] + self.hull.normals[b]).normalize_or_zero();
            let place = self.place_on_straight_edge(e, points);
            let along = row(&mut |x| {
                let place = place.map(|(cell, ends)| (cell, blend(ends, x)));
                out.push(p * (1.0 - x) + q * x, normal, place)
            });
            [along.clone(), along.clone(), along]
        }
    }

    /// A cell next to a straight edge, and the coordinates of the ends of the edge in it.
    fn place_on_straight_edge(&self, e: usize, points: &Points) -> Option<(usize, [[f64; 4]; 2])> {
        let edge = &self.hull.edges[e];
        let cells = edge.triangles.into_iter().flat_map(|t| Side::BOTH.map(|s| Cell::Face(t, s)));
        let cell = cells.filter_map(|c| points.cells.get(&c).copied()).next()?;
        let corners = self.hull.corners(self.hull.cells[cell]);
        let at = |p: usize| corners.map(|c| f64::from(u8::from(c == p)));
        Some((cell, edge.ends.map(at)))
    }

    /// The two strips over an edge, from its first triangle to its second.
    fn push_strips(&self, e: usize, side: Side, across: usize, points: &Points, out: &mut Sampled) {
        let rows = &points.edges[e];
        let n = rows[0].len() - 1;
        for which in 0..2 {
            let Some(&cell) = points.cells.get(&Cell::Edge(e, side, which)) else { continue };
            // columns from the apex to the split point, turned round for the second triangle
            let mut columns: Vec<Vec<usize>> = vec![rows[2 * which].clone()];
            for j in 1..across {
                let u = j as f64 / across as f64;
                let inner = (1..n).map(|i| {
                    let x = i as f64 / n as f64;
                    self.push(cell, [1.0 - x, x, 0.0, 0.0], [0.0, 0.0, u, 1.0 - u], out)
                });
                let ends = self.hull.edges[e].ends;
                columns.push([ends[0]].into_iter().chain(inner).chain([ends[1]]).collect());
            }
            columns.push(rows[1].clone());
            if which == 1 {
                columns.reverse();
            }
            let element = Element::Edge(EdgeId::new(e));
            for pair in columns.windows(2) {
                for i in 0..n {
                    let quad = [pair[0][i], pair[1][i], pair[1][i + 1], pair[0][i + 1]];
                    out.mesh.push_quad(quad, element, PatchKind::ConvexEdge);
                }
            }
        }
    }

    /// The points over an edge of a triangle, from its corner `k`.
    fn row_at(&self, t: usize, k: usize, points: &Points) -> Vec<usize> {
        let HullTriangle { corners, edges, .. } = self.hull.triangles[t];
        let edge = &self.hull.edges[edges[k]];
        let which = usize::from(edge.triangles[0] != t);
        let mut row = points.edges[edges[k]][2 * which].clone();
        if edge.ends[0] != corners[k] {
            row.reverse();
        }
        row
    }

    fn push_lattice(&self, t: usize, n: usize, points: &Points, out: &mut Sampled) {
        let rows = [0, 1, 2].map(|k| self.row_at(t, k, points));
        let sides = Side::BOTH.map(|side| points.cells.get(&Cell::Face(t, side)).copied());
        let mut ids = vec![0; (n + 1) * (n + 1)];
        for i in 0..=n {
            for j in 0..=n - i {
                // i steps towards the second corner, j towards the third
                let k = n - i - j;
                ids[i * (n + 1) + j] = match (k, i, j) {
                    (_, _, 0) => rows[0][i],
                    (0, _, _) => rows[1][j],
                    (_, 0, _) => rows[2][k],
                    _ => {
                        let x = [k, i, j].map(|steps| steps as f64 / n as f64);
                        self.push_inner(t, sides, x, out)
                    }
                };
            }
        }
        let kind = match sides {
            [Some(_), Some(_)] => PatchKind::NonconvexFace,
            [None, None] => PatchKind::FlatFace,
            _ => PatchKind::ConvexFace,
        };
        for triangle in lattice_triangles(n) {
            let corners = triangle.map(|[i, j]| ids[i * (n + 1) + j]);
            out.mesh.push_triangle(corners, Element::Face(FaceId::new(t)), kind);
        }
    }

    /// The point over a point of a triangle: on the positive side where the function is negative.
    fn push_inner(
        &self,
        t: usize,
        sides: [Option<usize>; 2],
        [x, y, z]: [f64; 3],
        out: &mut Sampled,
    ) -> usize {
        let (foot, apex) = ([x, y, z, 0.0], [0.0, 0.0, 0.0, 1.0]);
        match sides {
            [Some(up), Some(down)] => {
                let below = self.jet(up, foot).value <= 0.0;
                self.push(if below { up } else { down }, foot, apex, out)
            }
            [Some(cell), None] | [None, Some(cell)] => self.push(cell, foot, apex, out),
            [None, None] => {
                let [a, b, c] = self.hull.triangles[t].corners;
                let at = |p: usize| self.hull.points[p];
                out.push(at(a) * x + at(b) * y + at(c) * z, self.hull.normals[a], None)
            }
        }
    }
}

fn blend([a, b]: [[f64; 4]; 2], x: f64) -> [f64; 4] {
    std::array::from_fn(|c| a[c] * (1.0 - x) + b[c] * x)
}
