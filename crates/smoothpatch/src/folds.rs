//! Patches that fold over: whose normal turns away from the surface's.

use basemesh::glam::DVec3;
use basemesh::{FaceId, FaceMap, Foot, SurfaceTarget, TriMesh, VertexMap};
use bezier_core::{MultiIndex, SepticTriangle, SurfaceJet};

use crate::measure::{sampled, turns_over};

/// Divisions of the grid where folds are looked for: small ones hide at corners and edges.
const FINE: usize = 64;

/// Patches whose normal is at 90° or more to the surface's, on a grid four times as fine as that of the
/// deviation, or to its own mean.
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
    let cone = Cone::around(corners);
    if cone.is_some_and(|cone| cone.contains_all_normals(net)) {
        return false;
    }
    // feet only where the normal alone does not tell
    let is_open = |normal: DVec3| cone.is_none_or(|cone| !cone.contains(normal));
    if turns_over(net) {
        return true;
    }
    if cone.is_some_and(|cone| cone.contains_all_normals_of_pieces(net, CUTS)) {
        return false;
    }
    let (points, normals) = sampled(net, FINE);
    let open: Vec<usize> = (0..points.len()).filter(|&i| is_open(normals[i])).collect();
    let points: Vec<DVec3> = open.iter().map(|&i| points[i]).collect();
    let mut feet: Vec<Option<Foot>> = vec![None; points.len()];
    target.feet(&points, &mut feet);
    let stands = |(&i, foot): (&usize, Option<Foot>)| {
        foot.is_some_and(|foot| normals[i].dot(foot.normal) > 0.0)
    };
    !open.iter().zip(feet).all(stands)
}

/// Directions so close to the mean of the normals at the corners that the surface's normals, which
/// are taken to stray from it by at most twice as much as those of the corners, cannot be at 90°.
#[derive(Clone, Copy)]
struct Cone {
    axis: DVec3,
    /// Smallest cosine with the axis.
    least: f64,
}

impl Cone {
    fn around(corners: [DVec3; 3]) -> Option<Self> {
        let axis = corners.iter().sum::<DVec3>().try_normalize()?;
        let spread =
            corners.iter().map(|n| n.dot(axis).clamp(-1.0, 1.0).acos()).fold(0.0, f64::max);
        let least = (2.0 * spread).min(std::f64::consts::FRAC_PI_2).sin();
        Some(Self { axis, least })
    }

    fn contains(&self, normal: DVec3) -> bool {
        normal.dot(self.axis) > self.least * normal.length()
    }

    /// Whether the control net alone shows that every normal of the patch is inside: the derivatives
    /// in both parameters are averages of differences in the net, so that each stays within the
    /// largest distance of those from their mean, and their cross product near that of the means.
    fn contains_all_normals(&self, net: &SepticTriangle) -> bool {
        let [u, v] = net_differences(net).map(|differences| Ball::around(&differences));
        let normal = u.centre.cross(v.centre);
        let reach =
            u.centre.length() * v.radius + v.centre.length() * u.radius + u.radius * v.radius;
        normal.dot(self.axis) - reach > self.least * (normal.length() + reach)
    }

    /// The same, shown by the nets of pieces: halves that do not show it are halved again.
    fn contains_all_normals_of_pieces(&self, net: &SepticTriangle, cuts: usize) -> bool {
        let shown = |piece: &SepticTriangle| {
            self.contains_all_normals(piece)
                || (cuts > 1 && self.contains_all_normals_of_pieces(piece, cuts - 1))
        };
        net.halves().iter().all(shown)
    }
}

/// How often a patch is halved before samples decide.
const CUTS: usize = 5;

/// Control points of a net of degree 6.
const DIFFERENCES: usize = 28;

/// Control points of the derivatives in `u` and `v`, over the degree.
fn net_differences(net: &SepticTriangle) -> [[DVec3; DIFFERENCES]; 2] {
    let mut differences = [[DVec3::ZERO; DIFFERENCES]; 2];
    for (rank, MultiIndex { i, j, k }) in MultiIndex::all(6).enumerate() {
        let last = net[MultiIndex::new(i, j, k + 1)];
        differences[0][rank] = net[MultiIndex::new(i + 1, j, k)] - last;
        differences[1][rank] = net[MultiIndex::new(i, j + 1, k)] - last;
    }
    differences
}

/// A ball that contains some vectors.
struct Ball {
    centre: DVec3,
    radius: f64,
}

impl Ball {
    fn around(vectors: &[DVec3]) -> Self {
        let centre = vectors.iter().sum::<DVec3>() / vectors.len() as f64;
        let square = vectors.iter().map(|v| v.distance_squared(centre)).fold(0.0, f64::max);
        Self { centre, radius: square.sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use bezier_core::Barycentric;

    use super::*;
    use crate::measure::GRID;

    /// A patch over the triangle (0,0), (1,0), (0,1) whose height bends with `bend`.
    fn bent(bend: f64) -> SepticTriangle {
        SepticTriangle::from_fn(|m| {
            let [x, y] = [m.j, m.k].map(|e| e as f64 / 7.0);
            DVec3::new(x, y, bend * (x * x - 0.5 * x * y + 2.0 * y * y))
        })
    }

    #[test]
    fn what_the_net_shows_holds_at_the_samples() {
        let corners = [DVec3::new(0.05, 0.0, 1.0), DVec3::Z, DVec3::new(0.0, -0.05, 1.0)];
        let cone = Cone::around(corners.map(DVec3::normalize)).unwrap();
        let bends = || (0..40).map(|step| f64::from(step) * 0.05);
        let whole = bends().filter(|&bend| cone.contains_all_normals(&bent(bend))).count();
        let shown: Vec<f64> = bends()
            .filter(|&bend| cone.contains_all_normals_of_pieces(&bent(bend), CUTS))
            .collect();
        // flat patches pass, pieces show it for more, strongly bent ones do not
        assert!(whole >= 2 && shown.len() > whole && shown.len() < 40, "{whole} {shown:?}");
        for bend in shown {
            let net = bent(bend);
            for at in Barycentric::lattice(GRID) {
                let (_, normal) = net.point_and_area_normal(at);
                assert!(cone.contains(normal), "bend {bend} at {at:?}");
            }
        }
    }
}
