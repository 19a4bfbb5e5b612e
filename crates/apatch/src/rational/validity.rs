//! Whether the tetrahedra at an edge fit between its faces.

use basemesh::{EdgeId, EdgeMap, FaceMap, TriMesh};
use glam::DVec3;

use super::apex::{Apices, FaceFrame};
use super::edge::{Place, places};
use super::kinds::{EdgeData, Side};

/// Angles at an edge on one side, in the plane perpendicular to it, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wedge {
    /// Between the faces.
    pub(crate) opening: f64,
    /// What the two face tetrahedra leave: the angle of the edge tetrahedron.
    pub(crate) angle: f64,
}

impl Wedge {
    pub(crate) fn is_valid(&self) -> bool {
        self.angle > 0.0 && self.angle < std::f64::consts::PI
    }
}

/// The part of a vector perpendicular to a unit vector.
fn perpendicular(v: DVec3, axis: DVec3) -> DVec3 {
    v - axis * v.dot(axis)
}

/// Angle between the faces at an edge on one side.
pub(crate) fn opening(
    mesh: &TriMesh,
    frames: &FaceMap<FaceFrame>,
    edge: EdgeId,
    side: Side,
) -> Option<f64> {
    let [k, l] = places(mesh.topology(), mesh.topology().canonical(edge))?;
    let [ek, el] = [k, l].map(|place| into_face(&frames[place.face], place));
    Some(angle_from(ek, el, frames[k.face].normal * side.sign()))
}

/// Unit vector in a face, perpendicular to an edge, into the face.
pub(crate) fn into_face(frame: &FaceFrame, place: Place) -> DVec3 {
    let [i, j] = place.ends.map(|c| frame.corners[c]);
    let axis = (j - i).normalize();
    perpendicular(frame.corners[place.third] - i, axis).normalize()
}

/// Angle from `ek` to `el` turning by way of `up`, in `[0, 2π)`.
fn angle_from(ek: DVec3, el: DVec3, up: DVec3) -> f64 {
    let angle = el.dot(up).atan2(el.dot(ek));
    if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
}

/// The wedge between two faces with these apices, of the left and the right face; `None` on a
/// boundary.
fn wedge(
    mesh: &TriMesh,
    frames: &FaceMap<FaceFrame>,
    edge: EdgeId,
    side: Side,
    apices: [DVec3; 2],
) -> Option<Wedge> {
    let opening = opening(mesh, frames, edge, side)?;
    let mut angle = opening;
    for (place, apex) in
        places(mesh.topology(), mesh.topology().canonical(edge))?.into_iter().zip(apices)
    {
        let frame = &frames[place.face];
        let [i, j] = place.ends.map(|c| frame.corners[c]);
        let toward = perpendicular(apex - i, (j - i).normalize());
        let into = into_face(frame, place);
        angle -= into.cross(toward).length().atan2(into.dot(toward));
    }
    Some(Wedge { opening, angle })
}

/// The wedges of the needed edge tetrahedra, by [`Side::index`].
pub(crate) type Wedges = EdgeMap<[Option<Wedge>; 2]>;

/// The wedges of all needed edge tetrahedra.
pub(crate) fn wedges(
    mesh: &TriMesh,
    frames: &FaceMap<FaceFrame>,
    edges: &EdgeMap<EdgeData>,
    apices: &FaceMap<Apices>,
) -> Wedges {
    let needed = |edge: EdgeId, side: Side| {
        let both = places(mesh.topology(), mesh.topology().canonical(edge))?;
        let [Some(left), Some(right)] = both.map(|p| apices[p.face][side.index()]) else {
            return None;
        };
        wedge(mesh, frames, edge, side, [left, right])
    };
    edges.map(|edge, data| {
        Side::BOTH.map(|side| data.convexity.has(side).then(|| needed(edge, side)).flatten())
    })
}

/// The edge tetrahedra that are inverted or folded with their angles, in the order of the edges.
pub(crate) fn invalid(wedges: &Wedges) -> Vec<(EdgeId, Side, f64)> {
    let sides = wedges.iter().flat_map(|(edge, w)| Side::BOTH.map(|s| (edge, s, w[s.index()])));
    sides
        .filter_map(|(edge, side, w)| w.filter(|w| !w.is_valid()).map(|w| (edge, side, w.angle)))
        .collect()
}
