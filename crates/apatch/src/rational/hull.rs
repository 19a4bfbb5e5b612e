//! The tetrahedra: kinds of edges and faces, apices, and their repair.

use basemesh::{EdgeId, EdgeMap, FaceId, FaceMap, TriMesh, VertexMap};
use glam::DVec3;

use super::apex::{Apices, FaceFrame, apices, blocks_of, corner_normals};
use super::block::{EdgeBlock, blocks};
use super::edge::places;
use super::error::SurfaceError;
use super::kinds::{self, Convexity, EdgeData, Side};
use super::settings::Settings;
use super::validity::{Wedges, into_face, invalid, opening, wedges};
use crate::linear_program::{HalfSpace, deepest_point};

/// Everything that is known before the weights.
#[derive(Clone, Debug)]
pub(crate) struct Hull {
    pub(crate) mesh: TriMesh,
    pub(crate) normals: VertexMap<DVec3>,
    pub(crate) frames: FaceMap<FaceFrame>,
    pub(crate) edges: EdgeMap<EdgeData>,
    pub(crate) blocks: EdgeMap<EdgeBlock>,
    pub(crate) kinds: FaceMap<Convexity>,
    pub(crate) apices: FaceMap<Apices>,
    /// Angles of the needed edge tetrahedra.
    pub(crate) wedges: Wedges,
    /// Edge tetrahedra that are inverted or folded, with their angles.
    pub(crate) invalid: Vec<(EdgeId, Side, f64)>,
    /// Faces that a normal at a corner sees from behind.
    pub(crate) behind: Vec<FaceId>,
    /// Faces whose apices were moved.
    pub(crate) moved: usize,
}

/// Rounds of moving apices; each face is moved once, so that few rounds are needed.
const MAX_ROUNDS: usize = 12;
/// Wanted distance of a moved apex from all its limits, in square roots of the face's area.
const WANTED_SLACK: f64 = 0.05;
/// Farthest coordinate of a moved apex from the centroid, in the same unit.
const FARTHEST: f64 = 4.0;
/// Ratios of the heights on the two sides, in the order in which they are tried.
const RATIOS: [f64; 5] = [1.0, 0.5, 2.0, 0.25, 4.0];

impl Hull {
    /// Kinds and apices, nothing repaired.
    pub(crate) fn new(
        mesh: TriMesh,
        normals: VertexMap<DVec3>,
        settings: &Settings,
    ) -> Result<Self, SurfaceError> {
        let frames = FaceMap::try_from_fn(mesh.topology().face_count(), |face| {
            FaceFrame::new(mesh.triangle(face)).ok_or(SurfaceError::FlatFace { face: face.index() })
        })?;
        let edges = kinds::edges(&mesh, &normals, settings.straight);
        let blocks = blocks(&mesh, &normals, &edges);
        let kinds = kinds::faces(&mesh, &edges);
        let apices = apices(&mesh, &frames, &normals, &blocks, &kinds, &settings.apices);
        let wedges = wedges(&mesh, &frames, &edges, &apices);
        let invalid = invalid(&wedges);
        let sees = |&face: &FaceId| {
            let corners = corner_normals(&mesh, &normals, face);
            corners.iter().any(|n| n.dot(frames[face].normal) <= 0.0)
        };
        let behind = mesh.topology().faces().filter(sees).collect();
        Ok(Self {
            mesh,
            normals,
            frames,
            edges,
            blocks,
            kinds,
            apices,
            wedges,
            invalid,
            behind,
            moved: 0,
        })
    }

    /// Number of things wrong.
    pub(crate) fn defects(&self) -> usize {
        self.invalid.len() + self.behind.len()
    }

    /// Moves the apices of the faces at invalid edges, each by a linear program that does not depend
    /// on the neighbours, until no new face is involved. \[ours\]
    pub(crate) fn move_apices(&mut self) {
        let topology = self.mesh.topology();
        let mut touched = vec![false; topology.face_count()];
        for _ in 0..MAX_ROUNDS {
            let mut faces: Vec<FaceId> = self
                .invalid
                .iter()
                .filter_map(|&(edge, ..)| places(topology, topology.canonical(edge)))
                .flat_map(|places| places.map(|p| p.face))
                .filter(|f| !touched[f.index()])
                .collect();
            faces.sort_unstable();
            faces.dedup();
            if faces.is_empty() {
                break;
            }
            for face in faces {
                touched[face.index()] = true;
                if let Some(apices) = self.best_apices(face) {
                    self.apices[face] = apices;
                    self.moved += 1;
                }
            }
            self.wedges = wedges(&self.mesh, &self.frames, &self.edges, &self.apices);
            self.invalid = invalid(&self.wedges);
        }
    }

    /// The apices of a face on a line through the centroid, as deep as possible inside all their
    /// limits; `None` if they cannot meet them.
    fn best_apices(&self, face: FaceId) -> Option<Apices> {
        let frame = &self.frames[face];
        let two_sided = Side::BOTH.iter().all(|&s| self.apices[face][s.index()].is_some());
        let ratios = if two_sided { &RATIOS[..] } else { &RATIOS[..1] };
        let mut best: Option<(f64, Apices)> = None;
        for &ratio in ratios {
            let spaces = self.limits(face, ratio);
            let found = deepest_point(&spaces, WANTED_SLACK, FARTHEST);
            let Some((w, slack)) = found.filter(|(_, slack)| *slack > 0.0) else { continue };
            if best.as_ref().is_none_or(|(known, _)| slack > *known) {
                let place = |side: Side| {
                    let factor = if side == Side::Positive { 1.0 } else { -ratio };
                    self.apices[face][side.index()]
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
    fn limits(&self, face: FaceId, ratio: f64) -> Vec<HalfSpace> {
        let frame = &self.frames[face];
        let normals = corner_normals(&self.mesh, &self.normals, face);
        let blocks = blocks_of(&self.mesh, &self.blocks, face);
        let mut spaces = vec![HalfSpace { normal: frame.normal, offset: 0.0 }];
        for side in Side::BOTH.into_iter().filter(|s| self.apices[face][s.index()].is_some()) {
            let factor = if side == Side::Positive { 1.0 } else { -ratio };
            // an affine function that must be positive at the apex, by its value at the centroid
            let mut limit = |value: f64, gradient: DVec3| {
                let space = HalfSpace { normal: gradient * factor, offset: value / frame.size };
                spaces.extend(space.normalized());
            };
            for a in 0..3 {
                let n = normals[a] * side.sign();
                limit((frame.centroid - frame.corners[a]).dot(n), n);
                limit(side.sign() * blocks[a].at(frame.centroid), blocks[a].gradient * side.sign());
            }
            for (base, gradient) in self.half_wedges(face, side) {
                limit((frame.centroid - base).dot(gradient), gradient);
            }
        }
        spaces
    }

    /// Planes through the edges that halve the angles to the neighbours, where an edge tetrahedron is
    /// needed: a point on each and the direction to keep to.
    fn half_wedges(&self, face: FaceId, side: Side) -> Vec<(DVec3, DVec3)> {
        let topology = self.mesh.topology();
        let frame = &self.frames[face];
        let mut planes = Vec::new();
        for h in face.halfedges() {
            let edge = topology.edge(h);
            if !self.edges[edge].convexity.has(side) {
                continue;
            }
            let Some(angle) = opening(&self.mesh, &self.frames, edge, side) else { continue };
            let Some(both) = places(topology, topology.canonical(edge)) else { continue };
            let Some(place) = both.into_iter().find(|p| p.face == face) else { continue };
            let (ex, ey) = (into_face(frame, place), frame.normal * side.sign());
            let (sin, cos) = (0.5 * angle).sin_cos();
            let base = frame.corners[place.ends[0]];
            planes.push((base, ex * sin - ey * cos));
            planes.push((base, ex * cos + ey * sin));
        }
        planes
    }
}
