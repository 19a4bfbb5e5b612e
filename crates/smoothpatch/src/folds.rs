//! Patches that fold over: whose normal turns away from the surface's.

use std::sync::LazyLock;

use basemesh::glam::DVec3;
use basemesh::{FaceId, FaceMap, Foot, SurfaceTarget, TriMesh, VertexMap};
use bezier_core::{Barycentric, SepticTriangle, SurfaceJet};

use crate::measure::GRID;

/// Patches whose normal is at 90° or more to the surface's, at the points where the deviation is
/// measured.
///
/// Feet are needed only where the patch normal is far from the normals at the corners.
pub(crate) fn find_folds(
    mesh: &TriMesh,
    jets: &VertexMap<SurfaceJet>,
    nets: &FaceMap<SepticTriangle>,
    target: &dyn SurfaceTarget,
) -> Vec<FaceId> {
    let folds = nets.map(|face, net| {
        let corners = mesh.topology().corners(face).map(|vertex| jets[vertex].normal);
        is_folded(net, corners, target)
    });
    folds.iter().filter(|(_, folds)| **folds).map(|(face, _)| face).collect()
}

fn is_folded(net: &SepticTriangle, corners: [DVec3; 3], target: &dyn SurfaceTarget) -> bool {
    static PARAMETERS: LazyLock<Vec<Barycentric>> =
        LazyLock::new(|| Barycentric::lattice(GRID).collect());
    let (points, normals): (Vec<DVec3>, Vec<DVec3>) =
        PARAMETERS.iter().map(|&at| net.point_and_area_normal(at)).unzip();
    if upright(&normals, corners) {
        return false;
    }
    let mut feet: Vec<Option<Foot>> = vec![None; points.len()];
    target.feet(&points, &mut feet);
    let stands = |(normal, foot): (&DVec3, Option<Foot>)| {
        foot.is_some_and(|foot| normal.dot(foot.normal) > 0.0)
    };
    !normals.iter().zip(feet).all(stands)
}

/// Whether all normals are so close to the mean of the corners' that the surface's normals, which
/// are taken to stray from it by at most twice as much as those of the corners, cannot be at 90°.
fn upright(normals: &[DVec3], corners: [DVec3; 3]) -> bool {
    let Some(mean) = corners.iter().sum::<DVec3>().try_normalize() else { return false };
    let spread = corners.iter().map(|n| n.dot(mean).clamp(-1.0, 1.0).acos()).fold(0.0, f64::max);
    let least = (2.0 * spread).min(std::f64::consts::FRAC_PI_2).sin();
    normals.iter().all(|normal| normal.dot(mean) > least * normal.length())
}
