//! Triangle meshes of a rational surface.

use basemesh::{EdgeId, FaceId};
use glam::DVec3;

use super::edge::EdgePatch;
use super::kinds::Convexity;
use super::points::SurfacePoint;
use super::surface::RationalSurface;
use crate::tessellate::{Element, PatchKind, Tessellation, lattice_triangles};

/// The points over an edge: rows from its first to its last vertex, each from the right face to the
/// left one.
struct EdgeGrid {
    kind: Convexity,
    rows: Vec<Vec<usize>>,
    /// Parameter of each row, from 0 to 1.
    along: Vec<f64>,
}

impl RationalSurface {
    /// A triangle mesh of the surface: `along` steps along each side of a face, `across` steps over
    /// each edge patch.
    ///
    /// Closed if the mesh is, with its Euler characteristic. Where the surface crosses an edge there
    /// is a point. A transversal without a root gives its point on the mesh, without a normal, and
    /// is counted in [`Tessellation::missing`]. Facets that would look the wrong way are avoided by
    /// flipping edges, which may join points of two patches; see
    /// [`Tessellation::flipped_facets`] for those that are left.
    ///
    /// # Panics
    ///
    /// If one of the numbers is zero.
    #[must_use]
    pub fn tessellate(&self, along: usize, across: usize) -> Tessellation {
        assert!(along >= 1 && across >= 1, "at least one step each way");
        let mut out = Tessellation::default();
        for v in self.mesh.topology().vertices() {
            out.push_point(self.mesh.position(v), self.normals[v].normalize_or_zero());
        }
        let mut grids = Vec::with_capacity(self.edges.len());
        for (edge, _) in self.edges.iter() {
            grids.push(self.edge_grid(edge, along, across, &mut out));
        }
        for (face, _) in self.faces.iter() {
            self.push_face(face, along, &grids, &mut out);
        }
        for (edge, _) in self.edges.iter() {
            push_strip(edge, &grids[edge.index()], &mut out);
        }
        out.unfold();
        out
    }

    fn edge_grid(
        &self,
        edge: EdgeId,
        along: usize,
        across: usize,
        out: &mut Tessellation,
    ) -> EdgeGrid {
        let topology = self.mesh.topology();
        let patch = self.edge(edge);
        let ends = topology.edge_vertices(edge).map(basemesh::VertexId::index);
        let parameters = parameters(&patch, along);
        let crossing = patch.crossing();
        let mut rows = vec![vec![ends[0]; across + 1]];
        let mut points = Vec::new();
        for &s in &parameters[1..along] {
            // a parameter that was moved to the crossing, and may be rounded
            let x = crossing.filter(|x| 1.0 - x == s).unwrap_or(1.0 - s);
            let foot = patch.ends[0] * x + patch.ends[1] * s;
            let open = patch.side_at(patch.base(x)).is_some() && Some(x) != crossing;
            rows.push(if open {
                let at: Vec<[f64; 2]> =
                    (0..=across).map(|j| [x, j as f64 / across as f64]).collect();
                points.clear();
                patch.points(&at, &mut points);
                points.iter().map(|&p| push(p, foot, out)).collect()
            } else {
                vec![push(self.at_rim(edge, x), foot, out); across + 1]
            });
        }
        rows.push(vec![ends[1]; across + 1]);
        EdgeGrid { kind: patch.convexity, rows, along: parameters }
    }

    /// The point of the left face over a point of its edge, where there is no edge patch.
    fn at_rim(&self, edge: EdgeId, x: f64) -> Option<SurfacePoint> {
        let h = self.mesh.topology().canonical(edge);
        let mut at = [0.0; 3];
        at[h.corner()] = x;
        at[h.next().corner()] = 1.0 - x;
        let mut point = self.face_point(h.face(), at)?;
        let patch = self.edge_with(edge, [None; 2]);
        if Some(x) == patch.crossing() {
            // exactly on the edge, whatever the rounding
            let ends = patch.ends;
            point.point = ends[0] * x + ends[1] * (1.0 - x);
        }
        Some(point)
    }

    fn push_face(&self, face: FaceId, n: usize, grids: &[EdgeGrid], out: &mut Tessellation) {
        let topology = self.mesh.topology();
        let patch = self.face(face);
        // the point of the side that starts at a corner, after some steps
        let on_side = |corner: usize, steps: usize| {
            let h = face.halfedge(corner);
            let edge = topology.edge(h);
            let rows = &grids[edge.index()].rows;
            if topology.canonical(edge) == h {
                *rows[steps].last().expect("invariant: every row has a left end")
            } else {
                rows[n - steps][0]
            }
        };
        let inner: Vec<[f64; 3]> = (1..n)
            .flat_map(|i| (1..n - i).map(move |j| [n - i - j, i, j]))
            .map(|steps| steps.map(|s| s as f64 / n as f64))
            .collect();
        let mut points = Vec::new();
        patch.points(&inner, &mut points);
        let mut points = inner.into_iter().zip(points);
        let mut ids = vec![0; (n + 1) * (n + 1)];
        for i in 0..=n {
            for j in 0..=n - i {
                // i steps towards the second corner, j towards the third
                let k = n - i - j;
                ids[i * (n + 1) + j] = match (k, i, j) {
                    (_, _, 0) => on_side(0, i),
                    (0, _, _) => on_side(1, j),
                    (_, 0, _) => on_side(2, k),
                    _ => {
                        let ([x, y, z], point) =
                            points.next().expect("invariant: one for each inner place");
                        let [a, b, c] = patch.corners;
                        push(point, a * x + b * y + c * z, out)
                    }
                };
            }
        }
        let kind = match patch.convexity {
            Convexity::Zero => PatchKind::FlatFace,
            Convexity::Nonconvex => PatchKind::NonconvexFace,
            Convexity::Positive | Convexity::Negative => PatchKind::ConvexFace,
        };
        for triangle in lattice_triangles(n) {
            let corners = triangle.map(|[i, j]| ids[i * (n + 1) + j]);
            out.push_triangle(corners, Element::Face(face), kind);
        }
    }
}

/// The surface crosses an edge this part of a step from a vertex or nearer: it hardly leaves the edge
/// before, and triangles in between would have no area.
const NEAR_VERTEX: f64 = 0.25;

/// Steps along an edge, from 0 to 1; the inner one nearest to where the surface crosses the edge is
/// moved there, unless that is next to a vertex.
fn parameters(patch: &EdgePatch, along: usize) -> Vec<f64> {
    let n = along as f64;
    let mut steps: Vec<f64> = (0..=along).map(|i| i as f64 / n).collect();
    let inner = NEAR_VERTEX / n..1.0 - NEAR_VERTEX / n;
    if let Some(crossing) = patch.crossing().map(|x| 1.0 - x).filter(|s| inner.contains(s)) {
        let inner = (1..along).min_by(|&a, &b| {
            let distance = |i: usize| (steps[i] - crossing).abs();
            distance(a).total_cmp(&distance(b))
        });
        if let Some(i) = inner {
            steps[i] = crossing;
        }
    }
    steps
}

fn push(point: Option<SurfacePoint>, foot: DVec3, out: &mut Tessellation) -> usize {
    match point {
        Some(p) => out.push_point(p.point, p.normal()),
        None => {
            out.missing += 1;
            out.push_point(foot, DVec3::ZERO)
        }
    }
}

fn push_strip(edge: EdgeId, grid: &EdgeGrid, out: &mut Tessellation) {
    debug_assert_eq!(grid.rows.len(), grid.along.len(), "one row a step");
    let kind = match grid.kind {
        Convexity::Zero => return,
        Convexity::Nonconvex => PatchKind::NonconvexEdge,
        Convexity::Positive | Convexity::Negative => PatchKind::ConvexEdge,
    };
    for rows in grid.rows.windows(2) {
        for j in 1..rows[0].len() {
            let quad = [rows[0][j - 1], rows[1][j - 1], rows[1][j], rows[0][j]];
            out.push_quad(quad, Element::Edge(edge), kind);
        }
    }
}
