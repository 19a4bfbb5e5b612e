//! The honest competitor: interpolation of the same degree without smoothness.

use anyhow::{Context, Result};
use nalgebra::DMatrix;
use smoothpatch::basemesh::glam::DVec3;
use smoothpatch::basemesh::{FaceMap, SurfaceTarget, TriMesh};
use smoothpatch::bezier_core::{Barycentric, BezierTriangle, MultiIndex, SepticTriangle, binomial};

use super::lobatto;

/// The continuous piecewise polynomial with `P` nodes per face, projected onto the target from
/// the flat faces; as patches of degree 7, so that it is measured in the same way.
pub(crate) fn interpolate<const P: usize>(
    mesh: &TriMesh,
    target: &dyn SurfaceTarget,
) -> Result<FaceMap<SepticTriangle>> {
    let nodes = lobatto::nodes(BezierTriangle::<DVec3, P>::DEGREE);
    let to_net = net_from_values(&nodes).context("the nodes determine no polynomial")?;
    let nets = FaceMap::try_from_fn(mesh.topology().face_count(), |face| {
        let [a, b, c] = mesh.triangle(face);
        let flat: Vec<DVec3> = nodes.iter().map(|at| a * at.u + b * at.v + c * at.w).collect();
        let mut feet = vec![None; flat.len()];
        target.feet(&flat, &mut feet);
        let values: Option<Vec<DVec3>> =
            feet.into_iter().map(|foot| foot.map(|foot| foot.point - a)).collect();
        let values = values.context("a node has no foot")?;
        let patch = BezierTriangle::<DVec3, P>::from_fn(|m| {
            let row = to_net.row(m.rank());
            a + row.iter().zip(&values).map(|(&x, &value)| value * x).sum::<DVec3>()
        });
        Ok::<_, anyhow::Error>(patch.elevate_to::<36>())
    })?;
    Ok(nets)
}

/// The matrix from values at the nodes to control points; `None` if the nodes lie on a curve of the
/// same degree.
fn net_from_values(nodes: &[Barycentric]) -> Option<DMatrix<f64>> {
    let degree = (0..nodes.len()).find(|&degree| MultiIndex::count(degree) == nodes.len())?;
    let indices: Vec<MultiIndex> = MultiIndex::all(degree).collect();
    let values = DMatrix::from_fn(nodes.len(), nodes.len(), |row, column| {
        bernstein(nodes[row], indices[column])
    });
    values.try_inverse()
}

fn bernstein(at: Barycentric, m: MultiIndex) -> f64 {
    let powers = [(at.u, m.i), (at.v, m.j), (at.w, m.k)].map(|(x, n)| (0..n).map(|_| x).product());
    let [u, v, w]: [f64; 3] = powers;
    binomial(m.degree(), m.i) * binomial(m.j + m.k, m.j) * u * v * w
}

#[cfg(test)]
mod tests {
    use smoothpatch::FieldSource;
    use smoothpatch::implicit::{ProjectionSettings, Sphere};
    use testkit::meshes::icosphere;

    use super::*;

    #[test]
    fn values_at_the_nodes_give_the_polynomial_back() {
        let net: [f64; 15] = std::array::from_fn(|i| (7.3 * i as f64).sin());
        let nodes = lobatto::nodes(4);
        let patch = BezierTriangle::new(net);
        let values: Vec<f64> = nodes.iter().map(|&at| patch.eval(at)).collect();
        let to_net = net_from_values(&nodes).expect("nodes of a polynomial");
        for (rank, expected) in net.into_iter().enumerate() {
            let found: f64 = to_net.row(rank).iter().zip(&values).map(|(a, b)| a * b).sum();
            assert!((found - expected).abs() < 1e-13, "{rank}: {found} {expected}");
        }
    }

    #[test]
    fn orders_of_interpolation_on_the_sphere() {
        let sphere = Sphere::default();
        let source = FieldSource::new(&sphere, 3.4, ProjectionSettings::default());
        let error = |level| {
            let nets = interpolate::<15>(&icosphere(level), &source).expect("feet everywhere");
            smoothpatch::measure::deviation(&nets, &source, 3.4).0.max
        };
        // degree 4 gains an order by the symmetry of the sphere
        let order = (error(1) / error(2)).log2();
        assert!(order > 4.8, "{order}");
    }
}
