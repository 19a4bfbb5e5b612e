//! Whether the tetrahedra at an edge fit between its faces.

use basemesh::{EdgeId, EdgeMap, FaceMap, TriMesh};
use glam::DVec3;

use super::edge::{Place, places};
use super::hull::HullFace;
use super::kinds::{EdgeData, Side};

/// Angles at an edge on one side, in the plane perpendicular to it, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// Between the faces.
    pub opening: f64,
    /// What the two face tetrahedra leave: the angle of the edge tetrahedron.
    pub angle: f64,
}

impl Wedge {
    /// Whether the edge tetrahedron is neither inverted nor folded.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.angle > 0.0 && self.angle < std::f64::consts::PI
    }
}

/// An edge seen along itself: directions away from its start, of which only the part perpendicular to
/// the edge counts.
struct View {
    /// Along the edge; turning around it goes from the left face over this side to the right one.
    axis: DVec3,
    /// Into the left and the right face.
    faces: [DVec3; 2],
    /// To the apices of the left and the right face.
    apices: [DVec3; 2],
}

/// The part of a vector perpendicular to a unit vector.
#[inline]
fn perpendicular(v: DVec3, axis: DVec3) -> DVec3 {
    v - axis * v.dot(axis)
}

/// Unit vector in a face, perpendicular to an edge, into the face.
pub(crate) fn into_face(corners: &[DVec3; 3], place: Place) -> DVec3 {
    let [i, j] = place.ends.map(|c| corners[c]);
    let axis = (j - i).normalize();
    perpendicular(corners[place.third] - i, axis).normalize()
}

/// An angle within this (as a sine) of 0 or π is measured before it is judged.
const NARROW: f64 = 1e-9;

impl View {
    #[inline]
    fn new(mesh: &TriMesh, places: [Place; 2], side: Side, apices: [DVec3; 2]) -> Self {
        let [left, right] = places.map(|p| mesh.triangle(p.face));
        let [i, j] = places[0].ends.map(|c| left[c]);
        Self {
            axis: (j - i) * side.sign(),
            faces: [left[places[0].third] - i, right[places[1].third] - i],
            apices: apices.map(|apex| apex - i),
        }
    }

    /// Sine and cosine of the angle from `v` to `w`, both times the same positive number.
    #[inline]
    fn turn(&self, v: DVec3, w: DVec3) -> [f64; 2] {
        let square = self.axis.length_squared();
        let cosine = v.dot(w) * square - v.dot(self.axis) * w.dot(self.axis);
        [v.cross(w).dot(self.axis) * square.sqrt(), cosine]
    }

    /// Angle between the faces, in `[0, 2π)`.
    fn opening(&self) -> f64 {
        let [k, l] = self.faces;
        let [sine, cosine] = self.turn(k, l);
        let angle = sine.atan2(cosine);
        if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
    }

    fn wedge(&self) -> Wedge {
        let opening = self.opening();
        let taken = |f: usize| {
            let [sine, cosine] = self.turn(self.faces[f], self.apices[f]);
            sine.abs().atan2(cosine)
        };
        Wedge { opening, angle: opening - taken(0) - taken(1) }
    }

    /// Whether the wedge is valid for certain, by signs alone.
    #[inline]
    fn is_valid_by_signs(&self) -> bool {
        let ([k, l], [u, v], axis) = (self.faces, self.apices, self.axis);
        let square = axis.length_squared();
        // both face tetrahedra on their side of the faces, with acute angles
        let acute = |p: DVec3, q: DVec3| p.dot(q) * square > p.dot(axis) * q.dot(axis);
        let sine = u.cross(v).dot(axis);
        let size = square * u.length_squared() * v.length_squared();
        k.cross(u).dot(axis) > 0.0
            && v.cross(l).dot(axis) > 0.0
            && acute(k, u)
            && acute(v, l)
            && sine > 0.0
            && sine * sine > NARROW * NARROW * size
    }
}

/// Angle between the faces at an edge on one side, in `[0, 2π)`; `None` on a boundary.
pub(crate) fn opening(mesh: &TriMesh, edge: EdgeId, side: Side) -> Option<f64> {
    let places = places(mesh.topology(), mesh.topology().canonical(edge))?;
    Some(View::new(mesh, places, side, [DVec3::ZERO; 2]).opening())
}

/// The wedge between two faces with these apices, of the left and the right face; `None` on a
/// boundary.
pub(crate) fn wedge(mesh: &TriMesh, edge: EdgeId, side: Side, apices: [DVec3; 2]) -> Option<Wedge> {
    let places = places(mesh.topology(), mesh.topology().canonical(edge))?;
    Some(View::new(mesh, places, side, apices).wedge())
}

/// The edge tetrahedra that are inverted or folded with their angles, in the order of the edges.
pub(crate) fn invalid(
    mesh: &TriMesh,
    edges: &EdgeMap<EdgeData>,
    faces: &FaceMap<HullFace>,
) -> Vec<(EdgeId, Side, f64)> {
    let topology = mesh.topology();
    let doubtful = |edge: EdgeId, side: Side| {
        let places = places(topology, topology.canonical(edge))?;
        let [Some(left), Some(right)] = places.map(|p| faces[p.face].apices[side.index()]) else {
            return None;
        };
        let view = View::new(mesh, places, side, [left, right]);
        (!view.is_valid_by_signs()).then(|| view.wedge())
    };
    let bad = |edge: EdgeId, data: &EdgeData| {
        Side::BOTH.map(|side| {
            let wedge = data.convexity.has(side).then(|| doubtful(edge, side)).flatten()?;
            (!wedge.is_valid()).then_some(wedge.angle)
        })
    };
    let all = edges.map(bad);
    let sides = all.iter().flat_map(|(edge, bad)| Side::BOTH.map(|s| (edge, s, bad[s.index()])));
    sides.filter_map(|(edge, side, angle)| Some((edge, side, angle?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The signs never call an angle valid that is not.
        #[test]
        fn signs_and_angles_agree(angles in prop::array::uniform3(0.0..6.2_f64), along in -2.0..2.0_f64) {
            let around = |angle: f64| DVec3::new(along * angle, angle.cos(), angle.sin());
            let [opening, up, down] = angles;
            let (up, down) = (up * 0.5, down * 0.5);
            let view = View {
                axis: DVec3::X * 0.7,
                faces: [around(0.0), around(opening) * 2.0],
                apices: [around(up) * 1.5, around(opening - down)],
            };
            let wedge = view.wedge();
            prop_assert!((wedge.opening - opening).abs() < 1e-12, "{wedge:?}");
            prop_assert!((wedge.angle - (opening - up - down)).abs() < 1e-12, "{wedge:?}");
            prop_assert!(wedge.is_valid() || !view.is_valid_by_signs(), "{wedge:?}");
            let plain = wedge.is_valid() && up.max(down) < 1.5 && wedge.angle.sin() > 1e-6;
            prop_assert!(!plain || up * down == 0.0 || view.is_valid_by_signs(), "{wedge:?}");
        }
    }
}
