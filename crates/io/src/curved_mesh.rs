//! Meshes of curved elements through points of a surface.

use basemesh::{FaceMap, Topology};
use bezier_core::{Barycentric, BezierTriangle, MultiIndex};
use glam::DVec3;

use crate::lattice::Lattice;
use crate::patterns::Pattern;
use crate::samples::FacePoint;

/// A mesh of Lagrange triangles and quadrilaterals of one order: polynomials of that degree through
/// their nodes, which lie at equal steps of the parameters. Shared nodes are stored once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurvedMesh {
    /// Polynomial degree, at least one.
    pub order: usize,
    /// Positions of the nodes.
    pub points: Vec<DVec3>,
    /// The nodes of each triangle in the order of [`MultiIndex::rank`], one triangle after the
    /// other.
    pub triangles: Vec<usize>,
    /// The nodes of each quadrilateral, in rows of `order + 1` from its first side to the opposite
    /// one.
    pub quads: Vec<usize>,
}

impl CurvedMesh {
    /// The triangles through points on patches.
    ///
    /// A patch of degree `order` or less is held exactly, up to the rounding of the points. Shared
    /// points are taken from one of the patches, so neighbours use the same bits.
    ///
    /// # Panics
    ///
    /// If `order` is zero or there is not one patch per face.
    #[must_use]
    pub fn from_patches<const P: usize>(
        topology: &Topology,
        nets: &FaceMap<BezierTriangle<DVec3, P>>,
        order: usize,
    ) -> Self {
        assert_eq!(nets.len(), topology.face_count(), "one patch per face");
        let lattice = Lattice::new(topology, order);
        let ranks = 0..MultiIndex::count(order);
        let of_face = |face| ranks.clone().map(move |rank| (face, rank));
        let nodes = topology.faces().flat_map(of_face);
        let triangles = nodes.map(|(face, rank)| lattice.locate(face, rank).0).collect();
        Self { order, points: lattice.sample(nets), triangles, quads: Vec::new() }
    }

    /// Nodes of a triangle and of a quadrilateral.
    #[must_use]
    pub fn nodes_each(&self) -> [usize; 2] {
        [MultiIndex::count(self.order), (self.order + 1) * (self.order + 1)]
    }

    /// The largest distance between the elements and a surface at the same parameters, at twice as
    /// many steps as there are between nodes. `point` evaluates the surface on the `n`-th triangle,
    /// or on the `n`-th quadrilateral.
    #[must_use]
    pub fn gap(&self, mut point: impl FnMut(usize, FacePoint) -> DVec3) -> f64 {
        let [triangle, quad] = self.nodes_each();
        let n = self.order;
        let kinds = [
            (&self.triangles, triangle, Pattern::triangle(2 * n)),
            (&self.quads, quad, Pattern::quad(2 * n)),
        ];
        let mut largest: f64 = 0.0;
        for (nodes, each, pattern) in kinds {
            let places: Vec<_> = pattern.points.iter().map(|&(_, at)| (at, basis(n, at))).collect();
            for (element, nodes) in nodes.chunks_exact(each).enumerate() {
                for (at, weights) in &places {
                    let terms = nodes.iter().zip(weights);
                    let on_element: DVec3 = terms.map(|(&id, &w)| self.points[id] * w).sum();
                    largest = largest.max(on_element.distance(point(element, *at)));
                }
            }
        }
        largest
    }

    /// Number of triangles and of quadrilaterals.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        let [triangle, quad] = self.nodes_each();
        [self.triangles.len() / triangle, self.quads.len() / quad]
    }
}

/// The value of the polynomial of each node at a point: one at its node, zero at all others.
fn basis(order: usize, at: FacePoint) -> Vec<f64> {
    let n = order as f64;
    // one at step `i`, zero at the steps before
    let rising = |i: usize, x: f64| -> f64 {
        (0..i).map(|a| (n * x - a as f64) / (i as f64 - a as f64)).product()
    };
    match at {
        FacePoint::Triangle(Barycentric { u, v, w }) => MultiIndex::all(order)
            .map(|MultiIndex { i, j, k }| rising(i, u) * rising(j, v) * rising(k, w))
            .collect(),
        FacePoint::Quad([x, y]) => {
            let along = |i: usize, x: f64| rising(i, x) * rising(order - i, 1.0 - x);
            let rows = (0..=order).flat_map(|j| (0..=order).map(move |i| (i, j)));
            rows.map(|(i, j)| along(i, x) * along(j, y)).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obj::Polygons;
    use crate::polygon::Polygon;
    use crate::samples::Samples;

    #[test]
    fn elements_hold_polynomials_of_their_order_and_no_more() {
        for face in [Polygon::triangle([0, 1, 2]), Polygon::quad([0, 1, 2, 3])] {
            let corners = face.corners().len();
            let mesh = Polygons {
                positions: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                    .map(|[x, y]| DVec3::new(x, y, 0.0))
                    .into(),
                normals: Vec::new(),
                faces: vec![face],
                corner_normals: vec![Polygon::new(&vec![None; corners]).unwrap()],
            };
            let surface = |at: FacePoint| {
                let [x, y] = match at {
                    FacePoint::Triangle(at) => [at.v + at.w, at.w],
                    FacePoint::Quad(at) => at,
                };
                // zero at the corners, of degree 4
                DVec3::new(x, y, x * (1.0 - x) * (1.0 + x * x) + x * y * (1.0 - y))
            };
            let gap = |order| {
                let samples = Samples::new(&mesh, order, |_, at| (surface(at), DVec3::Z));
                samples.curved_mesh().gap(|_, at| surface(at))
            };
            assert!(gap(4) < 1e-14, "{face:?}: {}", gap(4));
            assert!(gap(7) < 1e-13, "{face:?}: {}", gap(7));
            assert!(gap(3) > 1e-3, "{face:?}: {}", gap(3));
        }
    }
}
