//! Apices moved to where the tetrahedra of neighbours do not overlap.

use basemesh::FaceId;
use glam::DVec3;

use super::apex::{Apices, blocks_of, corner_normals};
use super::edge::places;
use super::hull::Hull;
use super::kinds::Side;
use super::validity::{into_face, invalid, opening};
use crate::linear_program::{HalfSpace, deepest_point};

/// Rounds of moving apices; each face is moved once, so that few rounds are needed.
const MAX_ROUNDS: usize = 12;
/// Wanted distance of a moved apex from all its limits, in square roots of the face's area.
const WANTED_SLACK: f64 = 0.05;
/// Farthest coordinate of a moved apex from the centroid, in the same unit.
const FARTHEST: f64 = 4.0;
/// Ratios of the heights on the two sides, in the order in which they are tried.
const RATIOS: [f64; 5] = [1.0, 0.5, 2.0, 0.25, 4.0];

/// How much of the angle at an edge a face may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Share {
    /// Half of it.
    Half,
    /// What its neighbour leaves.
    Rest,
    /// Any part.
    #[cfg(test)]
    Free,
}

impl Hull {
    /// Moves the apices of the faces at invalid edges, each by a linear program that does not depend
    /// on the neighbours, until no new face is involved. \[ours\]
    pub(crate) fn move_apices(&mut self) {
        let mut touched = vec![false; self.faces.len()];
        let mut moved = touched.clone();
        for _ in 0..MAX_ROUNDS {
            let mut faces = self.faces_at_invalid_edges();
            faces.retain(|f| !touched[f.index()]);
            if faces.is_empty() {
                break;
            }
            for face in faces {
                touched[face.index()] = true;
                if let Some(apices) = self.best_apices(face, Share::Half) {
                    self.faces[face].apices = apices;
                    moved[face.index()] = true;
                }
            }
            self.invalid = invalid(&self.mesh, &self.edges, &self.faces);
        }
        self.use_what_neighbours_leave(&mut moved);
        self.moved = moved.into_iter().filter(|moved| *moved).count();
    }

    /// Moves the apices at edges that are still invalid, one face after the other, by a linear program
    /// that takes the apices of its neighbours as they are: where one needs little of an angle, the
    /// other may have more than half. A face that has no room in its turn goes where it leaves its
    /// neighbours the most. \[ours\]
    fn use_what_neighbours_leave(&mut self, moved: &mut [bool]) {
        for _ in 0..MAX_ROUNDS {
            let before = self.invalid.len();
            if before == 0 {
                return;
            }
            let mut old = Vec::new();
            for face in self.faces_at_invalid_edges() {
                if let Some(apices) = self.best_apices(face, Share::Rest) {
                    old.push((face, self.faces[face].apices));
                    self.faces[face].apices = apices;
                }
            }
            self.invalid = invalid(&self.mesh, &self.edges, &self.faces);
            if self.invalid.len() > before {
                old.iter().for_each(|&(face, apices)| self.faces[face].apices = apices);
                self.invalid = invalid(&self.mesh, &self.edges, &self.faces);
                return;
            }
            old.iter().for_each(|(face, _)| moved[face.index()] = true);
        }
    }

    fn faces_at_invalid_edges(&self) -> Vec<FaceId> {
        let topology = self.mesh.topology();
        let mut faces: Vec<FaceId> = self
            .invalid
            .iter()
            .filter_map(|&(edge, ..)| places(topology, topology.canonical(edge)))
            .flat_map(|places| places.map(|p| p.face))
            .collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// The apices of a face on a line through the centroid, as deep as possible inside all their
    /// limits; `None` if they cannot meet them.
    fn best_apices(&self, face: FaceId, share: Share) -> Option<Apices> {
        let frame = self.frame(face);
        let two_sided = Side::BOTH.iter().all(|&s| self.faces[face].apices[s.index()].is_some());
        let ratios = if two_sided { &RATIOS[..] } else { &RATIOS[..1] };
        let mut best: Option<(f64, Apices)> = None;
        for &ratio in ratios {
            let spaces = self.limits(face, ratio, share);
            let found = deepest_point(&spaces, WANTED_SLACK, FARTHEST);
            let usable = |slack: f64| slack > 0.0 || share == Share::Rest;
            let Some((w, slack)) = found.filter(|(_, slack)| usable(*slack)) else { continue };
            if best.as_ref().is_none_or(|(known, _)| slack > *known) {
                let place = |side: Side| {
                    let factor = if side == Side::Positive { 1.0 } else { -ratio };
                    self.faces[face].apices[side.index()]
                        .map(|_| frame.centroid + w * (factor * frame.size))
                };
                best = Some((slack, Side::BOTH.map(place)));
            }
            if slack >= 0.99 * WANTED_SLACK {
                break;
            }
        }
        best.map(|(_, apices)| apices)
    }

    /// What the direction `w` must satisfy, in units of the face's size, for the apices
    /// `C + w` and `C - ratio w` (a face with the negative one only: `C - w`).
    fn limits(&self, face: FaceId, ratio: f64, share: Share) -> Vec<HalfSpace> {
        let frame = self.frame(face);
        let normals = corner_normals(&self.mesh, &self.normals, face);
        let blocks = blocks_of(&self.mesh, &self.edges, face);
        let signs_are_hard = share == Share::Rest;
        let up = HalfSpace { normal: frame.normal, offset: 0.0, hard: signs_are_hard };
        let mut spaces = vec![up];
        for side in Side::BOTH.into_iter().filter(|s| self.faces[face].apices[s.index()].is_some())
        {
            let factor = if side == Side::Positive { 1.0 } else { -ratio };
            // an affine function that must be positive at the apex, by its value at the centroid
            let mut limit = |value: f64, gradient: DVec3, hard: bool| {
                let (normal, offset) = (gradient * factor, value / frame.size);
                spaces.extend(HalfSpace { normal, offset, hard }.normalized());
            };
            for a in 0..3 {
                let n = normals[a] * side.sign();
                limit((frame.centroid - frame.corners[a]).dot(n), n, signs_are_hard);
                let value = side.sign() * blocks[a].at(frame.centroid);
                limit(value, blocks[a].gradient * side.sign(), signs_are_hard);
            }
            let planes = match share {
                Share::Half => self.half_wedges(face, side),
                Share::Rest => self.rest_of_wedges(face, side),
                #[cfg(test)]
                Share::Free => Vec::new(),
            };
            for (base, gradient) in planes {
                limit((frame.centroid - base).dot(gradient), gradient, false);
            }
        }
        spaces
    }

    /// Planes through the edges that halve the angles to the neighbours, where an edge tetrahedron is
    /// needed: a point on each and the direction to keep to.
    fn half_wedges(&self, face: FaceId, side: Side) -> Vec<(DVec3, DVec3)> {
        let topology = self.mesh.topology();
        let frame = self.frame(face);
        let mut planes = Vec::new();
        for h in face.halfedges() {
            let edge = topology.edge(h);
            if !self.edges[edge].convexity.has(side) {
                continue;
            }
            let Some(angle) = opening(&self.mesh, edge, side) else { continue };
            let Some(both) = places(topology, topology.canonical(edge)) else { continue };
            let Some(place) = both.into_iter().find(|p| p.face == face) else { continue };
            let (ex, ey) = (into_face(&frame.corners, place), frame.normal * side.sign());
            let (sin, cos) = (0.5 * angle).sin_cos();
            let base = frame.corners[place.ends[0]];
            planes.push((base, ex * sin - ey * cos));
            planes.push((base, ex * cos + ey * sin));
        }
        planes
    }

    /// Planes through the edges and the apices of the neighbours, where an edge tetrahedron is needed:
    /// a point on each and the direction to keep to.
    fn rest_of_wedges(&self, face: FaceId, side: Side) -> Vec<(DVec3, DVec3)> {
        let topology = self.mesh.topology();
        let mut planes = Vec::new();
        for h in face.halfedges() {
            let edge = topology.edge(h);
            if !self.edges[edge].convexity.has(side) {
                continue;
            }
            let Some(both) = places(topology, topology.canonical(edge)) else { continue };
            let other = both.map(|p| p.face).into_iter().find(|&f| f != face);
            let Some(apex) = other.and_then(|f| self.faces[f].apices[side.index()]) else {
                continue;
            };
            let [i, j] = topology.edge_vertices(edge).map(|v| self.mesh.position(v));
            let (axis, other) = ((j - i) * side.sign(), apex - i);
            let is_left = topology.canonical(edge).face() == face;
            planes.push((i, if is_left { other.cross(axis) } else { axis.cross(other) }));
        }
        planes
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "figures, for runs with --nocapture")]

    use super::*;
    use crate::rational::loop_limit_normals;
    use crate::rational::settings::Settings;
    use std::f64::consts::PI;

    impl Hull {
        /// Whether a face can have apices at all: the signs of layer 1, and the angles to its
        /// neighbours as if those took nothing of them.
        fn has_apices_alone(&self, face: FaceId) -> bool {
            let frame = self.frame(face);
            RATIOS.iter().any(|&ratio| {
                let mut spaces = self.limits(face, ratio, Share::Free);
                for side in Side::BOTH {
                    let factor = if side == Side::Positive { 1.0 } else { -ratio };
                    for (base, gradient) in self.planes_of_neighbours(face, side) {
                        let offset = (frame.centroid - base).dot(gradient) / frame.size;
                        let normal = gradient * factor;
                        spaces.extend(HalfSpace { normal, offset, hard: false }.normalized());
                    }
                }
                deepest_point(&spaces, WANTED_SLACK, FARTHEST).is_some_and(|(_, slack)| slack > 0.0)
            })
        }

        fn planes_of_neighbours(&self, face: FaceId, side: Side) -> Vec<(DVec3, DVec3)> {
            let topology = self.mesh.topology();
            let plane = |h: basemesh::HalfedgeId| {
                let edge = topology.edge(h);
                let angle = opening(&self.mesh, edge, side)?;
                let kind = self.edges[edge].convexity;
                if self.faces[face].apices[side.index()].is_none() || !kind.has(side) || angle > PI
                {
                    return None;
                }
                let [i, j, k] = [h, h.next(), topology.twin(h)?.previous()]
                    .map(|h| self.mesh.position(topology.origin(h)));
                Some((i, (k - i).cross((j - i) * side.sign())))
            };
            face.halfedges().into_iter().filter_map(plane).collect()
        }
    }

    /// What remains with given normals: how much of it no choice of apices could mend.
    #[test]
    fn what_remains_on_noisy_spheres() {
        for noise in [0.2, 0.3] {
            let mut sums = [0; 3];
            for seed in 1..6 {
                let mesh = testkit::meshes::noisy_sphere(noise, seed);
                let normals = loop_limit_normals(&mesh);
                let mut hull = Hull::new(mesh, normals, &Settings::default()).expect("a hull");
                let before = hull.invalid.len();
                hull.move_apices();
                let topology = hull.mesh.topology();
                let hopeless = hull.invalid.iter().filter(|(edge, ..)| {
                    let both = places(topology, topology.canonical(*edge));
                    both.into_iter().flatten().any(|p| !hull.has_apices_alone(p.face))
                });
                let found = [before, hull.invalid.len(), hopeless.count()];
                println!("{noise} seed {seed}: {found:?}");
                (0..3).for_each(|i| sums[i] += found[i]);
            }
            println!("{noise}: {sums:?}");
            let [before, after, hopeless] = sums;
            assert!(2 * after < before, "most are mended: {sums:?}");
            assert!(10 * after < before || 2 * hopeless > after, "the rest cannot be: {sums:?}");
        }
    }
}
