//! Normals at the points of a tessellation.

use std::collections::HashMap;

use glam::DVec3;

use super::edges::{CutEdges, Place};
use super::faces::Point;
use crate::obj::Polygons;
use crate::samples::FacePoint;

/// Normals that faces share, summed up.
#[derive(Default)]
pub(super) struct SharedNormals {
    sums: Vec<DVec3>,
    /// Of a vertex with one of its normals.
    at_vertex: HashMap<(usize, usize), usize>,
    /// Of a point inside a smooth edge.
    at_edge: HashMap<usize, usize>,
}

impl SharedNormals {
    /// Adds the normals of a face at its points; returns their ids.
    pub(super) fn add(
        &mut self,
        mesh: &Polygons,
        edges: &CutEdges,
        face: usize,
        points: &[Point],
        evaluate: &impl Fn(usize, FacePoint) -> (DVec3, DVec3),
    ) -> Vec<usize> {
        points
            .iter()
            .enumerate()
            .map(|(index, point)| {
                // the corners of a face are its first points
                let given = || mesh.corner_normals[face].corners()[index];
                let next = self.sums.len();
                let id = match edges.place(point.id) {
                    Place::Vertex(vertex) => match given() {
                        Some(normal) => *self.at_vertex.entry((vertex, normal)).or_insert(next),
                        None => next,
                    },
                    Place::Edge { is_smooth: true } => {
                        *self.at_edge.entry(point.id).or_insert(next)
                    }
                    Place::Edge { is_smooth: false } | Place::Inside => next,
                };
                if id == next {
                    self.sums.push(DVec3::ZERO);
                }
                self.sums[id] += evaluate(face, point.at).1;
                id
            })
            .collect()
    }

    /// Unit normals; zero where there is none.
    pub(super) fn finish(self) -> Vec<DVec3> {
        self.sums.into_iter().map(DVec3::normalize_or_zero).collect()
    }
}
