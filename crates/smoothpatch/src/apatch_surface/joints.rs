//! How the pieces of the function, and of the surface, meet.

use apatch::rational::{RationalSurface, Side, SurfacePoint};
use basemesh::glam::DVec3;
use basemesh::{EdgeId, FaceId, HalfedgeId};
use serde::Serialize;

/// Points that are compared on each common triangle of two tetrahedra, and on each edge.
const SAMPLES: usize = 8;

/// Largest differences between neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Joints {
    /// Of the function on common triangles of its tetrahedra, relative to its size next to the face.
    pub value_jump: f64,
    /// Of its gradient, relative to the longer one.
    pub gradient_jump: f64,
    /// Angle between the normals of neighbouring patches, in radians.
    pub normal_angle: f64,
    /// Distance of points that neighbouring patches share. Unit: length.
    pub gap: f64,
    /// Number of comparisons.
    pub compared: usize,
    /// Points that a patch should have and has not.
    pub missing: usize,
}

impl Joints {
    fn values(&mut self, a: Option<(f64, DVec3)>, b: Option<(f64, DVec3)>, scale: f64) {
        let (Some(a), Some(b)) = (a, b) else { return };
        self.value_jump = self.value_jump.max((a.0 - b.0).abs() / scale);
        let longer = a.1.length().max(b.1.length());
        self.gradient_jump = self.gradient_jump.max(a.1.distance(b.1) / longer);
        self.compared += 1;
    }

    fn points(&mut self, a: Option<SurfacePoint>, b: Option<SurfacePoint>) {
        let (Some(a), Some(b)) = (a, b) else {
            self.missing += 1;
            return;
        };
        let (n, m) = (a.normal(), b.normal());
        self.normal_angle = self.normal_angle.max(n.cross(m).length().atan2(n.dot(m)));
        self.gap = self.gap.max(a.point.distance(b.point));
        self.compared += 1;
    }
}

/// Compares all neighbours at points that are spread evenly, other ones at each face and edge.
#[must_use]
pub fn joints(surface: &RationalSurface) -> Joints {
    let topology = surface.mesh().topology();
    let mut joints = Joints::default();
    for face in topology.faces() {
        between_sides(surface, face, &mut joints);
    }
    for edge in topology.edges() {
        let canonical = topology.canonical(edge);
        for (h, is_left) in [(Some(canonical), true), (topology.twin(canonical), false)] {
            let Some(h) = h else { continue };
            for side in Side::BOTH {
                beside_edge(surface, edge, h, is_left, side, &mut joints);
            }
            points_beside_edge(surface, edge, h, is_left, &mut joints);
        }
        at_edge(surface, edge, &mut joints);
    }
    joints
}

/// The two tetrahedra of a face on their common triangle.
fn between_sides(surface: &RationalSurface, face: FaceId, joints: &mut Joints) {
    let [Some(up), Some(_)] = &surface.face(face).sides else { return };
    for [a, b, c] in spread(face.index()) {
        let [p, q] = Side::BOTH.map(|side| surface.face_value(face, side, [a, b, c, 0.0]));
        joints.values(p, q, up.scale());
    }
}

/// The tetrahedron of an edge and that of the face at a half-edge on their common triangle.
fn beside_edge(
    surface: &RationalSurface,
    edge: EdgeId,
    h: HalfedgeId,
    is_left: bool,
    side: Side,
    joints: &mut Joints,
) {
    if surface.edge(edge).sides[side.index()].is_none() {
        return;
    }
    let Some(scale) = surface.face(h.face()).sides[side.index()].map(|s| s.scale()) else { return };
    for [i, j, apex] in spread(h.index()) {
        let in_edge = if is_left { [0.0, i, j, apex] } else { [apex, i, j, 0.0] };
        let mut in_face = [0.0, 0.0, 0.0, apex];
        (in_face[h.corner()], in_face[h.next().corner()]) = if is_left { (i, j) } else { (j, i) };
        let a = surface.edge_value(edge, side, in_edge);
        joints.values(a, surface.face_value(h.face(), side, in_face), scale);
    }
}

/// The patches over an edge and over a face at it.
fn points_beside_edge(
    surface: &RationalSurface,
    edge: EdgeId,
    h: HalfedgeId,
    is_left: bool,
    joints: &mut Joints,
) {
    if surface.edge(edge).sides.iter().all(Option::is_none) {
        return;
    }
    for x in inner_parameters() {
        let mut at = [0.0; 3];
        (at[h.corner()], at[h.next().corner()]) = if is_left { (x, 1.0 - x) } else { (1.0 - x, x) };
        let y = if is_left { 1.0 } else { 0.0 };
        joints.points(surface.face_point(h.face(), at), surface.edge_point(edge, [x, y]));
    }
}

/// All tetrahedra at the points of an edge.
fn at_edge(surface: &RationalSurface, edge: EdgeId, joints: &mut Joints) {
    let topology = surface.mesh().topology();
    let canonical = topology.canonical(edge);
    for x in inner_parameters() {
        let (mut scale, mut all) = (0.0_f64, Vec::new());
        for (h, at) in [(Some(canonical), x), (topology.twin(canonical), 1.0 - x)] {
            let Some(h) = h else { continue };
            let mut weights = [0.0; 4];
            (weights[h.corner()], weights[h.next().corner()]) = (at, 1.0 - at);
            all.extend(Side::BOTH.map(|side| surface.face_value(h.face(), side, weights)));
            let patch = surface.face(h.face());
            scale = patch.sides.iter().flatten().fold(scale, |scale, s| scale.max(s.scale()));
        }
        let weights = [0.0, x, 1.0 - x, 0.0];
        all.extend(Side::BOTH.map(|side| surface.edge_value(edge, side, weights)));
        let all: Vec<_> = all.into_iter().flatten().collect();
        all.windows(2).for_each(|w| joints.values(Some(w[0]), Some(w[1]), scale));
    }
}

fn inner_parameters() -> impl Iterator<Item = f64> {
    (1..=SAMPLES).map(|i| i as f64 / (SAMPLES + 1) as f64)
}

/// Points inside a triangle: the next ones of a sequence that fills the square evenly, folded onto
/// the triangle.
fn spread(from: usize) -> impl Iterator<Item = [f64; 3]> {
    // powers of the inverse of the plastic number
    const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];
    (0..SAMPLES).map(move |i| {
        let count = (from * SAMPLES + i + 1) as f64;
        let [u, v] = STEPS.map(|step| (count * step).fract());
        let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
        [u, v, 1.0 - u - v]
    })
}
