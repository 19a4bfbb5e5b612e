//! How far cells through samples are from the surface between the samples.

use bezier_core::Barycentric;
use glam::DVec3;

use crate::samples::{FacePoint, Samples};

/// A place in a cell: what each corner contributes to its parameters, and each node to its position.
struct Probe<const CORNERS: usize, const NODES: usize> {
    corners: [f64; CORNERS],
    nodes: [f64; NODES],
}

impl Samples {
    /// The largest distance between the flat triangles and the surface at the same parameters: at
    /// the middles of their sides and at their centres. `point` evaluates the surface.
    ///
    /// The closest point of the surface may be nearer.
    #[must_use]
    pub fn flat_gap(&self, mut point: impl FnMut(usize, FacePoint) -> DVec3) -> f64 {
        let third = 1.0 / 3.0;
        let places = [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [third; 3]];
        let probes = places.map(|b| Probe { corners: b, nodes: b });
        let [triangle, quad] = self.patterns();
        let on_triangles = self.gap(false, &triangle.triangles, &probes, &mut point);
        on_triangles.max(self.gap(true, &quad.triangles, &probes, &mut point))
    }

    /// The same for the quadratic cells: halfway between their nodes, and at their centres.
    ///
    /// # Panics
    ///
    /// If the number of divisions is odd.
    #[must_use]
    pub fn quadratic_gap(&self, mut point: impl FnMut(usize, FacePoint) -> DVec3) -> f64 {
        let [triangle, quad] = self.patterns();
        let third = 1.0 / 3.0;
        #[rustfmt::skip]
        let places = [
            [0.75, 0.25, 0.0], [0.25, 0.75, 0.0], [0.0, 0.75, 0.25], [0.0, 0.25, 0.75],
            [0.25, 0.0, 0.75], [0.75, 0.0, 0.25], [0.5, 0.25, 0.25], [0.25, 0.5, 0.25],
            [0.25, 0.25, 0.5], [third; 3],
        ];
        let probes = places.map(|b| Probe { corners: b, nodes: quadratic_shape(b) });
        let on_triangles = self.gap(false, &triangle.quadratic_triangles(), &probes, &mut point);
        let steps = [-1.0, -0.5, 0.0, 0.5, 1.0];
        let probes = steps.map(|y| steps.map(|x| serendipity([x, y])));
        let quads = quad.quadratic_quads();
        on_triangles.max(self.gap(true, &quads, probes.as_flattened(), &mut point))
    }

    /// The largest gap on all triangles, or on all quadrilaterals. The first points of a cell are its
    /// corners.
    fn gap<const CORNERS: usize, const NODES: usize>(
        &self,
        on_quads: bool,
        cells: &[[usize; NODES]],
        probes: &[Probe<CORNERS, NODES>],
        point: &mut impl FnMut(usize, FacePoint) -> DVec3,
    ) -> f64 {
        let mut largest: f64 = 0.0;
        for (face, (pattern, ids)) in self.faces().enumerate() {
            if self.is_quad(face) != on_quads {
                continue;
            }
            for cell in cells {
                let nodes = cell.map(|rank| self.position(ids[rank]));
                let corners = std::array::from_fn(|c| pattern.points[cell[c]].1);
                for probe in probes {
                    let on_cell: DVec3 =
                        nodes.iter().zip(probe.nodes).map(|(&node, weight)| node * weight).sum();
                    let on_surface = point(face, blend(corners, probe.corners));
                    largest = largest.max(on_cell.distance(on_surface));
                }
            }
        }
        largest
    }
}

/// The shape functions of the quadratic triangle at these barycentric coordinates.
fn quadratic_shape([a, b, c]: [f64; 3]) -> [f64; 6] {
    let corner = |x: f64| x * (2.0 * x - 1.0);
    [corner(a), corner(b), corner(c), 4.0 * a * b, 4.0 * b * c, 4.0 * c * a]
}

/// The shape functions of the quadratic quadrilateral in [-1, 1]².
fn serendipity([x, y]: [f64; 2]) -> Probe<4, 8> {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|[i, j]| 0.25 * (1.0 + x * i) * (1.0 + y * j));
    let at_corner = |c: usize, i: f64, j: f64| corners[c] * (x * i + y * j - 1.0);
    let nodes = [
        at_corner(0, -1.0, -1.0),
        at_corner(1, 1.0, -1.0),
        at_corner(2, 1.0, 1.0),
        at_corner(3, -1.0, 1.0),
        0.5 * (1.0 - x * x) * (1.0 - y),
        0.5 * (1.0 + x) * (1.0 - y * y),
        0.5 * (1.0 - x * x) * (1.0 + y),
        0.5 * (1.0 - x) * (1.0 - y * y),
    ];
    Probe { corners, nodes }
}

/// The weighted mean of parameters on one face.
fn blend<const N: usize>(points: [FacePoint; N], weights: [f64; N]) -> FacePoint {
    let sum = |of: &dyn Fn(FacePoint) -> f64| -> f64 {
        points.iter().zip(weights).map(|(&point, weight)| of(point) * weight).sum()
    };
    let first = |point| match point {
        FacePoint::Triangle(at) => at.u,
        FacePoint::Quad(at) => at[0],
    };
    let second = |point| match point {
        FacePoint::Triangle(at) => at.v,
        FacePoint::Quad(at) => at[1],
    };
    match points[0] {
        FacePoint::Triangle(_) => FacePoint::Triangle(Barycentric::new(sum(&first), sum(&second))),
        FacePoint::Quad(_) => FacePoint::Quad([sum(&first), sum(&second)]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obj::Polygons;
    use crate::polygon::Polygon;

    fn one_face(face: Polygon<usize>) -> Polygons {
        Polygons {
            positions: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .map(|[x, y]| DVec3::new(x, y, 0.0))
                .into(),
            normals: Vec::new(),
            faces: vec![face],
            corner_normals: vec![Polygon::new(&vec![None; face.corners().len()]).unwrap()],
        }
    }

    fn parameters(at: FacePoint) -> [f64; 2] {
        match at {
            FacePoint::Triangle(at) => [at.v + at.w, at.w],
            FacePoint::Quad(at) => at,
        }
    }

    #[test]
    fn cells_of_their_own_degree_have_no_gap() {
        for face in [Polygon::triangle([0, 1, 2]), Polygon::quad([0, 1, 2, 3])] {
            let mesh = one_face(face);
            let plane = |_, at| {
                let [x, y] = parameters(at);
                DVec3::new(x, y, 0.0)
            };
            let quadratic = |_, at| {
                let [x, y] = parameters(at);
                DVec3::new(x, y, x * (1.0 - x) + 2.0 * y * (y - 1.0))
            };
            let flat = Samples::new(&mesh, 4, |face, at| (plane(face, at), DVec3::Z));
            assert!(flat.flat_gap(plane) < 1e-15, "{face:?}");
            let curved = Samples::new(&mesh, 4, |face, at| (quadratic(face, at), DVec3::Z));
            assert!(curved.quadratic_gap(quadratic) < 1e-15, "{face:?}");
            assert!(curved.flat_gap(quadratic) > 1e-3, "{face:?}");
        }
    }

    #[test]
    fn gaps_have_the_order_of_the_cells() {
        let mesh = one_face(Polygon::quad([0, 1, 2, 3]));
        let wave = |_: usize, at: FacePoint| {
            let [x, y] = parameters(at);
            DVec3::new(x, y, x * (1.0 - x) * (3.0 * x).sin() + y * (1.0 - y) * (2.0 * y).cos())
        };
        let gaps = [8, 16].map(|divisions| {
            let samples = Samples::new(&mesh, divisions, |face, at| (wave(face, at), DVec3::Z));
            [samples.flat_gap(wave), samples.quadratic_gap(wave)]
        });
        let orders = [0, 1].map(|kind| (gaps[0][kind] / gaps[1][kind]).log2());
        assert!((orders[0] - 2.0).abs() < 0.2, "flat: order {}", orders[0]);
        assert!((orders[1] - 3.0).abs() < 0.3, "quadratic: order {}", orders[1]);
    }
}
