//! Where the apices of the face tetrahedra stand.

use basemesh::{EdgeMap, FaceId, TriMesh, VertexMap};
use glam::DVec3;

use super::base::others;
use super::block::EdgeBlock;
use super::kinds::{Convexity, EdgeData, Side};
use super::settings::ApexSettings;

/// Apices of a face, by [`Side::index`].
pub(crate) type Apices = [Option<DVec3>; 2];

/// Plane and size of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FaceFrame {
    pub(crate) corners: [DVec3; 3],
    pub(crate) centroid: DVec3,
    /// Unit normal.
    pub(crate) normal: DVec3,
    /// Square root of the area.
    pub(crate) size: f64,
}

impl FaceFrame {
    #[inline]
    pub(crate) fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let cross = (b - a).cross(c - a);
        let length = cross.length();
        Self {
            corners,
            centroid: (a + b + c) / 3.0,
            normal: cross / length,
            size: (0.5 * length).sqrt(),
        }
    }

    /// False for a triangle without a plane.
    #[inline]
    pub(crate) fn has_area(&self) -> bool {
        let [a, b, c] = self.corners;
        let longest =
            [a - b, b - c, c - a].map(DVec3::length_squared).into_iter().fold(0.0, f64::max);
        // below this, the direction of the normal is round-off
        2.0 * self.size * self.size > 1e-14 * longest
    }
}

/// A normal this close to the plane of a face (as a sine), or behind it, gives no usable height.
const STEEP: f64 = 1e-6;

/// Heights over the centroid, in lengths of `direction`, at which the weights of layer 1 change their
/// sign: one for each corner and one for each edge \[XHB01 (3.1)\]; none where the normal does not
/// point to the positive side.
pub(crate) fn heights(
    frame: &FaceFrame,
    direction: DVec3,
    normals: [DVec3; 3],
    blocks: [&EdgeBlock; 3],
) -> [[Option<f64>; 3]; 2] {
    let over = |value: f64, slope: DVec3| {
        let rise = slope.dot(direction);
        let steep = rise > 0.0 && rise * rise > STEEP * STEEP * slope.length_squared();
        steep.then(|| -value / rise)
    };
    let corner = |a: usize| over((frame.centroid - frame.corners[a]).dot(normals[a]), normals[a]);
    let edge = |c: usize| {
        let [a, b] = others(c);
        over(6.0 * blocks[c].at(frame.centroid), normals[a] + normals[b])
    };
    [std::array::from_fn(corner), std::array::from_fn(edge)]
}

/// Height of the apex on a side: beyond all [`heights`], and never too low.
pub(crate) fn height(
    frame: &FaceFrame,
    heights: &[[Option<f64>; 3]; 2],
    side: Side,
    settings: &ApexSettings,
) -> f64 {
    let all = || heights.iter().flatten().copied().flatten();
    let unit = all().fold(settings.least_unit * frame.size, |u, t| u.max(t.abs()));
    let beyond = all().map(|t| side.sign() * t + settings.clearance * unit);
    side.sign() * beyond.fold(settings.floor * unit, f64::max)
}

/// The apices of a face of this kind, over its centroid.
#[inline]
pub(crate) fn apices(
    frame: &FaceFrame,
    kind: Convexity,
    normals: [DVec3; 3],
    blocks: [&EdgeBlock; 3],
    settings: &ApexSettings,
) -> Apices {
    if kind == Convexity::Zero {
        return [None; 2];
    }
    let heights = heights(frame, frame.normal, normals, blocks);
    Side::BOTH.map(|side| {
        let over = || frame.centroid + frame.normal * height(frame, &heights, side, settings);
        kind.has(side).then(over)
    })
}

/// Normals at the corners of a face.
#[inline]
pub(crate) fn corner_normals(
    mesh: &TriMesh,
    normals: &VertexMap<DVec3>,
    face: FaceId,
) -> [DVec3; 3] {
    mesh.topology().corners(face).map(|v| normals[v])
}

/// Blocks of the edges of a face, by opposite corner.
#[inline]
pub(crate) fn blocks_of<'a>(
    mesh: &TriMesh,
    edges: &'a EdgeMap<EdgeData>,
    face: FaceId,
) -> [&'a EdgeBlock; 3] {
    [1, 2, 0].map(|start| &edges[mesh.topology().edge(face.halfedge(start))].block)
}
