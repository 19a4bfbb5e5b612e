//! Step 1: patches whose boundaries are the network, joined without gaps (G0).
//!
//! A patch fits, in the sense of least squares, the projections of a regular grid on the flat
//! triangle [TK09 (12)]. Its only use is as the starting point of the smooth patch.

use std::sync::LazyLock;

use basemesh::{FaceId, FaceMap, Foot, SurfaceTarget, TriMesh};
use bezier_core::glam::DVec3;
use bezier_core::{
    BezierTriangle, Corner, LocalEdge, MultiIndex, QuarticCurve, QuarticTriangle, SepticCurve,
    SepticTriangle,
};

use crate::earlier::{Earlier, Nothing};
use crate::faces::{back_to_face, corner_halfedges, first_corner};
use crate::network::CurveNetwork;
use crate::normal_fit::point_to_plane;
use crate::plan::{Fill, Plan};
use crate::samples::{FreePoints, NetFit, Points, SAMPLES, parameters};

/// Patches that join without gaps, not yet smoothly.
#[derive(Clone, Debug)]
pub struct PositionalPatches {
    /// Control nets by face.
    pub nets: FaceMap<SepticTriangle>,
    /// Samples per face whose projection failed and was replaced by the flat point; normally zero.
    pub failed_feet: FaceMap<usize>,
}

/// One of these patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionalPatch {
    /// The control net.
    pub net: SepticTriangle,
    /// Samples whose projection failed.
    pub failed_feet: usize,
}

/// Fills every face of the mesh with a patch over the curve network.
///
/// # Panics
///
/// If the plan is not for this mesh.
#[must_use]
pub fn fill(
    mesh: &TriMesh,
    network: &CurveNetwork,
    target: &dyn SurfaceTarget,
    plan: &Plan,
) -> PositionalPatches {
    fill_reusing(mesh, network, target, plan, &Nothing)
}

/// [`fill`] that finds only those patches anew that `earlier` does not know.
///
/// # Panics
///
/// As [`fill`].
#[must_use]
pub fn fill_reusing(
    mesh: &TriMesh,
    network: &CurveNetwork,
    target: &dyn SurfaceTarget,
    plan: &Plan,
    earlier: &dyn Earlier,
) -> PositionalPatches {
    let faces = mesh.topology().face_count();
    assert_eq!(plan.fill.len(), faces, "one choice per face");
    let filled = FaceMap::from_fn(faces, |face| {
        if let Some(known) = earlier.positional(face) {
            return known;
        }
        let first = first_corner(mesh.topology(), face);
        let sides = Sides::new(mesh, network, face, first);
        let (samples, failed_feet) = samples(&sides, target);
        let net = match plan.fill[face] {
            Fill::Septic => septic(&sides, &samples),
            Fill::Quartic => quartic(&sides, &samples, target),
        };
        let net = net.starting_at(back_to_face(first));
        PositionalPatch { net, failed_feet }
    });
    let failed_feet = filled.map(|_, patch| patch.failed_feet);
    // by value: the nets stay where they are in memory
    let nets = filled.into_vec().into_iter().map(|patch| patch.net).collect();
    PositionalPatches { nets: FaceMap::from_vec(nets), failed_feet }
}

/// The boundary of a face, from its lowest vertex.
struct Sides {
    quartic: [QuarticCurve; 3],
    septic: [SepticCurve; 3],
}

impl Sides {
    fn new(mesh: &TriMesh, network: &CurveNetwork, face: FaceId, first: Corner) -> Self {
        let mut halfedges = corner_halfedges(face);
        halfedges.rotate_left(first.index());
        Self {
            quartic: halfedges.map(|h| network.along(mesh.topology(), h)),
            septic: halfedges.map(|h| network.elevated_along(mesh.topology(), h)),
        }
    }

    /// Writes the three boundary curves.
    fn bound(&self, net: &mut SepticTriangle) {
        for (edge, curve) in LocalEdge::ALL.into_iter().zip(&self.septic) {
            net.set_boundary(edge, curve);
        }
    }
}

/// Feet of the samples of the flat triangle, and how many had none.
fn samples(sides: &Sides, target: &dyn SurfaceTarget) -> (Points, usize) {
    let [a, b, c] = sides.quartic.map(|curve| curve.points[0]);
    let flat = parameters().map(|at| a * at.u + b * at.v + c * at.w);
    let mut feet: [Option<Foot>; SAMPLES] = [None; SAMPLES];
    target.feet(&flat, &mut feet);
    let failed = feet.iter().filter(|foot| foot.is_none()).count();
    (std::array::from_fn(|j| feet[j].map_or(flat[j], |foot| foot.point)), failed)
}

fn septic(sides: &Sides, samples: &Points) -> SepticTriangle {
    static FIT: LazyLock<NetFit<36, 15>> = LazyLock::new(|| NetFit::new(inner_points(7)));
    let mut net = BezierTriangle::new([DVec3::ZERO; 36]);
    sides.bound(&mut net);
    FIT.apply(&mut net, samples);
    net
}

/// Rounds of fitting quartics along the normals, and their damping.
const QUARTIC_ROUNDS: usize = 2;
const QUARTIC_DAMPING: f64 = 0.02 * 0.02;

fn quartic(sides: &Sides, samples: &Points, target: &dyn SurfaceTarget) -> SepticTriangle {
    static FIT: LazyLock<NetFit<15, 3>> = LazyLock::new(|| NetFit::new(inner_points(4)));
    static INNER: LazyLock<FreePoints<15>> = LazyLock::new(|| FreePoints::new(inner_points(4)));
    let mut net: QuarticTriangle = BezierTriangle::new([DVec3::ZERO; 15]);
    for (edge, curve) in LocalEdge::ALL.into_iter().zip(&sides.quartic) {
        net.set_boundary(edge, curve);
    }
    FIT.apply(&mut net, samples);
    INNER.fit(&mut net, QUARTIC_ROUNDS, target, |columns, feet| {
        point_to_plane(columns, feet, QUARTIC_DAMPING)
    });
    let mut elevated = net.elevate_to::<36>();
    // the same bits in both faces of an edge, which elevation in another order would not give
    sides.bound(&mut elevated);
    elevated
}

/// The control points of a net that lie on no edge.
fn inner_points<const COUNT: usize>(degree: usize) -> [MultiIndex; COUNT] {
    let mut inner = MultiIndex::all(degree).filter(|m| m.i > 0 && m.j > 0 && m.k > 0);
    std::array::from_fn(|_| inner.next().expect("invariant: as many inner points as asked for"))
}
