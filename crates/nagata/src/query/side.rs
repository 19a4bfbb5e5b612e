//! On which side of the surface a point is, if the closest point is on an edge or a vertex.
//!
//! The normal of one of the faces may point the wrong way there. The sum of the normals, weighted with
//! the angles of the faces, does not \[Baerentzen05\].

use std::f64::consts::PI;

use bezier_core::PatchJet;
use glam::DVec3;

use super::Closest;
use crate::surface::Patch;
use crate::unit::angle;

/// One of several faces that share the closest point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    /// Its distance is not signed.
    pub(super) found: Closest,
    /// Angle of the face at the point.
    pub(super) weight: f64,
}

/// The angle of a patch at a point, in radians: π but for corners.
pub(super) fn angle_at(patch: &Patch, parameters: [f64; 2]) -> f64 {
    let quad = matches!(patch, Patch::Quad(_));
    let corner = match parameters {
        [u, v] if (u == 0.0 || u == 1.0) && (v == 0.0 || v == 1.0) => [u, v],
        _ => return PI,
    };
    let PatchJet { du, dv, .. } = patch.jet(corner);
    let along = |at_end: bool, d: DVec3| if at_end { -d } else { d };
    match (quad, corner[0] == 1.0, corner[1] == 1.0) {
        (true, u, v) => angle(along(u, du), along(v, dv)),
        (false, true, _) => angle(-du, dv - du),
        (false, false, true) => angle(-dv, du - dv),
        (false, false, false) => angle(du, dv),
    }
}

/// The result for `p`: of the candidates, which all are at the closest point, the one whose normal
/// shows most clearly on which side `p` is.
pub(super) fn signed(candidates: &[Candidate], p: DVec3) -> Option<Closest> {
    let height = |c: &Candidate| c.found.at.normal.map(|normal| normal.dot(p - c.found.at.point));
    let sum: f64 = candidates.iter().filter_map(|c| Some(height(c)? * c.weight)).sum();
    let sign = if sum < 0.0 { -1.0 } else { 1.0 };
    let clarity = |c: &Candidate| height(c).map_or(f64::NEG_INFINITY, |height| height * sign);
    let best = candidates
        .iter()
        .max_by(|a, b| clarity(a).total_cmp(&clarity(b)).then(b.found.face.cmp(&a.found.face)))?;
    Some(Closest { signed_distance: best.found.signed_distance * sign, ..best.found })
}
