//! Which samples of neighbouring faces are one point, and which have one normal.

use std::collections::HashMap;

use glam::DVec3;

use crate::obj::Polygons;
use crate::patterns::Site;

/// One side of a face: its vertices, the lower first, and the normals at its ends in the same order.
type Side = ([usize; 2], [Option<usize>; 2]);

/// Puts samples together, face after face.
#[derive(Debug)]
pub(crate) struct SharedPoints<'a> {
    mesh: &'a Polygons,
    /// Steps along each edge.
    divisions: usize,
    /// Sorted pairs of vertices.
    edges: Vec<[usize; 2]>,
    /// Whether all faces at an edge have the same normals at both of its ends.
    is_smooth: Vec<bool>,
    /// The vertices; `divisions - 1` points for each edge; then those that only one face has.
    pub(crate) positions: Vec<DVec3>,
    /// Sums of unit normals.
    pub(crate) normals: Vec<DVec3>,
    is_set: Vec<bool>,
    corner_normals: HashMap<(usize, usize), usize>,
    edge_normals: Vec<Option<usize>>,
}

/// What shares a sample.
#[derive(Clone, Copy)]
enum Place {
    /// The faces at a vertex with the same normal.
    Vertex { vertex: usize, normal: Option<usize> },
    /// The faces at an edge; `slot` counts the points inside edges.
    Edge { edge: usize, slot: usize },
    /// Nobody else.
    Inside,
}

impl<'a> SharedPoints<'a> {
    pub(crate) fn new(mesh: &'a Polygons, divisions: usize) -> Self {
        let (edges, is_smooth) = edges(mesh);
        let slots = (divisions - 1) * edges.len();
        let mut positions = mesh.positions.clone();
        positions.resize(positions.len() + slots, DVec3::ZERO);
        Self {
            mesh,
            divisions,
            edges,
            is_smooth,
            positions,
            normals: Vec::new(),
            is_set: vec![false; slots],
            corner_normals: HashMap::new(),
            edge_normals: vec![None; slots],
        }
    }

    /// Adds a sample of a face; returns the ids of its position and its normal.
    pub(crate) fn add(
        &mut self,
        face: usize,
        site: Site,
        (position, normal): (DVec3, DVec3),
    ) -> [usize; 2] {
        let place = self.place(face, site);
        let normal_id = self.normal_id(place);
        self.normals[normal_id] += normal;
        [self.position_id(place, position), normal_id]
    }

    fn place(&self, face: usize, site: Site) -> Place {
        let corners = self.mesh.faces[face].corners();
        match site {
            Site::Corner(corner) => Place::Vertex {
                vertex: corners[corner],
                normal: self.mesh.corner_normals[face].corners()[corner],
            },
            Site::Side { side, step } => {
                let ends = [corners[side], corners[(side + 1) % corners.len()]];
                let sorted = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                let edge =
                    self.edges.binary_search(&sorted).expect("invariant: a side has an edge");
                let step = if ends == sorted { step } else { self.divisions - step };
                Place::Edge { edge, slot: (self.divisions - 1) * edge + step - 1 }
            }
            Site::Inside => Place::Inside,
        }
    }

    fn position_id(&mut self, place: Place, position: DVec3) -> usize {
        match place {
            Place::Vertex { vertex, .. } => vertex,
            Place::Edge { slot, .. } => {
                let id = self.mesh.positions.len() + slot;
                if !std::mem::replace(&mut self.is_set[slot], true) {
                    self.positions[id] = position;
                }
                id
            }
            Place::Inside => {
                self.positions.push(position);
                self.positions.len() - 1
            }
        }
    }

    fn normal_id(&mut self, place: Place) -> usize {
        let next = self.normals.len();
        let id = match place {
            Place::Vertex { vertex, normal: Some(normal) } => {
                *self.corner_normals.entry((vertex, normal)).or_insert(next)
            }
            Place::Edge { edge, slot } if self.is_smooth[edge] => {
                *self.edge_normals[slot].get_or_insert(next)
            }
            _ => next,
        };
        if id == next {
            self.normals.push(DVec3::ZERO);
        }
        id
    }
}

/// All edges by their sorted vertices, and whether each is smooth.
pub(crate) fn edges(mesh: &Polygons) -> (Vec<[usize; 2]>, Vec<bool>) {
    let mut sides: Vec<Side> = Vec::new();
    for (face, normals) in mesh.faces.iter().zip(&mesh.corner_normals) {
        let (corners, normals) = (face.corners(), normals.corners());
        for start in 0..corners.len() {
            let end = (start + 1) % corners.len();
            let [lower, higher] =
                if corners[start] < corners[end] { [start, end] } else { [end, start] };
            let of = |from: &[usize]| [from[lower], from[higher]];
            sides.push((of(corners), [normals[lower], normals[higher]]));
        }
    }
    sides.sort_unstable();
    let chunks = sides.chunk_by(|a, b| a.0 == b.0);
    let is_smooth = |sides: &[Side]| {
        sides[0].1.iter().all(Option::is_some) && sides.iter().all(|side| side.1 == sides[0].1)
    };
    chunks.map(|sides| (sides[0].0, is_smooth(sides))).unzip()
}
